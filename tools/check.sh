#!/usr/bin/env bash
# Checks that go beyond the tests, on Debian 12; prints what each ran and how long it took.
# usage: check.sh [STEP...], by default all in this order:
#   format     clang-format has nothing to change, and tags of Doxygen begin their lines
#   spelling   codespell knows no misspelt word in what git knows, data excluded
#   layers     includes go downwards only
#   tidy       clang-tidy finds nothing in any source of the release preset
#   asan tsan  every test passes under the sanitizers of that preset
#   mutation   tests notice changed numbers (tests/mutation/run.py)
# What passed is kept in build/check and not repeated while no file changes (tidy: neither the source
# nor any header), so that a call goes on where the one before it ended.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p build/check

fingerprint() { # FILE_PATTERN...: of the files that git knows or would take
  # Files that are deleted but not yet so for git have no sum.
  git ls-files -coz --exclude-standard "$@" | { xargs -0 sha256sum 2>/dev/null || true; } | sha256sum | cut -d ' ' -f 1
}

once() { # NAME COMMAND...: runs the command unless it passed on these files
  local name=$1 start=$SECONDS
  shift
  if [ "$(cat "build/check/$name" 2>/dev/null)" = "$tree" ]; then
    echo "check.sh: $name passed before on these files"
    return
  fi
  echo "check.sh: $name: $*"
  "$@" || { echo "check.sh: $name failed after $((SECONDS - start)) s" >&2; exit 1; }
  echo "$tree" >"build/check/$name"
  echo "check.sh: $name passed in $((SECONDS - start)) s"
}

check_format() {
  bash tools/install_dependencies.sh clang-format || return
  git ls-files -z '*.h' '*.hpp' '*.cpp' | xargs -0 clang-format --dry-run -Werror || return
  # It joins lines of comments, tags of Doxygen among them.
  if git grep -nE '[^ */].*\s\\(brief|t?param|return|throws|copydoc)\b' -- '*.h' '*.hpp' '*.cpp'; then
    echo "check.sh: a tag of Doxygen begins its line" >&2
    return 1
  fi
}

check_spelling() {
  bash tools/install_dependencies.sh codespell || return
  # Terms and names that it takes for others; \n before a word of a string; pictures of notebooks.
  git ls-files -z -- ':!tests/data' ':!tests/fuzz/corpus' | xargs -0 codespell --quiet-level 3 --check-hidden \
    --ignore-words-list ore,pres,unser,positionof,nin --ignore-regex '[A-Za-z0-9+/=\\]{77,}'
}

tidy_file() { # FILE FINGERPRINT_OF_HEADERS
  local key
  key="$(sha256sum "$1") $2"
  grep -qxF "$key" build/check/tidy_files 2>/dev/null && return
  echo "clang-tidy $1"
  clang-tidy --quiet -p build/tidy "$1" && echo "$key" >>build/check/tidy_files
}
export -f tidy_file

check_tidy() {
  # What g++ has precompiled clang-tidy cannot read, and headers that a source forgets to include are seen without.
  bash tools/build.sh help clang-tidy libomp-dev >/dev/null &&
    cmake --preset release -B build/tidy -DPCL_UVOL_PRECOMPILE_HEADERS=OFF -DPCL_UVOL_UNITY=OFF >/dev/null || return
  local headers
  headers=$(fingerprint '*.clang-tidy' '*.h' '*.hpp')
  sed -n "s|.*\"file\": \"$PWD/\(.*\.cpp\)\".*|\1|p" build/tidy/compile_commands.json | sort -u |
    xargs -P "$(nproc)" -I{} bash -c 'tidy_file "$@"' - {} "$headers"
}

check_preset() { # PRESET: its tests, one module after the other
  PRESET=$1 bash tools/build.sh all clang libomp-dev xvfb libosmesa6 libegl1 libegl-mesa0 libgl1-mesa-dri ||
    return
  local label
  for label in $(ctest --preset "$1" --print-labels | sed -n 's/^  //p'); do
    once "$1_$label" ctest --preset "$1" --parallel "$(nproc)" --label-regex "^$label\$"
  done
}

tree=$(fingerprint)
steps=("$@")
[ $# -gt 0 ] || steps=(format spelling layers tidy asan tsan mutation)
for step in "${steps[@]}"; do
  case $step in
    format | spelling | tidy) once "$step" "check_$step" ;;
    layers) once layers bash tests/tools/check_layers.sh . ;;
    asan | tsan) once "$step" check_preset "$step" ;;
    mutation) once mutation python3 tests/mutation/run.py ;;
    *)
      echo "check.sh: there is no step '$step'; there are format, spelling, layers, tidy, asan, tsan and mutation." >&2
      exit 2
      ;;
  esac
done
