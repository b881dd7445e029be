// SPDX-License-Identifier: BSD-3-Clause
// Objects of the library of HDF5, and tables of numbers of its files.
#pragma once

#include "io_vtk/hdf5_file.h"
#include <pcl_uvol/common/export.h>

#include <hdf5.h>
#include <memory>
#include <mutex>
#include <string>

namespace pcl_uvol {
namespace io {

/** While it lives no other thread calls the library, which prints no errors. */
class PCL_UVOL_EXPORTS Hdf5Session {
public:
  Hdf5Session()
      : lock_(mutex())
  {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Hdf5Session(const Hdf5Session&) = delete;
  Hdf5Session&
  operator=(const Hdf5Session&) = delete;
  ~Hdf5Session()
  {
    H5Eset_auto2(H5E_DEFAULT, print_, data_);
  }

private:
  static std::recursive_mutex&
  mutex();

  std::lock_guard<std::recursive_mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

using Handle = std::shared_ptr<const hid_t>;

/** \brief Null for an object that could not be opened. */
Handle
own(hid_t id);

/** \brief The type of pcl::PCLPointField that numbers are read as; 0 for what is no
 * number. */
std::uint8_t
hdf5Datatype(hid_t type);

/** \brief The numbers of a table: as they lie in the file where they can be, unpacked
 * here where deflate and shuffle packed them, else by the library, which has no defence
 * against damaged chunks.
 * \throws IOError where the file holds less than it promises */
std::unique_ptr<FileColumn>
openHdf5Column(const std::string& path,
               const std::string& name,
               const Handle& dataset,
               const Hdf5Shape& shape);

} // namespace io
} // namespace pcl_uvol
