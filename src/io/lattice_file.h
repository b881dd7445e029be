// SPDX-License-Identifier: BSD-3-Clause
// Regular lattices of fields as files, written part by part: more than memory holds.
#pragma once

#include "interpolation/query_lattice.h"
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief An array of a lattice. */
struct LatticeArray {
  std::string name;
  std::uint8_t datatype;      ///< pcl::PCLPointField: FLOAT32, FLOAT64 or UINT8
  std::size_t components = 1; ///< numbers per place
};

/** \brief Puts numbers of an array into its file.
 * \param first index of the first place
 * \param bytes the numbers of so many places */
using PutNumbers = std::function<void(
    std::size_t array, std::size_t first, std::size_t places, const void* bytes)>;

/** \brief Write a lattice as .vti (slanting ones with a Direction), .vts, .nrrd or
 * .mha, by the ending of the name. Of the last two, which hold one array, the first
 * array goes into the file of that name, others into out_NAME.nrrd beside it. Files
 * appear whole or not at all.
 * \param fill puts all numbers, in any order
 * \throws IOError */
PCL_UVOL_EXPORTS void
saveLattice(const std::string& path,
            const detail::QueryLattice& lattice,
            const std::vector<LatticeArray>& arrays,
            const std::function<void(const PutNumbers& put)>& fill);

/** \brief The files that saveLattice() writes. */
PCL_UVOL_EXPORTS std::vector<std::string>
latticeFiles(const std::string& path, const std::vector<LatticeArray>& arrays);

/** \brief True if the name has one of the endings of saveLattice(). */
PCL_UVOL_EXPORTS bool
isLatticeFile(const std::string& path);

} // namespace pcl_uvol
