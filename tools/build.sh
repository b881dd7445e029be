#!/usr/bin/env bash
# Installs what building needs and builds the release preset; packages for tests may follow as
# arguments. Shared by tools/demo.sh and tests/run.sh.
set -euo pipefail
cd "$(dirname "$0")/.."

bash tools/install_dependencies.sh \
  build-essential cmake ninja-build ccache \
  libpcl-dev libvtk9-dev libflann-dev liblz4-dev libteem-dev nlohmann-json3-dev \
  libgtest-dev libgmock-dev "$@"
cmake --preset release
cmake --build --preset release
