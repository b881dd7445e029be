#!/usr/bin/env bash
# Include only downwards (see README, "Modules"), nothing that is not installed in public
# headers, and nothing in these but our own, PCL, Eigen and the standard library, but VTK in
# those of its modules; these include the exceptions that they throw. usage: check_layers.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"

declare -A level=([common]=0 [generation]=1 [neighbors]=1 [distributed]=2 [derivatives]=2
  [interpolation]=3 [isosurface]=4 [levelset]=5 [mesh]=5 [surface]=5 [multivariate]=5 [render]=6 [pipeline]=7
  [expressions]=7
  [filters]=8 [io]=8 [io_vtk]=9 [gl]=10 [vtk]=11 [mpi]=11)
breaches=0
report() {
  echo "$1"
  breaches=$((breaches + 1))
}
include='^[[:space:]]*#[[:space:]]*include[[:space:]]*' # as compilers read it
while IFS=: read -r file included; do
  module=${file#*src/} module=${module#include/pcl_uvol/} module=${module%%/*}
  included=${included##*[<\"]} included=${included#pcl_uvol/} included=${included%/}
  # Others than modules are libraries: pcl/, Eigen/, nlohmann/.
  if [ "$included" != "$module" ] && [ "${level[$included]:--1}" -ge "${level[$module]:-99}" ]; then
    report "$file ($module) may not include $included"
  fi
done < <(grep -roE "$include[\"<](pcl_uvol/)?[a-z_]+/" include/pcl_uvol src 2>/dev/null || true)
while read -r line; do
  report "not installed, but in a public header: $line"
done < <(grep -rnE "$include\"" include 2>/dev/null || true)
while read -r line; do
  report "by a path that the check does not see: $line"
done < <(grep -rnE "$include(\"[^/\"]*\"|[\"<](.*/)?\.\.?/)" include src 2>/dev/null || true)
while read -r line; do
  report "foreign header in a public header: $line"
done < <(grep -rnE "$include<(vtk|teem|flann|nlohmann|omp)" include 2>/dev/null |
  grep -v -E '^include/pcl_uvol/(vtk|filters)/.*<vtk' || true)
while read -r file; do
  report "exceptions without their header: $file"
done < <(grep -rlE '\\throws .*(InvalidArgument|IOError|Diverged)' include 2>/dev/null |
  xargs -r grep -LF '#include <pcl_uvol/common/exceptions.h>' || true)
[ "$breaches" -eq 0 ]
