#!/usr/bin/env bash
# Installs what is missing, builds everything and runs tests, on a fresh Debian 12.
# usage: run.sh [all | all:PART]
#   without argument: the default tests, which take at most 25 minutes on 2 quiet cores
#   all: every test, one part after the other
#   all:PART: one part, at most 60 minutes:
#     default   those that run without argument
#     long      those with ctest's label "long": names that end in _long, and core built alone
# Sanitizers, clang-tidy and mutations: tools/check.sh.
set -euo pipefail
cd "$(dirname "$0")/.."

asked=${1:-all:default}
case $asked in
  all) parts=(default long) ;;
  all:default | all:long) parts=("${asked#all:}") ;;
  *)
    echo "run.sh: there is no part '$asked'; use all, all:default, all:long or no argument." >&2
    exit 2
    ;;
esac

bash tools/build.sh all gzip clang-format codespell valgrind \
  libosmesa6 libegl1 libegl-mesa0 libgl1-mesa-dri xvfb \
  python3-pandas python3-xarray python3-h5py python3-vtk9 python3-pip python3-venv python3-setuptools python3-wheel \
  doxygen python3-jsonschema python3-nbclient python3-nbformat python3-ipykernel
declare -A labels=([default]=--label-exclude [long]=--label-regex)
for part in "${parts[@]}"; do
  ctest --preset release --parallel "$(nproc)" "${labels[$part]}" '^long$'
done
