// SPDX-License-Identifier: BSD-3-Clause
// Files of HDF5 for tests, written by the library itself.
#pragma once

#include <hdf5.h>
#include <numeric>
#include <string>
#include <vector>

namespace uvol_test {

/** What damaged files leave open the library cannot close at exit, and prints so. The
 * library of readers prevents this only where it makes the first call. */
inline const herr_t leaves_no_handler = H5dont_atexit();

/** \brief A new file of groups, tables and attributes. */
class Hdf5Writer {
public:
  explicit Hdf5Writer(const std::string& path)
      : Hdf5Writer(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT))
  {
  }
  /** \param file that is open, and is closed at the end */
  explicit Hdf5Writer(hid_t file)
      : file_(file)
  {
  }
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer&
  operator=(const Hdf5Writer&) = delete;
  ~Hdf5Writer()
  {
    H5Fclose(file_);
  }

  void
  group(const std::string& name)
  {
    H5Gclose(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }

  void
  attribute(const std::string& object,
            const std::string& name,
            const std::vector<double>& numbers)
  {
    const hsize_t size = numbers.size();
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t id = H5Acreate_by_name(file_,
                                       object.c_str(),
                                       name.c_str(),
                                       H5T_IEEE_F64LE,
                                       space,
                                       H5P_DEFAULT,
                                       H5P_DEFAULT,
                                       H5P_DEFAULT);
    H5Awrite(id, H5T_NATIVE_DOUBLE, numbers.data());
    H5Aclose(id);
    H5Sclose(space);
  }

  /** \param chunk rows that are packed together; 0: none are packed */
  void
  table(const std::string& name,
        hid_t type,
        std::size_t components,
        const std::vector<double>& numbers,
        hsize_t chunk = 0)
  {
    const hsize_t sizes[2] = {numbers.size() / components, components};
    const int rank = components > 1 ? 2 : 1;
    const hid_t space = H5Screate_simple(rank, sizes, nullptr);
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    if (chunk > 0) {
      const hsize_t chunks[2] = {chunk, components};
      H5Pset_chunk(made, rank, chunks);
      H5Pset_deflate(made, 4);
    }
    const hid_t id =
        H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, made, H5P_DEFAULT);
    if (!numbers.empty())
      H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    H5Dclose(id);
    H5Pclose(made);
    H5Sclose(space);
  }

  /** \param sizes of the table, the slowest one first
   * \param chunk of as many sizes; none: nothing is packed */
  void
  block(const std::string& name,
        hid_t type,
        const std::vector<hsize_t>& sizes,
        const std::vector<double>& numbers,
        const std::vector<hsize_t>& chunk = {})
  {
    const auto rank = static_cast<int>(sizes.size());
    const hid_t space = H5Screate_simple(rank, sizes.data(), nullptr);
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    if (!chunk.empty()) {
      H5Pset_chunk(made, rank, chunk.data());
      H5Pset_shuffle(made);
      H5Pset_deflate(made, 4);
    }
    const hid_t id =
        H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, made, H5P_DEFAULT);
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    H5Dclose(id);
    H5Pclose(made);
    H5Sclose(space);
  }

  /** \param is_variable as h5py writes texts that are not told their length */
  void
  text(const std::string& object,
       const std::string& name,
       const std::string& characters,
       bool is_variable = false)
  {
    const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, is_variable ? H5T_VARIABLE : characters.size());
    const hid_t id = H5Acreate_by_name(file_,
                                       object.c_str(),
                                       name.c_str(),
                                       type,
                                       space,
                                       H5P_DEFAULT,
                                       H5P_DEFAULT,
                                       H5P_DEFAULT);
    const char* const data = characters.c_str();
    H5Awrite(id, type, is_variable ? static_cast<const void*>(&data) : data);
    H5Aclose(id);
    H5Tclose(type);
    H5Sclose(space);
  }

  hid_t
  getId() const
  {
    return file_;
  }

private:
  hid_t file_;
};

/** \brief As many numbers, each one more than the one before. */
inline std::vector<double>
numbersOf(std::size_t count, double first)
{
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

} // namespace uvol_test
