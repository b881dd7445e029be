#!/usr/bin/env bash
# Puts what a header of include/pcl_uvol declares into the Doxygen group of its folder.
# usage: add_group.sh FILE
case $1 in
  *include/pcl_uvol/*.h)
    group=${1#*include/pcl_uvol/}
    printf "/** \\addtogroup %s\n * @{ */ " "${group%%/*}"
    cat "$1"
    printf '/** @} */\n'
    ;;
  *) cat "$1" ;;
esac
