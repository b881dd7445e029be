#!/usr/bin/env bash
# Builds the tools of another commit as they are built in build/release, and shows which files of the default commands,
# or those of LIST, differ between the two.
# usage: compare.sh COMMIT [LIST]
set -euo pipefail
cd "$(dirname "$0")/../.."
other=$PWD/build/bytes
[ -e "$other" ] || git worktree add -q --detach "$other" "$1"
git -C "$other" checkout -q --detach "$1"
cmake --preset release >/dev/null
cmake --build --preset release --target tools >/dev/null
(cd "$other" && cmake --preset release -DPCL_UVOL_BUILD_TESTS=OFF >/dev/null && cmake --build --preset release --target tools >/dev/null)
list=${2:-tests/bytes/commands.txt}
diff <(bash tests/bytes/run.sh "$other/build/release/bin" "$list") <(bash tests/bytes/run.sh build/release/bin "$list") &&
  echo "compare.sh: the same bytes as $1"
