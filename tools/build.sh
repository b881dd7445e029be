#!/usr/bin/env bash
# Installs what building needs and builds a preset, release unless $PRESET names another one. Shared by
# tools/demo.sh, tools/check.sh and tests/run.sh.
# usage: build.sh TARGET [PACKAGE...]: the target (all, tools, demo; help builds nothing) and further packages
# to install. $CONFIGURE: further options for CMake.
set -euo pipefail
cd "$(dirname "$0")/.."
target=$1
preset=${PRESET:-release}
shift

bash tools/install_dependencies.sh \
  build-essential cmake ninja-build ccache \
  libpcl-dev libvtk9-dev libflann-dev liblz4-dev zlib1g-dev nlohmann-json3-dev libmuparser-dev libbz2-dev libzstd-dev libnetcdf-dev \
  pybind11-dev python3-dev python3-numpy python3-pytest \
  libcairo2-dev pkgconf libgl-dev libegl-dev libx11-dev libopenmpi-dev openmpi-bin \
  libgtest-dev libgmock-dev "$@"
# A compiler cache that is empty can only cost time: a first build does not fill it.
[ -e "build/$preset" ] || ccache --print-stats | grep -qP '^files_in_cache\t[1-9]' || export CCACHE_DISABLE=1
# shellcheck disable=SC2086 # options are words
cmake --preset "$preset" ${CONFIGURE:-}
cmake --build --preset "$preset" --target "$target"
