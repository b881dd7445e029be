#!/usr/bin/env bash
# Installs each Debian package of a folder into a fresh Debian 12 of its own, with what it depends on and nothing
# else, uses it there, and lists what came with it. Core and its project must come without VTK, and no package but
# those of the viewer and of MPI may depend on Qt, X11 or MPI itself.
# usage: package_chroot.sh FOLDER_OF_PACKAGES [TABLE]; as root; TABLE: a file for the table of what comes along
# $MIRROR: Debian's packages, http://deb.debian.org/debian unless it says otherwise. Exit code 77: cannot be done here.
set -euo pipefail
packages=$(cd "$1" && pwd)
table=${2:-/dev/null}
here=$(cd "$(dirname "$0")/.." && pwd)
mirror=${MIRROR:-http://deb.debian.org/debian}
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "package_chroot.sh: it needs root and debootstrap." >&2
  exit 77
fi

work=$(mktemp -d)
leave() {
  umount "$work"/*/proc 2>/dev/null || true
  rm -rf --one-file-system "$work"
}
trap leave EXIT
debootstrap --variant=minbase bookworm "$work/base" "$mirror" >"$work/log" 2>&1 || { tail "$work/log"; exit 77; }
cp /etc/resolv.conf "$work/base/etc/"
printf 'x,y,z,rho\n' >"$work/base/root/samples.csv"
awk 'BEGIN { srand(1); for (i = 0; i < 5000; ++i) { x = rand(); y = rand(); z = rand();
  printf "%g,%g,%g,%g\n", x, y, z, exp(-8 * ((x - .5)^2 + (y - .5)^2 + (z - .5)^2)) } }' >>"$work/base/root/samples.csv"
cp -r "$here/tests/consumer" "$work/base/root/consumer"
chroot "$work/base" apt-get update -qq

# Own dependencies; what others pull in is the concern of Debian.
for package in "$packages"/*.deb; do
  name=$(dpkg-deb -f "$package" Package)
  case $name in
    pcl-uvol-viewer | *-mpi*) continue ;;
  esac
  if dpkg-deb -f "$package" Depends | tr ',' '\n' | grep -E 'qt[0-9]|openmpi|mpich|libx11|uvol-mpi'; then
    echo "package_chroot.sh: $name depends on Qt, X11 or MPI itself." >&2
    exit 1
  fi
done

echo "| package | packages that come with it | MB | of VTK | of Qt | of MPI |" >"$table"
echo "|---|---|---|---|---|---|" >>"$table"

# install NAME FURTHER_PACKAGES COMMAND: a package with its dependencies in a system of its own, used by a command
install() {
  local root=$work/$1 list
  cp -a "$work/base" "$root"
  mkdir "$root/packages"
  cp "$packages"/*.deb "$root/packages"
  mount -t proc proc "$root/proc"
  chroot "$root" dpkg-query -W -f '${Package}\n' | sort >"$work/before"
  # Those of the folder are found as a repository, so that dependencies among them are as well.
  (cd "$root/packages" && dpkg-scanpackages . >Packages 2>/dev/null)
  echo "deb [trusted=yes] file:/packages ./" >"$root/etc/apt/sources.list.d/own.list"
  chroot "$root" apt-get update -qq 2>/dev/null
  # shellcheck disable=SC2086 # packages are words
  if ! DEBIAN_FRONTEND=noninteractive chroot "$root" apt-get install -y -qq --no-install-recommends "$1" $2 >"$work/log" 2>&1; then
    tail -20 "$work/log"
    exit 1
  fi
  list=$(chroot "$root" dpkg-query -W -f '${Package} ${Installed-Size}\n' | sort | join -v 1 - "$work/before")
  count() { grep -cE "$1" <<<"$list" || true; }
  echo "| \`$1\` | $(grep -c . <<<"$list") | $(awk '{ size += $2 } END { printf "%d", size / 1000 }' <<<"$list") |" \
    "$(count '^libvtk') | $(count '^libqt5') | $(count 'mpi') |" | tee -a "$table"
  if [[ $1 == *core* ]] && grep -E '^libvtk|^libqt' <<<"$list"; then
    echo "package_chroot.sh: core comes with VTK or Qt." >&2
    exit 1
  fi
  chroot "$root" bash -euc "cd /root; $3"
  umount "$root/proc"
  rm -rf --one-file-system "$root"
}

version=$(dpkg-deb -f "$(ls "$packages"/libpcl-uvol-dev_*.deb)" Version)
so=${version%.*}
install "libpcl-uvol-core$so" "" "ldd /usr/lib/*/libpcl_uvol_core.so.$so | (! grep 'not found')"
install "libpcl-uvol$so" "" "ldd /usr/lib/*/libpcl_uvol_io.so.$so | (! grep 'not found')"
install pcl-uvol-tools "" "uvol info samples.csv >/dev/null &&
  uvol isosurface samples.csv surface.ply -field rho -iso 0.4 -png picture.png && test -s picture.png"
install python3-pcl-uvol "" "python3 -c 'import numpy, pcl_uvol; p = numpy.random.default_rng(1).random((5000, 3));
print(len(pcl_uvol.isosurface(p, {\"r\": p[:, 0]}, field=\"r\", iso=[0.5]).points))'"
install pcl-uvol-viewer "" "uvol_viewer -version"
install pcl-uvol-mpi "" "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -np 2 \
  uvol_isosurface_mpi samples.csv surface.ply -field rho -iso 0.4 >/dev/null"
install libpcl-uvol-dev "g++ cmake ninja-build" "cmake -S consumer -B build -G Ninja >/dev/null && cmake --build build && build/consumer"
install libpcl-uvol-mpi-dev "g++ cmake ninja-build" "cmake -S consumer -B build -G Ninja >/dev/null && cmake --build build &&
  test \"\$(build/ranks_consumer)\" = 'rank 0 of 1'"
install pcl-uvol-doc "" "test -s /usr/share/doc/pcl-uvol-doc/html/index.html && test -s /usr/share/doc/pcl-uvol-doc/html/api/index.html"
