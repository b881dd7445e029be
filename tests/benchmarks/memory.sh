#!/usr/bin/env bash
# Forecasts of memory beside measured peaks, as rows of a table. usage: memory.sh BIN MESH.ply SIZE...
set -euo pipefail
bin=$(realpath "$1") mesh=$(realpath "$2")
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# row NAME SIZE TOOL OPTIONS...: what its report says
row() {
  local name=$1 size=$2
  shift 2
  "$bin/$1" "${@:2}" | sed -nE "s/^memory: forecast (.*), peak (.*)/| $name | $size | \1 | \2 |/p"
}

for size in "$@"; do
  "$bin/uvol_generate" "$folder/star.pcd" -field star -samples clustered -n "$size" >/dev/null
  "$bin/uvol_generate" "$mesh" "$folder/scan.ply" -n "$size" >/dev/null
  cd "$folder"
  row "\`uvol_isosurface -iso 0.01\`" "$size" uvol_isosurface star.pcd out.ply -iso 0.01
  row "\`uvol_levelset -iso 0.01\`" "$size" uvol_levelset star.pcd out.ply -iso 0.01
  row "\`uvol_cluster -attributes star -position\`" "$size" uvol_cluster star.pcd out.ply \
    -attributes star -position
  row "\`uvol_normals\`" "$size" uvol_normals scan.ply out.ply
  row "\`uvol_splats\`" "$size" uvol_splats scan.ply out.ply
  cd - >/dev/null
done
