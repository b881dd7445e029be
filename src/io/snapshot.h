// SPDX-License-Identifier: BSD-3-Clause
// Kinds of particles in snapshots, under the names that options give them.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/message.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief A kind: its number in the file, its usual name, and how many there are. */
struct ParticleKind {
  std::size_t number;
  std::string name; ///< "" if there is none
  std::uint64_t count;
};

/** \brief Gadget's six kinds: gas, dm, disk, bulge, stars, bh.
 * \param counts by number */
PCL_UVOL_EXPORTS std::vector<ParticleKind>
listGadgetKinds(const std::vector<std::uint64_t>& counts);

/** \brief The number of the kind that was chosen by its name or number; "": gas, or the
 * first that has particles.
 * \param notes tell of the kinds left out unless one was chosen
 * \throws IOError that lists the kinds there are, for one that is not */
PCL_UVOL_EXPORTS std::size_t
chooseKind(const std::string& path,
           const std::vector<ParticleKind>& kinds,
           const std::string& chosen,
           std::vector<Message>& notes);

/** \brief The files of a snapshot, of which the name ends in a number, as in
 * snap_005.3 or snap_005.3.hdf5.
 * \param count of them
 * \throws IOError for one that is not there */
PCL_UVOL_EXPORTS std::vector<std::string>
listSnapshotFiles(const std::string& path, std::size_t count);

/** \brief What the header of a cosmological snapshot tells. */
struct CosmologyHeader {
  double redshift = 0.0;
  std::optional<double> hubble; ///< none: the file does not give it
};

/** \brief The sides of a box, of one number for all of them, or of three; 0 where
 * they are none. */
PCL_UVOL_EXPORTS std::array<double, 3>
toBox(const std::vector<double>& sides);

/** \brief A note on comoving units. */
PCL_UVOL_EXPORTS void
noteHeader(const CosmologyHeader& header, std::vector<Message>& notes);

} // namespace io
} // namespace pcl_uvol
