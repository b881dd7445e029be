// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/extract_from_ranks.h"

#include "common/parallel.h"
#include "distributed/byte_stream.h"
#include "distributed/run_stage.h"
#include "neighbors/sampling.h"

#include <utility>

namespace pcl_uvol {

RankIsosurface
extractFromRanks(Samples&& samples,
                 const IsosurfaceParameters& settings,
                 const ValueFrame& frame,
                 Communicator& communicator,
                 unsigned threads,
                 Report& report)
{
  checkParameters(settings);
  const LengthUnit unit = normalizeTogether(
      samples, toPosition(settings.scale), communicator, threads, report);
  IsosurfaceStage stage(settings, unit, frame);
  RankIsosurface found;
  found.samples = runOnRanks(stage, std::move(samples), communicator, threads, report);
  found.samples.sampling = toInput(found.samples.sampling, unit);
  found.isopoints = stage.take(communicator, report);
  found.tally = stage.getTally();
  return found;
}

std::vector<std::vector<GlobalIsopoint>>
gatherIsopoints(std::vector<std::vector<GlobalIsopoint>>&& isopoints,
                Communicator& communicator,
                unsigned threads)
{
  std::vector<Bytes> messages(communicator.size());
  for (auto& part : isopoints) {
    ByteWriter(messages[0]).put(part);
    part = {};
  }
  for (const Bytes& bytes : communicator.allToAll(std::move(messages)))
    for (ByteReader reader(bytes); !reader.atEnd();)
      for (auto& part : isopoints)
        reader.get(part);
  for (auto& part : isopoints)
    parallelSort(part.begin(), part.end(), threads, isBefore);
  return std::move(isopoints);
}

} // namespace pcl_uvol
