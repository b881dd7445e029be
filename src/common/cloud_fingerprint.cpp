// SPDX-License-Identifier: BSD-3-Clause
#include "common/cloud_fingerprint.h"

#include "common/parallel.h"

#include <cstddef>
#include <cstring>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr std::size_t fingerprint_block = 1u << 16;

template <std::size_t bytes>
std::uint64_t
loadBytes(const std::uint8_t* from)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, from, bytes);
  return bits;
}

/** A component's bits; a copy of a length that compilers do not know is a call. */
std::uint64_t
bitsOf(const std::uint8_t* component, std::size_t bytes)
{
  switch (bytes) {
  case 1:
    return loadBytes<1>(component);
  case 2:
    return loadBytes<2>(component);
  case 4:
    return loadBytes<4>(component);
  default:
    return loadBytes<8>(component);
  }
}

/** What is read of each point as its value. */
struct Part {
  std::size_t offset, bytes;
};

CloudFingerprint
fingerprintBlock(const CloudView& cloud,
                 const std::vector<Part>& parts,
                 std::size_t begin,
                 std::size_t end)
{
  constexpr std::size_t plane_bytes = 2 * sizeof(float); // x and y
  CloudFingerprint sum; // in any order, so that points need not wait for one another
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint8_t* const point = cloud.point(i);
    const std::uint8_t* const xyz = point + cloud.xyz_offset;
    sum.positions += mixWords(loadBytes<plane_bytes>(xyz),
                              loadBytes<sizeof(float)>(xyz + plane_bytes) | i << 32);
    std::uint64_t value = i;
    for (const Part& part : parts)
      value = mixWords(value, bitsOf(point + part.offset, part.bytes));
    sum.values += value;
  }
  return sum;
}

} // namespace

CloudFingerprint
computeFingerprint(const CloudView& cloud, const ScalarField& field, unsigned threads)
{
  CloudFingerprint all;
  all.values = field.isLength() ? 1 : 0;
  std::vector<Part> parts;
  for (const FieldComponent& component : field.getComponents()) {
    parts.push_back({component.offset, datatypeSize(component.datatype)});
    all.values = mixWords(all.values, component.datatype);
  }
  std::vector<CloudFingerprint> blocks((cloud.count + fingerprint_block - 1) /
                                       fingerprint_block);
  parallelBlocks(
      cloud.count, fingerprint_block, threads, [&](std::size_t begin, std::size_t end) {
        blocks[begin / fingerprint_block] = fingerprintBlock(cloud, parts, begin, end);
      });
  for (const CloudFingerprint& block : blocks) {
    all.positions += block.positions;
    all.values += block.values;
  }
  return all;
}

} // namespace pcl_uvol
