#!/usr/bin/env bash
# Installs what building needs and builds a preset, release unless $PRESET names another one. Shared by
# tools/demo.sh, tools/check.sh and tests/run.sh.
# usage: build.sh TARGET [PACKAGE...]: the target (all, tools, demo; help builds nothing) and further packages
# to install. $CONFIGURE: further options for CMake.
# If demo is the first thing that is built, Python's module, MPI and the tests are left out, with the packages
# that only they need. Any other target has them all.
set -euo pipefail
cd "$(dirname "$0")/.."
target=$1
preset=${PRESET:-release}
shift

packages=(build-essential cmake ninja-build ccache
  libpcl-dev libvtk9-dev libflann-dev liblz4-dev liblzf-dev libpng-dev zlib1g-dev nlohmann-json3-dev libmuparser-dev
  libbz2-dev libzstd-dev liblzma-dev libnetcdf-dev libcairo2-dev pkgconf libgl-dev libegl-dev libx11-dev)
configure=()
cache=build/$preset/CMakeCache.txt
if [ "$target" != demo ]; then
  packages+=(pybind11-dev python3-dev python3-numpy python3-pytest libopenmpi-dev openmpi-bin libgtest-dev libgmock-dev)
  ! grep -qs '^PCL_UVOL_BUILD_TESTS:.*=OFF' "$cache" || configure=(--fresh)
elif [ ! -e "$cache" ]; then
  configure=(-DPCL_UVOL_BUILD_PYTHON=OFF -DPCL_UVOL_BUILD_MPI=OFF -DPCL_UVOL_BUILD_TESTS=OFF)
fi
bash tools/install_dependencies.sh "${packages[@]}" "$@"
# A compiler cache that is empty can only cost time: a first build does not fill it.
[ -e "build/$preset" ] || ccache --print-stats | grep -qP '^files_in_cache\t[1-9]' || export CCACHE_DISABLE=1
# shellcheck disable=SC2086 # options are words
cmake --preset "$preset" "${configure[@]}" ${CONFIGURE:-}
cmake --build --preset "$preset" --target "$target"
