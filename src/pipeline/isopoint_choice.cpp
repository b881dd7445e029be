// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/isopoint_choice.h"

#include "common/parallel.h"
#include "pipeline/edge_errors.h"
#include "pipeline/isopoint_search.h"
#include "pipeline/stretched_edges.h"
#include <pcl_uvol/surface/surface_normals.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace pcl_uvol {

namespace {

using Eigen::Vector3d;

constexpr std::size_t block_points = 512;

/** Sums of unit vectors that are shorter have no direction to speak of. */
constexpr double smallest_sum = 1e-3;

/** Cosine between an isopoint's normal and its edge: below it they disagree. */
constexpr float clear_side = 0.3f;

/** Share of the ends of the edges around: an isopoint goes back to its edge where so
 * many more of them lie on their side. Less, and the surfaces of dense samples suffer,
 * by noise; more, and those of samples on lines do (tests/benchmarks, holdout). */
constexpr double least_gain = 0.1;

template <typename Enum>
std::vector<std::int32_t>
toNumbers(const std::vector<Enum>& values)
{
  std::vector<std::int32_t> numbers;
  numbers.reserve(values.size());
  for (const Enum value : values)
    numbers.push_back(static_cast<std::int32_t>(value));
  return numbers;
}

bool
isSupport(const PointIso& point, IsoSupport support)
{
  return point.support == static_cast<std::uint8_t>(support);
}

/** Put an isopoint back to where its edge has it. */
void
returnToEdge(const StretchedEdges& edges, float t, std::size_t i, PointIso& point)
{
  const Vector3d root = edges.findRoot(i);
  const bool is_measured = hasFit(point) && isSupport(point, IsoSupport::Measured);
  const double height = point.getNormalVector3fMap().cast<double>().dot(
      root - point.getVector3fMap().cast<double>());
  point.error = is_measured ? static_cast<float>(std::abs(height)) + point.error
                            : std::max(t, 1.0f - t) * point.edge_length;
  point.getVector3fMap() = root.cast<float>();
  point.getNormalVector3fMap() = edges.carryBack(edges.findOutside(i));
  point.mean_curvature = std::numeric_limits<float>::quiet_NaN();
}

/** One isovalue's isopoints, and the edges of those around each of them. */
class Surface {
public:
  /** \param isopoints may be moved and turned; the search is among where they were */
  Surface(const pcl::PointCloud<PointIso>& isopoints,
          std::size_t first,
          std::size_t last,
          const StretchedEdges& edges,
          const IsosurfacePipelineParameters& parameters,
          unsigned threads)
      : edges_(edges)
      , neighbors_(parameters.normal_neighbors)
  {
    std::vector<std::uint32_t> surface(last - first);
    std::iota(surface.begin(), surface.end(), static_cast<std::uint32_t>(first));
    Report report;
    const CloudView view = viewOf(isopoints);
    places_ = SampleSet::build(view.xyz(0),
                               view.stride(),
                               surface,
                               toPosition(parameters.isosurface.scale),
                               threads,
                               report);
  }

  /** \brief Where the isopoints were, as samples. */
  const SampleSet&
  getPlaces() const
  {
    return *places_;
  }

  IsopointSearch
  makeSearch() const
  {
    return {*places_, neighbors_};
  }

  /** \brief The bisector of an isopoint's edge and the mean of the edges around. */
  Vector3d
  bisect(std::size_t i, const std::vector<std::uint32_t>& around) const
  {
    Vector3d sum = Vector3d::Zero();
    for (const std::uint32_t other : around)
      sum += edges_.findOutside(other);
    Vector3d own = edges_.findOutside(i);
    const double length = sum.norm();
    if (!(length > smallest_sum))
      return own;
    const Vector3d bisector = sum / length + own;
    return bisector.norm() > smallest_sum ? Vector3d(bisector.normalized()) : own;
  }

  /** \brief Counts the samples at the ends of edges around that lie on their side of
   * a plane.
   * \param root, outside in the original space */
  std::size_t
  countRightEnds(const Vector3d& root,
                 const Eigen::Vector3f& outside,
                 const std::vector<std::uint32_t>& around) const
  {
    const Vector3d normal = outside.cast<double>();
    std::size_t right = 0;
    for (const std::uint32_t other : around) {
      const auto [inner, outer] = edges_.findEnds(other);
      right += normal.dot(inner - root) <= 0.0;
      right += normal.dot(outer - root) >= 0.0;
    }
    return right;
  }

private:
  const StretchedEdges& edges_;
  std::size_t neighbors_;
  SampleSet::ConstPtr places_;
};

/** Whether an isopoint may be unconstrained, by itself and its edge alone. */
bool
isUncertain(const StretchedEdges& edges, std::size_t i, const PointIso& point)
{
  return !isSupport(point, IsoSupport::Measured) ||
         edges.carryBack(edges.findOutside(i)).dot(point.getNormalVector3fMap()) <
             clear_side;
}

/** Which isopoints go back to their edges, and the normals that they have there. */
void
judgeSurface(const Surface& surface,
             const StretchedEdges& edges,
             std::size_t first,
             std::size_t last,
             const pcl::PointCloud<PointIso>& isopoints,
             unsigned threads,
             StepTimer& step,
             std::vector<std::uint8_t>& returns,
             std::vector<Eigen::Vector3f>& bisectors)
{
  parallelBlocks(last - first, block_points, threads, [&](auto begin, auto end) {
    IsopointSearch search = surface.makeSearch();
    for (std::size_t i = first + begin; i < first + end; ++i) {
      const PointIso& point = isopoints[i];
      if (!isUncertain(edges, i, point))
        continue;
      const std::vector<std::uint32_t>& around = search.find(point);
      bisectors[i - first] = edges.carryBack(surface.bisect(i, around));
      const std::size_t as_it_is = surface.countRightEnds(
          point.getVector3fMap().cast<double>(), point.getNormalVector3fMap(), around);
      const std::size_t by_edges =
          surface.countRightEnds(edges.findRoot(i), bisectors[i - first], around);
      returns[i - first] = static_cast<double>(by_edges) >=
                           static_cast<double>(as_it_is) +
                               least_gain * 2.0 * static_cast<double>(around.size());
    }
    step.advance(end - begin);
  });
}

} // namespace

void
IsopointChoice::addFields(bool is_chosen, Dataset& surface) const
{
  if (is_chosen) {
    setField(surface, "method", toNumbers(method));
    setField(surface, "orientation", toNumbers(orientation));
  }
  if (!confidence.empty())
    setField(surface, "confidence", confidence);
}

bool
returnsToEdges(const IsosurfacePipelineParameters& parameters)
{
  return parameters.isosurface.interpolation == Interpolation::Auto &&
         !parameters.smooth && !parameters.mesh;
}

IsosurfaceParameters
withErrors(const IsosurfacePipelineParameters& parameters)
{
  IsosurfaceParameters extraction = parameters.isosurface;
  const bool needs_fits = parameters.max_error || parameters.automatic_max_error ||
                          parameters.drop_bridged || parameters.fill_gaps;
  extraction.errors_only =
      needs_fits && extraction.interpolation == Interpolation::Linear;
  if (extraction.errors_only)
    extraction.interpolation = Interpolation::Fit;
  return extraction;
}

namespace {

/** Normals as the parameters ask, if isopoints stay where they are. */
void
orientIsopoints(const IsosurfacePipelineParameters& parameters,
                unsigned threads,
                pcl::PointCloud<PointIso>& isopoints,
                IsopointChoice& choice,
                Report& report)
{
  const auto become = [&](IsoOrientation orientation) {
    for (std::size_t i = 0; i < isopoints.size(); ++i)
      choice.orientation[i] = hasFit(isopoints[i]) ? IsoOrientation::Fit : orientation;
  };
  become(IsoOrientation::Edge);
  if (parameters.normals == NormalMethod::Edge || parameters.mesh || isopoints.empty())
    return;
  SurfaceNormalParameters pca;
  pca.k = parameters.normal_neighbors;
  pca.scale = parameters.isosurface.scale;
  if (parameters.normals == NormalMethod::Pca ||
      parameters.isosurface.interpolation == Interpolation::Linear) {
    detail::replaceNormals(isopoints, pca, threads, report);
    choice.orientation.assign(isopoints.size(), IsoOrientation::Pca);
    return;
  }
  detail::replaceMissingNormals(isopoints, pca, threads, report);
  become(IsoOrientation::Pca);
}

/** Put isopoints of one isovalue back to their edges that rest on these alone. */
void
returnUncertain(const Surface& surface,
                const StretchedEdges& stretched,
                const IsoEdges& edges,
                const IsosurfacePipelineParameters& parameters,
                std::size_t first,
                std::size_t last,
                unsigned threads,
                StepTimer& step,
                pcl::PointCloud<PointIso>& isopoints,
                IsopointChoice& choice)
{
  std::vector<std::uint8_t> returns(last - first, 0);
  std::vector<Eigen::Vector3f> bisectors(last - first);
  judgeSurface(
      surface, stretched, first, last, isopoints, threads, step, returns, bisectors);
  for (std::size_t i = first; i < last; ++i) {
    if (returns[i - first] == 0)
      continue;
    PointIso& point = isopoints[i];
    const Eigen::Vector3f normal = point.getNormalVector3fMap();
    returnToEdge(stretched, edges[i].t, i, point);
    choice.method[i] = IsoMethod::Linear;
    if (parameters.normals == NormalMethod::Auto) {
      point.getNormalVector3fMap() = bisectors[i - first];
      choice.orientation[i] = IsoOrientation::Bisector;
    }
    else if (parameters.normals == NormalMethod::Edge)
      choice.orientation[i] = IsoOrientation::Edge;
    else
      point.getNormalVector3fMap() = normal;
  }
}

/** Lower the errors of isopoints of one isovalue on edges to what those around tell. */
void
lowerEdgeErrors(const SampleSet& places,
                const StretchedEdges& edges,
                std::size_t first,
                std::size_t last,
                unsigned threads,
                pcl::PointCloud<PointIso>& isopoints)
{
  std::vector<std::size_t> on_edges;
  for (std::size_t i = first; i < last; ++i)
    if (!hasFit(isopoints[i]))
      on_edges.push_back(i);
  parallelBlocks(on_edges.size(), block_points, threads, [&](auto begin, auto end) {
    EdgeErrorFinder finder(places, isopoints, edges);
    for (std::size_t i = begin; i < end; ++i) {
      float& error = isopoints[on_edges[i]].error;
      error = std::min(error, finder.find(on_edges[i]));
    }
  });
}

/** Choose between fit and edge, isovalue by isovalue. */
void
chooseEach(const StretchedEdges& stretched,
           const IsoEdges& edges,
           const IsosurfacePipelineParameters& parameters,
           unsigned threads,
           StepTimer& step,
           pcl::PointCloud<PointIso>& isopoints,
           IsopointChoice& choice)
{
  for (std::size_t first = 0, last = 0; first < isopoints.size(); first = last) {
    while (last < isopoints.size() &&
           isopoints[last].isovalue == isopoints[first].isovalue)
      ++last;
    const Surface surface(isopoints, first, last, stretched, parameters, threads);
    returnUncertain(surface,
                    stretched,
                    edges,
                    parameters,
                    first,
                    last,
                    threads,
                    step,
                    isopoints,
                    choice);
    lowerEdgeErrors(surface.getPlaces(), stretched, first, last, threads, isopoints);
  }
}

} // namespace

IsopointChoice
chooseIsopoints(const CloudView& samples,
                const IsoEdges& edges,
                const IsosurfacePipelineParameters& parameters,
                unsigned threads,
                pcl::PointCloud<PointIso>& isopoints,
                Report& report)
{
  StepTimer step(report, "normals", isopoints.size());
  IsopointChoice choice;
  // Samples whose field made the isopoints are needed only where these may go back.
  const bool all_return = withErrors(parameters).errors_only;
  std::optional<StretchedEdges> stretched;
  if (all_return || returnsToEdges(parameters))
    stretched.emplace(samples, edges, parameters.isosurface);
  for (std::size_t i = 0; all_return && i < isopoints.size(); ++i)
    if (!isSupport(isopoints[i], IsoSupport::Unknown))
      returnToEdge(*stretched, edges[i].t, i, isopoints[i]);
  for (const PointIso& point : isopoints)
    choice.method.push_back(hasFit(point) ? IsoMethod::Fit : IsoMethod::Linear);
  choice.orientation.resize(isopoints.size());
  orientIsopoints(parameters, threads, isopoints, choice, report);
  if (returnsToEdges(parameters))
    chooseEach(*stretched, edges, parameters, threads, step, isopoints, choice);
  return choice;
}

} // namespace pcl_uvol
