#!/usr/bin/env bash
# Makes Debian packages in build/package/deb, and lets lintian check them.
# usage: package.sh
set -euo pipefail
cd "$(dirname "$0")/.."
bash tools/build.sh help lintian fakeroot dpkg-dev file

cmake --preset release -B build/package -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_SKIP_INSTALL_RPATH=ON \
  -DPCL_UVOL_BUILD_TESTS=OFF
cmake --build build/package
rm -rf build/package/deb
(cd build/package && cpack -B deb >cpack.log) || { cat build/package/cpack.log; exit 1; }
rm -rf build/package/deb/_CPack_Packages
lintian --fail-on error --tag-display-limit 0 build/package/deb/*.deb
ls build/package/deb/*.deb
