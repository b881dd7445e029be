// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/hdf5_writer.h"

#include "io/files.h"
#include "io/unpacked_file.h"
#include "io_vtk/vtk_messages.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>
#if __has_include(<H5FDdevelop.h>) // from 1.14 on
#include <H5FDdevelop.h>
#endif

namespace pcl_uvol {
namespace io {

/** A file of the library that is open at a descriptor. The drivers of HDF5 1.10 cannot
 * do this: that of the system needs a file with a name, and that of stdio crashes where
 * the disk is full. Nor can a file be closed whose driver fails. So this driver keeps
 * the first error and never fails to write. */
struct Hdf5Writer::Target : H5FD_t {
  explicit Target(int opened)
      : H5FD_t()
      , descriptor(opened)
  {
  }

  static H5FD_class_t
  makeDriver();

  Descriptor descriptor;
  haddr_t allocated = 0, end = 0;
  int error = 0;
  bool is_open = false;
};

H5FD_class_t
Hdf5Writer::Target::makeDriver()
{
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
  driver.version = H5FD_CLASS_VERSION;
  driver.value = 511; // the last one of those for tests
#endif
  driver.name = "pcl_uvol";
  driver.maxaddr = static_cast<haddr_t>(INT64_MAX);
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(void*); // where a Target is
  driver.open = [](const char*, unsigned, hid_t access, haddr_t) -> H5FD_t* {
    const void* const given = H5Pget_driver_info(access);
    if (given == nullptr)
      return nullptr;
    Target* const target = *static_cast<Target* const*>(given);
    target->is_open = true;
    return target;
  };
  driver.close = [](H5FD_t* file) -> herr_t {
    static_cast<Target*>(file)->is_open = false;
    return 0;
  };
  driver.get_eoa = [](const H5FD_t* file, H5FD_mem_t) {
    return static_cast<const Target*>(file)->allocated;
  };
  driver.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t end) -> herr_t {
    static_cast<Target*>(file)->allocated = end;
    return 0;
  };
  driver.get_eof = [](const H5FD_t* file, H5FD_mem_t) {
    return static_cast<const Target*>(file)->end;
  };
  driver.read = [](H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size, void* to) {
    const ssize_t got = ::pread(
        static_cast<Target*>(file)->descriptor.get(), to, size, static_cast<off_t>(at));
    return herr_t{got == static_cast<ssize_t>(size) ? 0 : -1};
  };
  driver.write =
      [](H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, size_t size, const void* bytes)
      -> herr_t {
    Target& target = *static_cast<Target*>(file);
    const char* from = static_cast<const char*>(bytes);
    target.end = std::max(target.end, at + size);
    while (size > 0 && target.error == 0) {
      const ssize_t done =
          ::pwrite(target.descriptor.get(), from, size, static_cast<off_t>(at));
      if (done < 0 && errno != EINTR)
        target.error = errno;
      const std::size_t written = done > 0 ? static_cast<std::size_t>(done) : 0;
      from += written;
      at += written;
      size -= written;
    }
    return 0;
  };
  return driver;
}

Hdf5Writer::Hdf5Writer(const std::string& file, std::string path)
    : path_(std::move(path))
    , target_(
          std::make_unique<Target>(::open(file.c_str(), O_RDWR | O_TRUNC | O_CLOEXEC)))
{
  if (target_->descriptor.get() < 0)
    throwUnwritable(path_, std::strerror(errno));
  checkRoomForBlocks();
  const Hdf5Session session;
  const H5FD_class_t driver = Target::makeDriver();
  driver_ = checked(H5FDregister(&driver));
  names_ = checked(H5Pcreate(H5P_LINK_CREATE));
  group_ = checked(H5Pcreate(H5P_GROUP_CREATE));
  table_ = checked(H5Pcreate(H5P_DATASET_CREATE));
  const Handle create = checked(H5Pcreate(H5P_FILE_CREATE)),
               access = checked(H5Pcreate(H5P_FILE_ACCESS));
  for (const Handle& made : {group_, table_, create})
    check(H5Pset_obj_track_times(*made, false));
  check(H5Pset_char_encoding(*names_, H5T_CSET_UTF8));
  check(H5Pset_fill_time(*table_, H5D_FILL_TIME_NEVER));
  check(H5Pset_libver_bounds(*access, H5F_LIBVER_V18, H5F_LIBVER_V18));
  const Target* const target = target_.get();
  check(H5Pset_driver(*access, *driver_, &target));
  file_ = checked(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, *create, *access));
}

Hdf5Writer::~Hdf5Writer()
{
  file_.reset();
  if (target_->is_open) // memory was too short to close it: the library still knows it
    static_cast<void>(target_.release());
}

void
Hdf5Writer::fail() const
{
  throwUnwritable(path_,
                  target_->error != 0
                      ? std::strerror(target_->error)
                      : "the library of HDF5 failed; memory may be exhausted");
}

void
Hdf5Writer::check(herr_t result) const
{
  if (result < 0 || target_->error != 0)
    fail();
}

Handle
Hdf5Writer::checked(hid_t id) const
{
  Handle handle = own(id);
  if (!handle)
    fail();
  return handle;
}

void
Hdf5Writer::addGroup(const std::string& name)
{
  const Hdf5Session session;
  checked(H5Gcreate2(*file_, name.c_str(), *names_, *group_, H5P_DEFAULT));
}

void
Hdf5Writer::addTable(const std::string& name,
                     std::uint8_t datatype,
                     std::uint64_t rows,
                     std::uint64_t components,
                     const MakeRows& make)
{
  constexpr std::uint64_t block_rows = 1u << 14;
  const Hdf5Session session;
  const int rank = components > 1 ? 2 : 1;
  const hsize_t sizes[] = {rows, components};
  const hid_t native = hdf5Type(datatype);
  const Handle type = checked(H5Tcopy(native)),
               space = checked(H5Screate_simple(rank, sizes, nullptr));
  check(H5Tset_order(*type, H5T_ORDER_LE));
  const Handle table = checked(
      H5Dcreate2(*file_, name.c_str(), *type, *space, *names_, *table_, H5P_DEFAULT));
  for (std::uint64_t first = 0; first < rows; first += block_rows) {
    const hsize_t start[] = {first, 0};
    const hsize_t block[] = {std::min(block_rows, rows - first), components};
    const Handle memory = checked(H5Screate_simple(rank, block, nullptr));
    const std::string bytes = make(first, block[0]);
    check(H5Sselect_hyperslab(*space, H5S_SELECT_SET, start, nullptr, block, nullptr));
    check(H5Dwrite(*table, native, *memory, *space, H5P_DEFAULT, bytes.data()));
  }
}

void
Hdf5Writer::addAttribute(const std::string& object,
                         const std::string& name,
                         hid_t type,
                         hid_t space,
                         const void* value) const
{
  const Handle attribute = checked(H5Acreate_by_name(*file_,
                                                     object.c_str(),
                                                     name.c_str(),
                                                     type,
                                                     space,
                                                     H5P_DEFAULT,
                                                     H5P_DEFAULT,
                                                     H5P_DEFAULT));
  check(H5Awrite(*attribute, type, value));
}

void
Hdf5Writer::addAttribute(const std::string& object,
                         const std::string& name,
                         const std::string& text)
{
  const Hdf5Session session;
  const Handle type = checked(H5Tcopy(H5T_C_S1)),
               space = checked(H5Screate(H5S_SCALAR));
  check(H5Tset_size(*type, text.size()));
  check(H5Tset_strpad(*type, H5T_STR_NULLPAD));
  addAttribute(object, name, *type, *space, text.data());
}

void
Hdf5Writer::addAttribute(const std::string& object,
                         const std::string& name,
                         const std::vector<std::int64_t>& numbers)
{
  const Hdf5Session session;
  const hsize_t size = numbers.size();
  const Handle space = checked(H5Screate_simple(1, &size, nullptr));
  addAttribute(object, name, H5T_STD_I64LE, *space, numbers.data());
}

void
Hdf5Writer::close()
{
  const Hdf5Session session;
  check(H5Fflush(*file_, H5F_SCOPE_GLOBAL));
  file_.reset();
  check(target_->is_open ? -1 : 0);
  if (::close(target_->descriptor.take()) != 0)
    throwUnwritable(path_, std::strerror(errno));
}

} // namespace io
} // namespace pcl_uvol
