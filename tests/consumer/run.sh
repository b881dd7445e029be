#!/usr/bin/env bash
# Installs a build into a prefix of its own and builds and runs a project that finds it there.
# usage: run.sh BUILD_FOLDER [all]: the examples of the README; all: algorithms of PCL, windows and ranks as well
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
# The project and the program of the README, as they are printed there.
block() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$source_dir/../../README.md" | sed '/^```/d'; }
mkdir "$folder/readme"
block cmake >"$folder/readme/CMakeLists.txt"
block cpp >"$folder/readme/main.cpp"
cmake -S "$folder/readme" -B "$folder/readme/build" -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG
cmake --build "$folder/readme/build"
"$folder/readme/build/mine" | grep -E '^[1-9][0-9]* isopoints'
"$folder/prefix/bin/uvol_isosurface" -version
"$folder/prefix/bin/uvol" viewer -version
test -s "$folder/prefix/share/man/man1/uvol_isosurface.1"
test -s "$folder/prefix/share/bash-completion/completions/uvol_isosurface"
