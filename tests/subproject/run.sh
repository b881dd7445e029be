#!/usr/bin/env bash
# Builds core alone within another project, where no VTK is found, and runs a program that links it;
# the same with the package of that build. Sees refused what cannot be.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# With the flags of the other tests a compiler cache has seen all of it.
options=(-G Ninja -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON -DCMAKE_BUILD_TYPE=Release)
command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

cmake -S "$here" -B "$folder/build" "${options[@]}" -DPCL_UVOL_SOURCE_DIR="$here/../.." \
  -DPCL_UVOL_WARNINGS_AS_ERRORS=ON -DPCL_UVOL_INSTALL=ON
cmake --build "$folder/build"
test "$(cd "$folder/build" && find . -name 'libpcl_uvol_*.so')" = ./pcl_uvol/src/libpcl_uvol_core.so
"$folder/build/sphere" | grep -E '^[1-9][0-9]* isopoints'

cmake --install "$folder/build" --prefix "$folder/prefix"
options+=(-DCMAKE_PREFIX_PATH="$folder/prefix")
cmake -S "$here" -B "$folder/with_package" "${options[@]}" -DCOMPONENTS=core
cmake --build "$folder/with_package"
LD_LIBRARY_PATH="$folder/prefix/lib" "$folder/with_package/sphere" | grep -E '^[1-9][0-9]* isopoints'

# usage: refuses SENTENCE SOURCE_FOLDER OPTION...
refuses() {
  local sentence=$1 source=$2
  shift 2
  if cmake -S "$source" -B "$folder/refused" "$@" >"$folder/log" 2>&1; then
    echo "not refused: $*" >&2
    return 1
  fi
  tr -s ' \n' ' ' <"$folder/log" | grep -F "$sentence"
  rm -r "$folder/refused"
}
refuses "This pcl_uvol has no vtk; it has core." "$here" "${options[@]}" -DCOMPONENTS=vtk
refuses "PCL_UVOL_BUILD_TOOLS needs PCL_UVOL_BUILD_IO:" "$here/../.." -G Ninja \
  -DPCL_UVOL_BUILD_IO=OFF -DPCL_UVOL_BUILD_TOOLS=ON
refuses "PCL_UVOL_BUILD_VTK needs PCL_UVOL_BUILD_GL:" "$here/../.." -G Ninja \
  -DPCL_UVOL_BUILD_GL=OFF -DPCL_UVOL_BUILD_VTK=ON
