#!/usr/bin/env bash
# Installs a build into a prefix of its own and builds and runs a project that finds it there.
# usage: run.sh BUILD_FOLDER [all]: the program of the quickstart; all: algorithms of PCL, windows and ranks as well
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
# The project and the program of the quickstart, as they are printed there, in tabs.
block() { sed -n "/^    \`\`\`$1\$/,/^    \`\`\`\$/p" "$source_dir/../../docs/quickstart.md" | sed '/^    ```/d; s/^    //'; }
mkdir "$folder/quickstart"
block cmake >"$folder/quickstart/CMakeLists.txt"
block cpp >"$folder/quickstart/main.cpp"
cmake -S "$folder/quickstart" -B "$folder/quickstart/build" -G Ninja -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG
cmake --build "$folder/quickstart/build"
"$folder/quickstart/build/mine" | grep -E '^[1-9][0-9]* isopoints'
"$folder/prefix/bin/uvol_isosurface" -version
"$folder/prefix/bin/uvol" viewer -version
test -s "$folder/prefix/share/man/man1/uvol_isosurface.1"
test -s "$folder/prefix/share/bash-completion/completions/uvol_isosurface"
