#!/usr/bin/env bash
# Runs the commands of a list and prints the SHA-256 of every file that they write, and
# of their reports, which go without times, bytes of memory and the name of the processor's
# instruction set.
# usage: run.sh [-write] [-keep FOLDER] FOLDER_OF_TOOLS [LIST]
# -keep leaves the files in FOLDER, and the reports as they were printed in FOLDER.reports.
# Results come first, then reports. Those of the default commands have to be results.txt and reports.txt, which -write
# writes. Another compiler may round otherwise: compare.sh builds an older commit beside this tree.
set -euo pipefail
writes=no
kept=
while [[ ${1:-} == -* ]]; do
  case $1 in
    -write) writes=yes ;;
    -keep)
      kept=$2
      shift
      ;;
  esac
  shift
done
here=$(cd "$(dirname "$0")" && pwd)
tools=$(cd "$1" && pwd)
list=$(realpath "${2:-$here/commands.txt}")

# The mathematical functions of the C library round differently with fused
# multiply-adds: without them all processors give the same digits.
export GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

if [ -n "$kept" ]; then
  rm -rf "$kept" "$kept.reports"
  folder=$kept
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder" "$folder.reports"' EXIT
fi
mkdir -p "$folder" "$folder.reports"
cd "$folder"
while read -r tool arguments; do
  [[ -z $tool || $tool == \#* ]] && continue
  files=${arguments%% -*}
  report=report_of_${files##* }.json
  raw=$PWD.reports/$report
  # shellcheck disable=SC2086 # arguments are words
  "$tools/$tool" $arguments -json >"$raw" 2>>"$raw" ||
    { echo "failed: $tool $arguments" >&2; cat "$raw" >&2; exit 1; }
  sed -e '/"milliseconds"/,/}/d' -e '/"memory": {/,/}/d' -e '/"backend"/d' "$raw" >"$report"
done <"$list"
sums() {
  find . -type f "$@" -name 'report_of_*' | LC_ALL=C sort | xargs -rd '\n' sha256sum
}
if [ "$writes" = yes ]; then
  sums ! >"$here/results.txt"
  sums >"$here/reports.txt"
else
  sums !
  sums
fi
