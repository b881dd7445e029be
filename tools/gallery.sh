#!/usr/bin/env bash
# Makes the pictures of real data in docs/guide/gallery.md.
# usage: gallery.sh FOLDER_OF_TOOLS FOLDER_OF_DATA FOLDER_OF_PICTURES
# The data are volumes, particles, sensors and scans whose sources the page names.
set -euo pipefail
tools=$(cd "$1" && pwd)
data=$(cd "$2" && pwd)
mkdir -p "$3"
pictures=$(cd "$3" && pwd)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
run() {
  local tool=$1
  shift
  "$tools/$tool" "$@" >log 2>&1 || { cat log >&2; exit 1; }
}

run uvol_generate "$data/volumes/engine.nhdr" engine.pcd
run uvol_isosurface engine.pcd engine.ply -iso 60,180 -opacity 0.25,1 \
  -png "$pictures/engine.png" -size 480x400 -ticks
run uvol_render engine.ply "$pictures/engine_views.png" -views iso,top,front -ticks -size 900x460
run uvol_generate "$data/volumes/fuel.nhdr" fuel.pcd
run uvol_isosurface fuel.pcd fuel.ply -iso 10,50,150 -opacity 0.25,0.4,1 \
  -png "$pictures/fuel.png" -size 480x300
run uvol_generate "$data/volumes/hydrogenAtom.nhdr" hydrogen.pcd
run uvol_isosurface hydrogen.pcd hydrogen.ply -iso 4,16,40 -opacity 0.35,0.5,1 \
  -png "$pictures/hydrogen.png" -size 480x360 -view front -box -triad
run uvol_isosurface "$data/particles/starsmasher_giant.csv" star.ply -field rho -iso 0.001,0.1 -opacity 0.4,1 -color u \
  -png "$pictures/star.png" -size 480x400 -ticks -unit Rsun -title "Internal energy at two densities"
run uvol_isosurface "$data/cfd/disk_out_ref.vtu" reactor.ply -field Temp -iso 400,600 -opacity 0.35,1 \
  -png "$pictures/reactor.png" -size 480x400 -ticks
run uvol_render "$data/scans/dragon_res3.ply" "$pictures/dragon.png" -up 0,1,0 -view front -size 480x360 \
  -scale-bar -unit m -triad

# Slices of the field between samples.
run uvol_probe "$data/particles/starsmasher_giant.csv" star.vti -field "log10(rho)" -plane z=0 -box -4,-4,-4,4,4,4 \
  -size 400 -contours -3,-2,-1 -unit Rsun -label "log density" -png "$pictures/star_slice.png"
run uvol_probe "$data/sensors/babbitt_drillholes.csv" drill_holes.vti -field cu_pct -plane z=1000 -model kriging -octants \
  -size 400 -range 0,1 -contours 0.3,0.6 -unit ft -label "copper in %" -png "$pictures/drill_holes_slice.png"
