#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests, on a fresh Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

bash tools/build.sh all gzip clang-format valgrind \
  libosmesa6 libegl1 libegl-mesa0 libgl1-mesa-dri xvfb
ctest --preset release --parallel "$(nproc)"
