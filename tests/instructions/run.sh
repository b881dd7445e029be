#!/usr/bin/env bash
# Counts the instructions of a few kernels with callgrind and holds them within 10 % of
# expected.txt, so that speed does not rot. After a deliberate change: run.sh BIN_DIR --update.
set -euo pipefail
bin=$1
here=$(cd "$(dirname "$0")" && pwd)
# The instruction set must not depend on the machine.
export PCL_UVOL_SIMD=baseline
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

count() {
  valgrind --tool=callgrind --callgrind-out-file="$scratch/$1" --collect-atstart=no \
    --toggle-collect=measured "$bin/count_kernels" "$1" 2>"$scratch/log" >&2 ||
    { cat "$scratch/log" >&2; return 1; }
  awk '/^(summary|totals):/ { print $2; exit }' "$scratch/$1"
}

status=0
: >"$scratch/new"
while read -r kernel expected; do
  counted=$(count "$kernel")
  echo "$kernel $counted" >>"$scratch/new"
  awk -v k="$kernel" -v e="$expected" -v c="$counted" 'BEGIN {
    printf "%-18s %12d instructions, expected %12d (%+.1f %%)\n", k, c, e, 100 * (c - e) / e
    exit !(c > 0 && c >= 0.9 * e && c <= 1.1 * e) }' || status=1
done <"$here/expected.txt"
if [ "${2:-}" = --update ]; then
  cp "$scratch/new" "$here/expected.txt"
  exit 0
fi
[ $status -eq 0 ] || echo "Instructions changed by more than 10 %: explain it, then run.sh BIN_DIR --update." >&2
exit $status
