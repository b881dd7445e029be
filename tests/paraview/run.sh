#!/usr/bin/env bash
# Builds the plugin for ParaView, and looks at what its filters write and its representation draws.
# usage: run.sh BUILD_FOLDER FOLDER_OF_PARAVIEW_CONFIG
# Exit status 77: there is no ParaView, or no X server for its window.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$1
paraview=${2:-}
pvbatch=
for root in "$paraview"/../../.. "$paraview"/../../../..; do
  [ -e "$root/bin/pvbatch" ] && pvbatch=$root/bin/pvbatch
done
if [ -z "$paraview" ] || [ -z "$pvbatch" ] || ! command -v xvfb-run >/dev/null; then
  echo "skipped: needs ParaView (-DParaView_DIR=...) and xvfb-run"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake -S "$here/../../src/paraview" -B "$build/paraview" -G Ninja -Dpcl_uvol_DIR="$build" -DParaView_DIR="$paraview"
cmake --build "$build/paraview"
plugin=$(echo "$build"/paraview/lib/paraview-*/plugins/PclUvol/PclUvol.so)
cd "$folder"
"$build/bin/uvol_generate" star.vtp -field star -samples clustered -n 20000
"$build/bin/uvol_generate" torus.vtp -field torus -n 100000

# The filters write what the tool writes.
"$build/bin/uvol_isosurface" star.vtp expected.vtp -field star -iso 0.01
"$pvbatch" "$here/../../src/paraview/example.py" "$plugin" star.vtp star 0.01 surface.vtp
for surface in expected surface; do
  "$build/bin/uvol_convert" $surface.vtp $surface.csv
done
cmp expected.csv surface.csv

xvfb-run -a -s "-screen 0 640x480x24" "$pvbatch" "$here/discs.py" "$plugin" torus.vtp
