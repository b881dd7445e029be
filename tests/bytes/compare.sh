#!/usr/bin/env bash
# Builds the tools of another commit as they are built in build/release, and shows which results of the default commands,
# or of those of LIST, differ between the two. Reports are not compared.
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
results() {
  bash tests/bytes/run.sh "$1" "$list" | grep -v report_of_
}
diff <(results "$other/build/release/bin") <(results build/release/bin) && echo "compare.sh: the same results as $1"
