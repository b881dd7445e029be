#!/usr/bin/env bash
# Include only downwards (see README, "Rooms"), and nothing but our own, PCL, Eigen and the
# standard library in public headers, but VTK in those of its rooms. usage: check_layers.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"

declare -A level=([common]=0 [neighbors]=1 [distributed]=2 [derivatives]=2 [interpolation]=3 [isosurface]=4 [levelset]=5
  [surface]=5 [multivariate]=5 [render]=6 [pipeline]=7 [filters]=8 [io]=9 [gl]=10 [vtk]=11 [mpi]=11)
breaches=0
for module in "${!level[@]}"; do
  for file in $(find "include/pcl_uvol/$module" "src/$module" -type f 2>/dev/null); do
    for included in $(sed -nE 's|^#include [<"]pcl_uvol/([a-z]+)/.*|\1|p' "$file" | sort -u); do
      if [ "$included" != "$module" ] && [ "${level[$included]:-99}" -ge "${level[$module]}" ]; then
        echo "$file ($module) may not include $included"
        breaches=$((breaches + 1))
      fi
    done
  done
done
while read -r line; do
  echo "foreign header in a public header: $line"
  breaches=$((breaches + 1))
done < <(grep -rnE '^#include <(vtk|teem|flann|nlohmann|omp)' include | grep -v -E '^include/pcl_uvol/(vtk|filters)/.*<vtk' || true)
[ "$breaches" -eq 0 ]
