#!/usr/bin/env bash
# Makes Debian packages in build/package/deb, lets lintian check them, and uses what they hold: from a folder that
# they are unpacked into the tools run, and a project of its own finds the library.
# usage: package.sh [chroot]; chroot: then tools/package_chroot.sh installs each into a fresh system (as root)
set -euo pipefail
cd "$(dirname "$0")/.."
bash tools/build.sh help lintian fakeroot dpkg-dev file man-db python3-numpy
[ "${1:-}" != chroot ] || bash tools/install_dependencies.sh debootstrap

configure=(cmake --preset release -B build/package -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_SKIP_INSTALL_RPATH=ON
  -DPCL_UVOL_BUILD_TESTS=OFF)
"${configure[@]}"
cmake --build build/package
PCL_UVOL_BIN=build/package/bin bash tools/docs.sh
"${configure[@]}" -DPCL_UVOL_DOCUMENTATION="$PWD/build/docs/site"
rm -rf build/package/deb
(cd build/package && cpack -B deb >cpack.log) || { cat build/package/cpack.log; exit 1; }
rm -rf build/package/deb/_CPack_Packages
lintian --fail-on error --tag-display-limit 0 build/package/deb/*.deb

root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
for package in build/package/deb/*.deb; do
  dpkg-deb -x "$package" "$root"
done
libraries=$(dirname "$(find "$root/usr/lib" -name 'libpcl_uvol_core.so.?.?')")
export LD_LIBRARY_PATH=$libraries PATH="$root/usr/bin:$PATH"
uvol generate "$root/sphere.csv" -n 5000
uvol isosurface "$root/sphere.csv" "$root/surface.ply" -iso 8
uvol_viewer -version
if [ -d "$root/usr/lib/python3" ]; then
  PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 -c 'import pcl_uvol'
fi
cmake -S tests/consumer -B "$root/consumer" -G Ninja -Dpcl_uvol_DIR="$libraries/cmake/pcl_uvol" >"$root/log"
cmake --build "$root/consumer"
"$root/consumer/consumer"
man --warnings -l "$root/usr/share/man/man1/uvol_isosurface.1.gz" >/dev/null
ls -l build/package/deb/*.deb
if [ "${1:-}" = chroot ]; then
  unset LD_LIBRARY_PATH
  bash tools/package_chroot.sh build/package/deb
fi
