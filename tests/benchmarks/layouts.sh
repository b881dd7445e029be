#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Instructions that fits take per isopoint of each layout of bench_robustness, beside
# those of uniform samples: a count that other work on the machine does not disturb.
# usage: layouts.sh BIN [SAMPLES] [PART OF A LAYOUT'S NAME]   (needs valgrind)
set -euo pipefail
program=$1/bench_robustness samples=${2:-20000} wanted=${3:-}
counts=$(mktemp)
trap 'rm -f "$counts"' EXIT

# Print the isopoints of a layout and the instructions of one of them.
count() {
  local isopoints
  isopoints=$(PCL_UVOL_SIMD=avx2 valgrind --tool=callgrind --callgrind-out-file="$counts" \
    "$program" "$samples" once "$1" 2>/dev/null | awk '{print $1}')
  callgrind_annotate --inclusive=yes --threshold=100 "$counts" |
    awk -v n="$isopoints" '/:pcl_uvol::fitRoots\(/ {gsub(",", "", $1); print n, int($1 / n); exit}'
}

read -r _ uniform <<<"$(count uniform)"
printf '%-42s %10s %12s %7s\n' layout isopoints instructions ratio
while read -r layout; do
  [[ $layout == *"$wanted"* ]] || continue
  read -r isopoints each <<<"$(count "$layout")"
  awk -v l="$layout" -v n="$isopoints" -v e="$each" -v u="$uniform" \
    'BEGIN {printf "%-42s %10d %12d %7.2f\n", l, n, e, e / u}'
done < <("$program" 1000 names)
