// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/messages.h"

#include <utility>

namespace pcl_uvol {

void
putSamples(ByteWriter& writer, const SampleSpan& samples)
{
  writer.put(samples.positions, samples.size);
  writer.put(samples.values, samples.size);
  writer.put(samples.sources, samples.size);
}

void
getSamples(ByteReader& reader, Samples& samples)
{
  reader.get(samples.positions);
  reader.get(samples.values);
  reader.get(samples.sources);
}

std::size_t
countBytes(const SampleSpan& samples)
{
  return 3 * sizeof(std::size_t) +
         samples.size * (sizeof(Position) + sizeof(float) + sizeof(std::uint64_t));
}

std::vector<Bytes>
send(std::vector<Bytes>&& messages,
     const std::string& counter,
     Communicator& communicator,
     Report& report)
{
  for (std::size_t rank = 0; rank < messages.size(); ++rank)
    if (rank != communicator.rank())
      report.count(counter, messages[rank].size());
  return communicator.allToAll(std::move(messages));
}

} // namespace pcl_uvol
