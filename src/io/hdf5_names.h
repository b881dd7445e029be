// SPDX-License-Identifier: BSD-3-Clause
// Names of files of HDF5 and within them, which need no library of HDF5.
#pragma once

#include <pcl_uvol/common/export.h>

#include <string>

namespace pcl_uvol {
namespace io {

/** \brief True if the file begins as those of HDF5 do.
 * \throws IOError */
PCL_UVOL_EXPORTS bool
isHdf5(const std::string& path);

/** \brief A file of HDF5 and what is named within it, as in file.h5:/group/x,y,z. */
struct Hdf5Name {
  std::string file;
  std::string inside; ///< "": nothing
};

PCL_UVOL_EXPORTS Hdf5Name
splitHdf5Name(const std::string& path);

/** \brief The name of something in a group. */
inline std::string
joinNames(const std::string& group, const std::string& name)
{
  return (group == "/" ? "" : group) + '/' + name;
}

/** \brief The group that files of VTKHDF hold. */
constexpr const char* vtkhdf_group = "/VTKHDF";

} // namespace io
} // namespace pcl_uvol
