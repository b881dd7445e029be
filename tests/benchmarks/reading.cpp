// SPDX-License-Identifier: BSD-3-Clause
// Reading files of points beside reading and copying their bytes: reading FILE...
#include "io/files.h"
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

namespace {

constexpr std::uint64_t block_bytes = 1u << 18;

/** The best of some runs, in seconds. */
template <typename Work>
double
bestTime(const Work& work)
{
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 5; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> seconds =
        std::chrono::steady_clock::now() - start;
    best = std::min(best, seconds.count());
  }
  return best;
}

std::vector<std::uint8_t>
readAndCopy(const pcl_uvol::io::InputFile& file)
{
  std::vector<std::uint8_t> block(block_bytes), bytes(file.getSize());
  for (std::uint64_t at = 0; at < bytes.size();) {
    const auto count = std::min<std::uint64_t>(block_bytes, bytes.size() - at);
    file.read(at, block.data(), count);
    std::copy_n(block.data(), count, bytes.data() + at);
    at += count;
  }
  return bytes;
}

} // namespace

int
main(int argc, char** argv)
{
  for (int i = 1; i < argc; ++i) {
    using Packing = pcl_uvol::io::InputFile::Packing;
    const pcl_uvol::io::InputFile file(argv[i], Packing::Keep);
    const double bytes = static_cast<double>(file.getSize());
    const double raw = bestTime([&] { readAndCopy(file); });
    const double ours = bestTime([&] { pcl_uvol::loadDataset(argv[i]); });
    std::printf(
        "%s: %.0f MB, read and copied %.2f GB/s, loaded %.2f GB/s, ratio %.2f\n",
        argv[i],
        1e-6 * bytes,
        1e-9 * bytes / raw,
        1e-9 * bytes / ours,
        raw / ours);
  }
}
