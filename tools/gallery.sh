#!/usr/bin/env bash
# Makes the pictures of docs/guide/gallery.md by the commands that stand there, also those that take long, and puts
# them beside the page. Needs the tools (tools/build.sh tools) and $PCL_UVOL_DATA, the folder of data sets.
# usage: gallery.sh [FOLDER_OF_TOOLS]
set -euo pipefail
cd "$(dirname "$0")/.."
python3 docs/site/run_commands.py "${1:-build/release/bin}" --long --renew docs/guide/gallery.md
