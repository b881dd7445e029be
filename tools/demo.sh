#!/usr/bin/env bash
# Installs what is missing, builds, and runs the main job on data that it generates itself.
# usage: demo.sh [OUTPUT_FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-demo_output}

bash tools/build.sh tools
mkdir -p "$out"
bin=build/release/bin
run() { printf '\n$ %s\n' "$*"; "$@"; }

run $bin/uvol_generate "$out/star.pcd" -field star -samples clustered -n 1000000
run $bin/uvol_info "$out/star.pcd"
run $bin/uvol_isosurface "$out/star.pcd" "$out/star_surface.ply" -field star -iso 0.001,0.01,0.1
run $bin/uvol_isosurface "$out/star.pcd" "$out/star_surface.vtp" -field star -iso 0.001,0.01,0.1
run $bin/uvol_isosurface "$out/star.pcd" "$out/star_inner.ply" -field star -iso 0.01 -max-error 0.01 \
  -png "$out/star.png" -size 640x480 -color mean_curvature -range -2,2 -colormap coolwarm
run $bin/uvol_render "$out/star_inner.ply" "$out/star_lines.png" -size 640x480 -silhouettes -features

cat <<EOF

Done. The surfaces of a torn star, straight from a million scattered samples:
  $out/star_surface.ply   CloudCompare, MeshLab, Blender, pcl_viewer
  $out/star_surface.vtp   ParaView (colour by isovalue)
  $out/star.pcd           the samples themselves
  $out/star.png           a picture of the inner surface, coloured by its mean curvature
  $out/star_lines.png     the same with silhouettes and feature lines
EOF
