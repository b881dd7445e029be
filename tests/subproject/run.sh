#!/usr/bin/env bash
# Builds core alone within another project, where no VTK is found, runs a program that links it,
# and sees combinations of parts refused that cannot be.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# With the flags of the other tests a compiler cache has seen all of it.
cmake -S "$here" -B "$folder/build" -G Ninja -DPCL_UVOL_SOURCE_DIR="$here/../.." \
  -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON -DCMAKE_BUILD_TYPE=Release -DPCL_UVOL_WARNINGS_AS_ERRORS=ON \
  $(command -v ccache >/dev/null && echo -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake --build "$folder/build"
test "$(find "$folder/build" -name 'libpcl_uvol_*.so')" = "$folder/build/pcl_uvol/src/libpcl_uvol_core.so"
"$folder/build/sphere" | grep -E '^[1-9][0-9]* isopoints'

# usage: refuses SENTENCE OPTION...
refuses() {
  local sentence=$1
  shift
  if cmake -S "$here/../.." -B "$folder/refused" -G Ninja "$@" >"$folder/log" 2>&1; then
    echo "not refused: $*" >&2
    return 1
  fi
  tr -s ' \n' ' ' <"$folder/log" | grep -F "$sentence"
  rm -r "$folder/refused"
}
refuses "PCL_UVOL_BUILD_TOOLS needs PCL_UVOL_BUILD_IO:" -DPCL_UVOL_BUILD_IO=OFF -DPCL_UVOL_BUILD_TOOLS=ON
refuses "PCL_UVOL_BUILD_VTK needs PCL_UVOL_BUILD_GL:" -DPCL_UVOL_BUILD_GL=OFF -DPCL_UVOL_BUILD_VTK=ON
