#!/usr/bin/env bash
# Installs what is missing, builds, and runs the main job on data that it generates itself. Ends with a page of
# what it made: pictures, reports and the commands.
# usage: demo.sh [OUTPUT_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-demo_output}

cat <<'EOF'
This demo has three steps. Times are those of two cores; more cores build faster.
  1. Install Debian packages that are missing (several minutes if none are there).
  2. Build the six tools that it runs, in build/release (about 8 minutes the first time).
  3. Extract, measure and draw surfaces from a million samples that it generates (about 15 seconds).
It ends with a page that shows the pictures, the reports and the commands.

EOF
# What the demo runs, and nothing else: the first build is what a newcomer waits for.
bash tools/build.sh demo
mkdir -p "$out"
bin=build/release/bin
page=$out/index.html

escape() { sed -e 's/&/\&amp;/g' -e 's/</\&lt;/g'; }

# run COMMAND...: run it, and put it and its report into the page.
run() {
  printf '\n$ %s\n' "$*"
  "$@" 2>&1 | tee "$out/report.txt"
  { echo "<details><summary><code>$(echo "$*" | escape)</code></summary><pre>$(escape <"$out/report.txt")</pre></details>"; } >>"$page"
}

# show PICTURE SENTENCE
show() { echo "<figure><img src=\"$1\" alt=\"$2\"><figcaption>$2</figcaption></figure>" >>"$page"; }

cat >"$page" <<'EOF'
<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><title>pcl_uvol: a torn star</title>
<style>
body { font-family: sans-serif; max-width: 50em; margin: 2em auto }
pre { background: #f4f4f4; padding: 1em; overflow: auto }
summary { cursor: pointer; margin: 0.5em 0 }
img { max-width: 100% }
iframe { width: 100%; height: 30em; border: 1px solid #ccc }
</style>
<h1>A torn star in a million scattered samples</h1>
<p>Every command that was run, in this order; open one to read its report.</p>
EOF
run $bin/uvol_generate "$out/star.pcd" -field star -samples clustered -n 1000000
run $bin/uvol_info "$out/star.pcd"
run $bin/uvol_isosurface "$out/star.pcd" "$out/star_surface.ply" -field star -iso 0.001,0.01,0.1
run $bin/uvol_isosurface "$out/star.pcd" "$out/star_surface.vtp" -field star -iso 0.001,0.01,0.1
run $bin/uvol_isosurface "$out/star.pcd" "$out/star_inner.ply" -field star -iso 0.01 -max-error 0.01 \
  -png "$out/star.png" -size 640x480 -color mean_curvature -range -2,2 -colormap coolwarm
show star.png "The surface at 0.01, coloured by its mean curvature."
run $bin/uvol_render "$out/star_inner.ply" "$out/star_lines.png" -size 640x480 -silhouettes -features
show star_lines.png "The same with silhouettes and feature lines."
run $bin/uvol_render "$out/star_inner.ply" "$out/star_turning.html" -color mean_curvature -range -2,2 -colormap coolwarm
echo '<figure><iframe src="star_turning.html" title="the surface"></iframe><figcaption>The same, to turn by dragging.</figcaption></figure>' >>"$page"
run $bin/uvol_measure "$out/star.pcd" "$out/measures.csv" -field star -iso 0.01,0.1
{ echo "<pre>"; grep '^surface at' "$out/report.txt" | escape; echo "</pre>"; } >>"$page"
rm "$out/report.txt"
cat >>"$page" <<'EOF'
<h2>Files beside this page</h2>
<ul>
<li><a href="star_surface.ply">star_surface.ply</a>: three surfaces as points, for CloudCompare, MeshLab, Blender, pcl_viewer
<li><a href="star_surface.vtp">star_surface.vtp</a>: the same for ParaView (colour by isovalue)
<li><a href="star_turning.html">star_turning.html</a>: a surface in one file that any browser shows
<li><a href="measures.csv">measures.csv</a>: figures of two surfaces
<li><a href="star.pcd">star.pcd</a>: the samples themselves
</ul>
<p>Your own data: <code>build/release/bin/uvol info data.csv</code> names its fields, with <code>-field NAME</code> it suggests isovalues,
<code>build/release/bin/uvol isosurface data.csv surface.ply -field NAME -iso VALUE -png picture.png</code> draws a surface.</p>
EOF

cat <<EOF

Done: surfaces of a torn star, straight from a million scattered samples. Pictures, reports and commands:
  xdg-open $page
EOF
