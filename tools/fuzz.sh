#!/usr/bin/env bash
# Feeds every reader and every stage with random bytes (libFuzzer with AddressSanitizer and
# UndefinedBehaviorSanitizer), on Debian 12. Prints per target how many inputs were tried, how many edges of
# the code they reach, and what was found; each finding is a file in build/fuzz/findings/TARGET.
# usage: fuzz.sh SECONDS [TARGET...]: seconds in all, and targets of tests/fuzz/targets.cpp, by default all.
# At the end: the share of the lines of our readers (src/io) that was reached; build/fuzz/coverage.txt has those of each file.
# What reaches new code is kept in build/fuzz/corpus and built upon by the next call. Exit code 1 if
# something was found; such a file goes into tests/fuzz/corpus/TARGET once the fault is mended.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:?usage: fuzz.sh SECONDS [TARGET...]}
shift
PRESET=fuzz bash tools/build.sh fuzzers clang llvm >/dev/null
targets=("$@")
[ $# -gt 0 ] || mapfile -t targets < <(sed -n 's/.*{"\([a-z_]*\)", .*/\1/p' tests/fuzz/targets.cpp)
each=$((seconds / ${#targets[@]}))
[ "$each" -gt 0 ] || { echo "fuzz.sh: $seconds s for ${#targets[@]} targets are too few." >&2; exit 2; }

mkdir -p build/fuzz/coverage
found=0
for target in "${targets[@]}"; do
  corpus=build/fuzz/corpus/$target findings=build/fuzz/findings/$target
  log=build/fuzz/$target.log
  mkdir -p "$corpus" "$findings"
  options=(-max_total_time="$each" -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 "-artifact_prefix=$findings/")
  [ ! -f "tests/fuzz/dictionaries/$target.dict" ] || options+=("-dict=tests/fuzz/dictionaries/$target.dict")
  # Stages make their points of these bytes; a kilobyte is 250 of them.
  grep -qw "$target" <<<"pcd ply text legacy_vtk xml_vtk nrrd meta_image gadget bgeo las npy npz scene" || options+=(-max_len=1024)
  status=0
  LLVM_PROFILE_FILE=build/fuzz/coverage/$target.profraw OMP_NUM_THREADS=1 "build/fuzz/bin/fuzz_$target" "${options[@]}" "$corpus" "tests/fuzz/corpus/$target" \
    >"$log" 2>&1 || status=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  edges=$(grep -ao 'cov: [0-9]*' "$log" | tail -1 | cut -d ' ' -f 2)
  echo "$target: ${executions:-0} executions, ${edges:-0} edges, $([ $status -eq 0 ] && echo nothing found || echo "see $log")"
  [ $status -eq 0 ] || found=1
done
llvm-profdata merge -o build/fuzz/coverage/all.profdata build/fuzz/coverage/*.profraw
llvm-cov report build/fuzz/lib/libpcl_uvol_io.so -instr-profile=build/fuzz/coverage/all.profdata >build/fuzz/coverage.txt
readers='(reader|scanner|tags|nrrd|meta_image|volume_data|volume_header|pcd_io|hdf5_[a-z]*|scene_[a-z]*|text_rows|encoded_bytes|file_cursor|snapshot|position_tables)[.]cpp$'
awk -v readers="$readers" '$1 ~ "src/io/" && $1 ~ readers { lines += $8; missed += $9 }
  END { printf "readers: %.1f %% of %d lines reached\n", 100 * (1 - missed / lines), lines }' build/fuzz/coverage.txt
exit $found
