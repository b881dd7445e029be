#!/usr/bin/env bash
# Puts what a header of include/pcl_uvol declares into the Doxygen group of its folder; within a namespace the group
# has to begin inside of it.
# usage: add_group.sh FILE
group=${1#*include/pcl_uvol/}
begin="/** \\\\addtogroup ${group%%/*}\\n * @{ */"
case $1 in
  *include/pcl_uvol/filters/vtk*.h)
    sed -e "s|^#pragma once|&\\n$begin|" -e '$s|$|\n/** @} */|' "$1"
    ;;
  *include/pcl_uvol/*.h)
    sed -e "s|^namespace pcl_uvol {|&\\n$begin|" -e 's|^} // namespace pcl_uvol|/** @} */\n&|' "$1"
    ;;
  *) cat "$1" ;;
esac
