#!/usr/bin/env bash
# Feeds every reader and every stage with random bytes (libFuzzer with AddressSanitizer and
# UndefinedBehaviorSanitizer), on Debian 12. Prints per target how many inputs were tried, how many edges of
# the code they reach, and what was found; each finding is a file in build/fuzz/findings/TARGET.
# usage: fuzz.sh [-n EXECUTIONS] SECONDS [TARGET...]: seconds in all, and targets of tests/fuzz/targets.cpp or
# their groups (readers, texts, stages), by default all.
# -n: a target that has had so many executions since its last finding is left out, and ends when it has
# them, so that others get its time. The executions of all calls are listed in build/fuzz/executions.txt, each
# with the commit of the code; those of the table in tests/fuzz/README.md count as well.
# usage: fuzz.sh -r: adds that list to the table, and begins it anew.
# At the end: the share of the lines of our readers (src/io) that was reached; build/fuzz/coverage.txt has those of each file.
# What reaches new code is kept in build/fuzz/corpus and built upon by the next call. Exit code 1 if
# something was found; such a file goes into tests/fuzz/corpus/TARGET once the fault is fixed.
set -euo pipefail
cd "$(dirname "$0")/.."
usage="usage: fuzz.sh [-n EXECUTIONS] SECONDS [TARGET...], or fuzz.sh -r"
tally=build/fuzz/executions.txt
table=tests/fuzz/README.md
if [ "${1-}" = -r ]; then
  [ -f $tally ] || { echo "fuzz.sh: no call has counted anything." >&2; exit 2; }
  awk -v tally=$tally 'BEGIN {
      while ((getline <tally) > 0)
        if ($1 != "#") {
          if ($5) { found[$1] += 1; n[$1] = s[$1] = 0 } else { n[$1] += $3; s[$1] += $4 }
          commit[$1] = $2
        }
    }
    /^[|] [a-z0-9_]+ [|] [0-9]+ [|]/ && $2 in commit {
      if (found[$2]) $4 = $6 = 0
      print "|", $2, "|", $4 + n[$2], "|", $6 + s[$2], "|", $8 + found[$2], "|", commit[$2], "|"; next
    }
    { print }' $table >build/fuzz/table.md
  cp build/fuzz/table.md $table
  rm $tally
  exit
fi
goal=0
if [ "${1-}" = -n ]; then
  goal=${2:?$usage}
  shift 2
fi
seconds=${1:?$usage}
shift
PRESET=fuzz bash tools/build.sh fuzzers clang llvm >/dev/null

# Pairs of a target and its group.
mapfile -t known < <(sed -n 's/.*{"\([a-z0-9_]*\)", Group::\([a-z]*\), .*/\1 \2/p' tests/fuzz/targets.cpp)
targets=()
for wanted in "${@:-.*}"; do
  mapfile -t -O "${#targets[@]}" targets < <(printf '%s\n' "${known[@]}" | awk -v wanted="^($wanted)$" '$1 ~ wanted || $2 ~ wanted { print $1 }')
done
[ ${#targets[@]} -gt 0 ] || { echo "fuzz.sh: there is no target of that name." >&2; exit 2; }
[ "$seconds" -ge ${#targets[@]} ] || { echo "fuzz.sh: $seconds s for ${#targets[@]} targets are too few." >&2; exit 2; }

mkdir -p build/fuzz/coverage
[ -f $tally ] || echo "# target commit executions seconds findings" >$tally
commit=$(git describe --always --dirty)
# Executions and seconds of a target since its last finding.
count_all() {
  awk -v target="$1" '$1 == "|" && $2 == target { n = $4; s = $6 }
    $1 == target { n = $5 ? 0 : n + $3; s = $5 ? 0 : s + $4 } END { print n + 0, s + 0 }' $table $tally
}

# Packed files are unpacked in memory. Where memory was taken is known to few calls, and what was given back is
# kept for as long as an input takes. To get both in full, run the program of the target on the file alone.
[ ! -w /dev/shm ] || export TMPDIR=/dev/shm
export ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=8
found=0
end=$((SECONDS + seconds))
for ((i = 0; i < ${#targets[@]}; ++i)); do
  target=${targets[i]}
  corpus=build/fuzz/corpus/$target findings=build/fuzz/findings/$target
  log=build/fuzz/$target.log
  mkdir -p "$corpus" "$findings"
  each=$(((end - SECONDS) / (${#targets[@]} - i)))
  options=(-max_total_time=$((each > 0 ? each : 1)) -timeout=20 -reload=0 -rss_limit_mb=2048 -print_final_stats=1 "-artifact_prefix=$findings/")
  if [ "$goal" -gt 0 ]; then
    read -r executions _ < <(count_all "$target")
    [ "$executions" -lt "$goal" ] || continue
    options+=("-runs=$((goal - executions))")
  fi
  [ ! -f "tests/fuzz/dictionaries/$target.dict" ] || options+=("-dict=tests/fuzz/dictionaries/$target.dict")
  # What makes its points or tables of these bytes has hundreds of them in a kilobyte, and packed files grow.
  length=1024
  [[ " ${known[*]} " != *" $target readers "* || $target =~ hdf|netcdf|packed ]] || length=4096
  options+=("-max_len=$length")
  # What HDF5 keeps would be searched for leaks after each of the first 1000 inputs that it is kept for, half a minute each call.
  [[ ! $target =~ hdf|netcdf ]] || options+=(-detect_leaks=0)
  # Stages reach so much code that the weights of what is rare took a sixth of the time.
  [[ " ${known[*]} " != *" $target stages "* ]] || options+=(-entropic=0)
  status=0
  start=$SECONDS
  LLVM_PROFILE_FILE=build/fuzz/coverage/$target.profraw OMP_NUM_THREADS=1 "build/fuzz/bin/fuzz_$target" "${options[@]}" "$corpus" "tests/fuzz/corpus/$target" \
    >"$log" 2>&1 || status=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  edges=$(grep -ao 'cov: [0-9]*' "$log" | tail -1 | cut -d ' ' -f 2)
  echo "$target $commit ${executions:-0} $((SECONDS - start)) $((status == 0 ? 0 : 1))" >>$tally
  echo "$target: ${executions:-0} executions, ${edges:-0} edges, $([ $status -eq 0 ] && echo nothing found || echo "see $log")"
  [ $status -eq 0 ] || found=1
done
for target in "${targets[@]}"; do
  read -r executions took < <(count_all "$target")
  echo "$target: $executions executions in $took s since its last finding, or since the first call"
done
compgen -G 'build/fuzz/coverage/*.profraw' >/dev/null || exit $found # all had their executions
llvm-profdata merge -o build/fuzz/coverage/all.profdata build/fuzz/coverage/*.profraw
llvm-cov report build/fuzz/lib/libpcl_uvol_io.so -object build/fuzz/lib/libpcl_uvol_io_vtk.so -instr-profile=build/fuzz/coverage/all.profdata >build/fuzz/coverage.txt
# vtk_data_reader.cpp calls VTK's own readers, which are not fuzzed.
readers='(readers?|scanner|tags|nrrd|meta_image|volume_data|volume_header|pcd_io|hdf5_[a-z]*|netcdf_[a-z]*|scene_[a-z]*|text_rows|encoded_bytes|unpacked_file|file_cursor|snapshot|position_tables)[.]cpp$'
awk -v readers="$readers" '$1 ~ "src/io(_vtk)?/" && $1 ~ readers && $1 !~ /_writer|vtk_data_reader/ { lines += $8; missed += $9 }
  END { printf "readers: %.1f %% of %d lines reached\n", 100 * (1 - missed / lines), lines }' build/fuzz/coverage.txt
exit $found
