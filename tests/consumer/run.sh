#!/usr/bin/env bash
# Installs a build into a prefix of its own and builds and runs a project that finds it there.
# usage: run.sh BUILD_FOLDER [all]: the programs of docs/quickstart.md and docs/guide/library.md; all: algorithms of PCL,
# windows and ranks as well
set -euo pipefail
source_dir=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$1" --prefix "$folder/prefix" >"$folder/install.log"
cmake -S "$source_dir" -B "$folder/build" -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG
targets=(--target consumer)
[ "${2:-}" != all ] || targets=()
cmake --build "$folder/build" "${targets[@]}"
"$folder/build/consumer" | tee "$folder/out"
grep -Eq '^[1-9][0-9]* isopoints' "$folder/out"
if [ "${2:-}" = all ]; then
  test "$("$folder/build/algorithms_consumer")" = "2 clusters, some triangles"
  grep -Eq '^1 clusters, [1-9][0-9]* triangles$' <("$folder/build/normals_consumer")
  test "$("$folder/build/window_consumer")" = "bounds from 3"
  if [ -e "$folder/prefix/include/pcl_uvol/mpi" ]; then
    test "$("$folder/build/ranks_consumer")" = "rank 0 of 1"
  fi
fi
# The projects and programs of two pages, as they are printed there: the first block of each kind, which may be in a tab.
block() { awk -v mark="\`\`\`$2" '{sub(/^    /, "")} /^```/ && on {exit} on {print} $0 == mark {on = 1}' "$source_dir/../../docs/$1.md"; }
for page in quickstart guide/library; do
  project="$folder/$page"
  mkdir -p "$project"
  block "$page" cmake >"$project/CMakeLists.txt"
  block "$page" cpp >"$project/main.cpp"
  cmake -S "$project" -B "$project/build" -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG
  cmake --build "$project/build"
  "$project/build/mine" | tee "$folder/out"
  grep -Eq '^[1-9][0-9]* isopoints' "$folder/out"
done
test "$(wc -l <"$folder/out")" = 1 # guide/library.md promises no warning
"$folder/prefix/bin/uvol_isosurface" -version
"$folder/prefix/bin/uvol" viewer -version
test -s "$folder/prefix/share/man/man1/uvol_isosurface.1"
test -s "$folder/prefix/share/bash-completion/completions/uvol_isosurface"
