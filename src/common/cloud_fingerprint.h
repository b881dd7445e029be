// SPDX-License-Identifier: BSD-3-Clause
// Whether a cloud still holds what it held when it was read: stages that keep what they
// made of a cloud notice by it that somebody has written into that cloud.
#pragma once

#include "common/scalar_field.h"
#include <pcl_uvol/common/cloud_view.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

__extension__ using WideNumber = unsigned __int128;

/** \brief Both halves of a product: one multiplication mixes two words (as in wyhash,
 * Wang Yi 2019). */
inline std::uint64_t
mixWords(std::uint64_t a, std::uint64_t b)
{
  constexpr std::uint64_t odd_a = 0xa0761d6478bd642fu, odd_b = 0xe7037ed1a0b428dbu;
  const WideNumber product = static_cast<WideNumber>(a ^ odd_a) * (b ^ odd_b);
  return static_cast<std::uint64_t>(product) ^
         static_cast<std::uint64_t>(product >> 64);
}

/** \brief Hashes of what a stage reads of all points, each with its place in the cloud.
 * Different contents have equal ones by chance only, one time in 2^64. */
struct CloudFingerprint {
  std::uint64_t positions = 0;
  std::uint64_t values = 0; ///< of the components of a field, bit by bit
};

/** \brief The fingerprint of a cloud: one look at its points, which takes as long as
 * reading them from memory. */
CloudFingerprint
computeFingerprint(const CloudView& cloud, const ScalarField& field, unsigned threads);

/** \brief The same of indices and their order. */
template <typename Index>
std::uint64_t
computeFingerprint(const std::vector<Index>& indices)
{
  std::uint64_t sum = indices.size(); // in any order: none need wait for another
  for (std::size_t i = 0; i < indices.size(); ++i)
    sum += mixWords(i, static_cast<std::uint32_t>(indices[i]));
  return sum;
}

} // namespace pcl_uvol
