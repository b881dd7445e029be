// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/periodic_ranks.h"

#include "distributed/byte_stream.h"
#include "distributed/neighbor_need.h"
#include "distributed/sort_together.h"
#include "neighbors/boxed_samples.h"
#include "neighbors/widest_gap.h"
#include <pcl_uvol/common/cloud_view.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace pcl_uvol {
namespace {

/** Neighbours are looked for among samples up to so many reaches from the faces first:
 * where the reach suffices, a sample at most one reach within the box has all of them
 * at most two reaches away. */
constexpr double first_depth = 3.0;

SampleExtents
joinExtents(const SampleExtents& own, Communicator& communicator)
{
  SampleExtents all;
  for (const SampleExtents& one :
       allGatherItems(communicator, std::vector<SampleExtents>{own}))
    all.add(one);
  return all;
}

/** What processes tell each other of their share of the coordinates, all in one order:
 * the first and the last one. */
struct Ends {
  std::uint64_t rank;
  double first, last;
};

/** The gaps of a process's share of the coordinates. In front of its first one lies the
 * share before, or, on the first process that has any, the face.
 * \param places ascending; there may be none */
std::vector<Gap>
listOwnGaps(const std::vector<double>& places, double side, Communicator& communicator)
{
  std::vector<Ends> ends;
  if (!places.empty())
    ends.push_back({communicator.rank(), places.front(), places.back()});
  ends = allGatherItems(communicator, ends);
  if (places.empty())
    return {};
  const auto own = std::find_if(ends.begin(), ends.end(), [&](const Ends& one) {
    return one.rank == communicator.rank();
  });
  return listGaps(places,
                  own == ends.begin() ? own->first + side - ends.back().last
                                      : own->first - own[-1].last);
}

/** The gaps of a process, and behind them those that are compared with them: they are
 * those of others, or its own again, across the faces. */
struct GapRow {
  std::vector<Gap> gaps;
  std::size_t count = 0;    ///< of this process
  std::size_t compared = 0; ///< of each, see findWidestGap()
};

GapRow
appendNextGaps(std::vector<Gap>&& own, Communicator& communicator)
{
  Bytes message;
  ByteWriter writer(message);
  writer.put(own.size());
  writer.put(own.data(), std::min(own.size(), most_compared));
  std::vector<std::vector<Gap>> heads(communicator.size());
  std::size_t total = 0;
  const std::vector<Bytes> messages = communicator.allGather(message);
  for (std::size_t rank = 0; rank < heads.size(); ++rank) {
    ByteReader reader(messages[rank]);
    total += reader.get<std::size_t>();
    reader.get(heads[rank]);
  }
  GapRow row{std::move(own), 0, std::min(total, most_compared)};
  row.count = row.gaps.size();
  if (row.count == 0)
    return row;
  for (std::size_t rank = communicator.rank() + 1;
       row.gaps.size() < row.count + row.compared;
       ++rank) {
    const std::vector<Gap>& head = heads[rank % heads.size()];
    row.gaps.insert(row.gaps.end(), head.begin(), head.end());
  }
  return row;
}

/** The coordinate behind the widest gap of all processes; 0 where there is none. */
double
findCut(const GapRow& row, Communicator& communicator)
{
  std::vector<Gap> best;
  if (row.count > 0) {
    const auto widest =
        row.gaps.begin() +
        static_cast<std::ptrdiff_t>(findWidestGap(row.gaps, row.count, row.compared));
    best.assign(widest, widest + static_cast<std::ptrdiff_t>(row.compared));
  }
  best = allGatherItems(communicator, best); // as many of each process that has any
  std::size_t widest = 0;
  for (std::size_t next = row.compared; next < best.size(); next += row.compared)
    if (areWider(&best[next], &best[widest], row.compared))
      widest = next;
  return best.empty() ? 0.0 : best[widest].place;
}

/** Samples, and their images, no farther from the faces than a depth. */
Samples
gatherNear(const BoxedSamples& boxed,
           const std::vector<PeriodicImage>& images,
           double depth)
{
  Samples near;
  for (const std::uint32_t sample : boxed.getUsed())
    if (const float own = boxed.getDepth(sample); static_cast<double>(own) <= depth)
      near.push(boxed.getPlace(sample), own, 0);
  for (const PeriodicImage& image : images)
    near.push(boxed.getPlace(image), std::numeric_limits<float>::max(), 0);
  return near;
}

/** How far beyond the faces the neighbours of the samples of all processes lie, in the
 * stretched space; more than the reach where images do not suffice. */
double
measureNeed(const BoxedSamples& boxed,
            const PeriodicReach& how,
            double reach,
            Communicator& communicator,
            unsigned threads,
            const ProgressCallback& progress)
{
  const std::vector<PeriodicImage> images = boxed.findImages(reach, threads);
  for (double depth = first_depth * reach;;) {
    Samples near = gatherNear(boxed, images, depth);
    std::vector<std::uint64_t> counts{near.size(),
                                      boxed.getUsed().size() + images.size()};
    communicator.allReduce(counts);
    if (counts[1] < how.neighbors)
      return std::numeric_limits<double>::infinity();
    if (counts[0] == 0)
      return 0.0;
    const NeighborNeed need = measureNeed(std::move(near),
                                          how.scale,
                                          how.neighbors,
                                          reach,
                                          communicator,
                                          threads,
                                          progress);
    if (need.beyond <= reach || need.within <= depth)
      return need.beyond;
    depth = need.within; // samples there may be nearer than those that were found
  }
}

} // namespace

PeriodicBox
findPeriodicBox(const Dataset& part,
                const std::array<double, 3>& sides,
                Communicator& communicator,
                Report& report)
{
  return findPeriodicBox(
      part, joinExtents(findExtents(viewOf(part.cloud)), communicator), sides, report);
}

PeriodicBox
cutAtWidestGap(const Dataset& part,
               const PeriodicBox& box,
               Communicator& communicator,
               unsigned threads)
{
  PeriodicBox cut = box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.sides[axis] > 0.0))
      continue;
    const std::vector<double> places = sortTogether(
        sortPlaces(viewOf(part.cloud), box, axis, threads), communicator, threads);
    cut.low[axis] +=
        findCut(appendNextGaps(listOwnGaps(places, box.sides[axis], communicator),
                               communicator),
                communicator);
  }
  return cut;
}

PeriodicSamples
addPeriodicImages(const Dataset& part,
                  const std::vector<std::uint32_t>& use,
                  const PeriodicBox& box,
                  const PeriodicReach& reach,
                  Communicator& communicator,
                  unsigned threads,
                  Report& report)
{
  const StepTimer timer(report, "images");
  const BoxedSamples boxed(viewOf(part.cloud), use, box, reach.scale);
  SampleSpread spread = boxed.measureSpread();
  spread.extents = joinExtents(spread.extents, communicator);
  std::vector<std::uint64_t> count{spread.count};
  communicator.allReduce(count);
  spread.count = count[0];
  const double found = findReach(boxed, spread, reach, [&](double least) {
    return measureNeed(boxed, reach, least, communicator, threads, report.progress);
  });
  return boxed.addImages(part, found, threads);
}

} // namespace pcl_uvol
