#!/usr/bin/env bash
# Builds the examples against an installed library or a build folder, runs them, and holds what they print
# against what is true.
# usage: run.sh CMAKE_PACKAGE_FOLDER: that of pcl_uvolConfig.cmake; where it is a build folder with the Python module, or
# $PCL_UVOL_PYTHON names the folder of the module, the example in Python runs as well, by $PYTHON.
set -euo pipefail
source_dir=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake -S "$source_dir" -B "$folder" -G Ninja -Dpcl_uvol_DIR="$1" >"$folder/log" || { cat "$folder/log"; exit 1; }
cmake --build "$folder"

# expect PATTERN COMMAND...: the command succeeds, and a line of what it prints matches.
expect() {
  local pattern=$1
  shift
  "$@" >"$folder/out" || { echo "$* failed"; exit 1; }
  cat "$folder/out"
  grep -Eq "$pattern" "$folder/out" || { echo "$1 printed no line like $pattern"; exit 1; }
}

cd "$folder"
printf 'x,y,z,rho,t\n' >in.csv
for i in $(seq 0 999); do
  echo "$((i % 10)),$((i / 10 % 10)),$((i / 100)),$((i % 10 + i / 10 % 10 + i / 100)),$i"
done >>in.csv
expect '^[1-9][0-9]* isopoints with x y z .* rho t$' ./extract_with_fields in.csv out.ply rho 13.5
expect 'at radius 0\.(79|80)' ./own_point_type
expect '^[1-9][0-9]* isopoints, the last one of isovalue 0\.6$' ./live_isovalues
expect '^deviation .* 0\.02[0-9]* directly, 0\.00' ./level_set
expect '^0\.(69999|7)[0-9]* \+- ' ./probe
expect 'area 3\.1[34].*volume 0\.52' ./mesh_measures
expect '^1 clusters, [1-9][0-9]* triangles$' ./pcl_algorithms
expect '^written: [1-9][0-9]* splats$' ./vtk_pipeline splats.vtp
python=${PYTHON:-/usr/bin/python3}
module=${PCL_UVOL_PYTHON:-$1/python}
if [ -e "$module/pcl_uvol" ]; then
  PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$module \
    expect '^[1-9][0-9]* triangles, volume 0\.523[56].*genus 0$' "$python" "$source_dir/isosurface.py"
fi
if [ -x mpi ]; then
  expect '^[1-9][0-9]* isopoints, [1-9][0-9]* of them' \
    mpirun -q --allow-run-as-root --oversubscribe -np 3 ./mpi
fi
if command -v xvfb-run >/dev/null; then
  xvfb-run -a ./pcl_visualizer window.png 2>"$folder/log" || { cat "$folder/log"; exit 1; }
  [ "$(stat -c %s window.png)" -gt 20000 ] # an empty window is smaller
fi
