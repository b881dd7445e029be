#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests, on a fresh Debian 12.
set -euo pipefail
cd "$(dirname "$0")/.."

bash tools/build.sh all gzip clang-format valgrind
ctest --preset release --parallel "$(nproc)"
