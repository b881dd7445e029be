// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/parallel.h"
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "neighbors/nearest_neighbors.h"
#include "surface/memory_need.h"
#include <pcl_uvol/surface/surface_normals.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr std::size_t normal_block = 1u << 10;
/** Middle over largest eigenvalue: below it the neighbours lie on one line, to float's
 * resolution of coordinates and with room for some digits that offsets cost. */
constexpr double collinear_ratio = 1e-9;
/** Cosine between normal and outside vector below which the neighbours vote as well: an
 * edge that grazes the surface may look to the wrong side of the fitted plane. */
constexpr float clear_side = 0.3f;
/** Share of the neighbours that have to look to a sample's side for them alone to vote:
 * below it the sample is more likely to look the wrong way than to lie on a sheet of
 * its own. */
constexpr double least_share = 0.25;
const Eigen::Array3d no_view_point = Eigen::Array3d::Zero();
constexpr std::uint32_t no_sample = std::numeric_limits<std::uint32_t>::max();

/** Fit of a sample in the stretched space. */
struct Fit {
  Eigen::Vector3f normal;
  float curvature;
  bool degenerate;
};

Fit
fitPlane(const std::vector<Position>& positions,
         std::uint32_t sample,
         const std::vector<std::uint32_t>& neighbors)
{
  // Differences to the sample: far from the origin, sums of squares would lose all
  // digits.
  const Position& x = positions[sample];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const std::uint32_t neighbor : neighbors) {
    const Position& y = positions[neighbor];
    const Eigen::Vector3d d(static_cast<double>(y[0]) - x[0],
                            static_cast<double>(y[1]) - x[1],
                            static_cast<double>(y[2]) - x[2]);
    sum += d;
    products += d * d.transpose();
  }
  const double count = static_cast<double>(neighbors.size() + 1);
  const Eigen::Matrix3d covariance = products - sum * sum.transpose() / count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3d& values = solver.eigenvalues(); // ascending
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).cast<float>();
  const bool degenerate = neighbors.size() < 2 ||
                          !(values[1] > collinear_ratio * values[2]) ||
                          !normal.allFinite();
  const double smallest = std::max(values[0], 0.0);
  return {normal,
          degenerate
              ? 0.0f
              : static_cast<float>(smallest / (smallest + values[1] + values[2])),
          degenerate};
}

/** The side that a point's normal shall look to. */
class Orientation {
public:
  /** \param unit lengths of directions are near 1 in it */
  Orientation(const CloudView& cloud, const Eigen::Array3f& view_point, float unit)
      : cloud_(cloud)
      , view_point_(view_point)
      , unit_(unit)
  {
    constexpr const char* names[] = {"normal_x", "normal_y", "normal_z"};
    for (const char* name : names)
      if (findField(cloud.fields, name) != nullptr)
        own_normal_.emplace_back(cloud.fields, name);
  }

  /** Zero where it is unknown. */
  Eigen::Vector3f
  at(std::uint32_t index) const
  {
    if (own_normal_.size() == 3) {
      const std::uint8_t* const point = cloud_.point(index);
      Eigen::Vector3f own(static_cast<float>(own_normal_[0].read(point)),
                          static_cast<float>(own_normal_[1].read(point)),
                          static_cast<float>(own_normal_[2].read(point)));
      if (hasDirection(own))
        return own;
    }
    const Eigen::Vector3f place(cloud_.xyz(index));
    Eigen::Vector3f view = unit_ * view_point_ - unit_ * place;
    if (hasDirection(view))
      return view;
    const Eigen::Vector3f far_view = view_point_ - place; // too far away in that unit
    return hasDirection(far_view) ? far_view : Eigen::Vector3f(0.0f, 0.0f, 0.0f);
  }

private:
  /** Of shorter vectors too few digits are left to give them length 1. */
  static bool
  hasDirection(const Eigen::Vector3f& vector)
  {
    return vector.allFinite() &&
           vector.cwiseAbs().maxCoeff() >= std::numeric_limits<float>::min();
  }

  const CloudView& cloud_;
  Eigen::Vector3f view_point_;
  float unit_;
  std::vector<ScalarField> own_normal_;
};

/** Unit vector per sample to the side that it shall look to; zero: unknown. */
std::vector<Eigen::Vector3f>
collectSides(const SampleSet& samples, const Orientation& orientation, unsigned threads)
{
  std::vector<Eigen::Vector3f> sides(samples.size());
  parallelBlocks(sides.size(), normal_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto sample = static_cast<std::uint32_t>(i);
      sides[i] = orientation.at(samples.getInputIndex(sample));
      sides[i].stableNormalize();
    }
  });
  return sides;
}

/** The neighbours on the sample's own sheet: those that look to its side. Another sheet
 * that is as near as the next points of the own one looks the other way, and a plane
 * through both would be no tangent of either. Outside vectors may graze the surface, so
 * that sides are told apart along the axis that most of them share, whatever their
 * sign.
 * \param found the result, a buffer to use again */
void
findOwnSheet(const std::vector<Eigen::Vector3f>& sides,
             std::uint32_t sample,
             const NeighborGraph::Row& neighbors,
             std::vector<std::uint32_t>& found)
{
  const Eigen::Vector3f& own = sides[sample];
  Eigen::Matrix3f products = own * own.transpose();
  for (const std::uint32_t neighbor : neighbors)
    products += sides[neighbor] * sides[neighbor].transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(products);
  const Eigen::Vector3f axis = solver.eigenvectors().col(2);
  found.clear();
  for (const std::uint32_t neighbor : neighbors)
    if (!(axis.dot(own) * axis.dot(sides[neighbor]) < 0.0f))
      found.push_back(neighbor);
  if (static_cast<double>(found.size()) <
      least_share * static_cast<double>(neighbors.size()))
    found.assign(neighbors.begin(), neighbors.end());
}

void
checkParameters(const SurfaceNormalParameters& parameters)
{
  if (parameters.k < 2)
    throw InvalidArgument("few_neighbors_for_normals", {{"neighbors", parameters.k}});
  if (!parameters.scale.allFinite() || !(parameters.scale > 0.0f).all())
    throw InvalidArgument("normals_scale_not_positive", {});
}

/** The sample that stands for each input point. */
std::vector<std::uint32_t>
collectSamples(const SampleSet& samples, std::size_t points)
{
  std::vector<std::uint32_t> sample_of(points, no_sample);
  for (std::uint32_t i = 0; i < samples.size(); ++i)
    sample_of[samples.getInputIndex(i)] = i;
  for (const SampleSet::Merged& merged : samples.getMerged())
    for (const std::uint32_t member : merged.members)
      sample_of[member] = merged.sample;
  return sample_of;
}

NeighborGraph
findNeighbors(const SampleSet& samples,
              std::size_t k,
              const pcl::search::Search<pcl::PointXYZ>::Ptr& search,
              unsigned threads,
              Report& report)
{
  return search ? computeNearestNeighbors(samples, k, threads, search, report)
                : computeNearestNeighbors(samples, k, threads, report);
}

/** Turns the fit of a sample to the side of one of its points. */
SurfaceNormal
orient(const Fit& fit,
       std::uint32_t point,
       const NeighborGraph::Row& neighbors,
       const std::vector<Eigen::Vector3f>& sides,
       const Orientation& orientation,
       const Eigen::Array3f& scale)
{
  const Eigen::Vector3f outside = orientation.at(point);
  Eigen::Vector3f normal = outside;
  if (!fit.degenerate) {
    // A normal is a covector: it is stretched where positions are shrunk.
    normal = (fit.normal.array() * scale).matrix().normalized();
    float side = normal.dot(outside.normalized());
    if (std::abs(side) < clear_side)
      for (const std::uint32_t neighbor : neighbors)
        side += normal.dot(sides[neighbor]);
    if (side < 0.0f)
      normal = -normal;
  }
  normal.stableNormalize();
  return {{normal[0], normal[1], normal[2]}, fit.curvature};
}

/** Normals, and how many of them are outside vectors. */
struct FoundNormals {
  std::vector<SurfaceNormal> normals;
  std::uint64_t degenerate;
};

FoundNormals
findNormals(const CloudView& input,
            const std::vector<std::uint32_t>& indices,
            const SurfaceNormalParameters& parameters,
            const pcl::search::Search<pcl::PointXYZ>::Ptr& search,
            unsigned threads,
            Report& report)
{
  checkParameters(parameters);
  if (indices.empty())
    throw InvalidArgument("empty_cloud", {{"stage", "The normal estimation"}});
  checkMemoryOf("Estimating normals",
                indices.size(),
                surfaceNormalsBytes(static_cast<double>(indices.size()),
                                    static_cast<double>(parameters.k)));
  const Eigen::Array3f& scale = parameters.scale;
  const detail::StretchAxes axes(parameters.rotation);
  const CloudView cloud = axes.turn(input);
  const Eigen::Matrix3f rows = axes.getRows().cast<float>();
  const auto samples = SampleSet::build(cloud.xyz(0),
                                        cloud.stride(),
                                        indices,
                                        Position{{scale[0], scale[1], scale[2]}},
                                        threads,
                                        report);
  const NeighborGraph graph =
      findNeighbors(*samples, parameters.k, search, threads, report);
  StepTimer step(report, "normals", samples->size() + indices.size());
  const Orientation orientation(
      cloud,
      rows * parameters.view_point.value_or(no_view_point).cast<float>().matrix(),
      samples->getUnit().factor);
  const std::vector<Eigen::Vector3f> sides =
      collectSides(*samples, orientation, threads);
  std::vector<Fit> fits(samples->size());
  parallelBlocks(fits.size(), normal_block, threads, [&](auto begin, auto end) {
    std::vector<std::uint32_t> own_sheet;
    for (std::size_t i = begin; i < end; ++i) {
      const auto sample = static_cast<std::uint32_t>(i);
      findOwnSheet(sides, sample, graph[i], own_sheet);
      fits[i] = fitPlane(samples->getPositions(), sample, own_sheet);
    }
    step.advance(end - begin);
  });
  // Near 1, so that no square of a length is beyond float.
  const Eigen::Array3f stretch =
      scale * std::ldexp(1.0f, -std::ilogb(scale.maxCoeff()));
  const std::vector<std::uint32_t> sample_of = collectSamples(*samples, cloud.count);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<SurfaceNormal> normals(indices.size(), {{nan, nan, nan}, nan});
  std::atomic<std::uint64_t> degenerate{0};
  parallelBlocks(indices.size(), normal_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t sample = sample_of[indices[i]];
      if (sample == no_sample)
        continue;
      normals[i] =
          orient(fits[sample], indices[i], graph[sample], sides, orientation, stretch);
      if (axes.areTurned()) {
        Eigen::Map<Eigen::Vector3f> normal(normals[i].normal);
        normal = (rows.transpose() * normal).eval();
      }
      if (fits[sample].degenerate)
        ++degenerate;
    }
    step.advance(end - begin);
  });
  return {std::move(normals), degenerate};
}

} // namespace

namespace detail {

void
warnOfUnsetViewPoint(const CloudView& cloud,
                     const SurfaceNormalParameters& parameters,
                     Report& report)
{
  if (!parameters.view_point && findField(cloud.fields, "normal_x") == nullptr)
    report.warn("oriented_to_zero");
}

std::vector<SurfaceNormal>
estimateSurfaceNormals(const CloudView& cloud,
                       const std::vector<std::uint32_t>& indices,
                       const SurfaceNormalParameters& parameters,
                       const pcl::search::Search<pcl::PointXYZ>::Ptr& search,
                       unsigned threads,
                       Report& report)
{
  FoundNormals found = findNormals(cloud, indices, parameters, search, threads, report);
  report.count("degenerate_normals", found.degenerate);
  warnOfUnsetViewPoint(cloud, parameters, report);
  return std::move(found.normals);
}

void
replaceNormals(pcl::PointCloud<PointIso>& isopoints,
               const SurfaceNormalParameters& parameters,
               unsigned threads,
               Report& report)
{
  const CloudView cloud = viewOf(isopoints);
  for (std::size_t begin = 0; begin < isopoints.size();) {
    std::size_t end = begin + 1;
    while (end < isopoints.size() &&
           isopoints[end].isovalue == isopoints[begin].isovalue)
      ++end;
    std::vector<std::uint32_t> surface(end - begin);
    std::iota(surface.begin(), surface.end(), static_cast<std::uint32_t>(begin));
    Report own;
    own.progress = report.progress;
    const FoundNormals found =
        findNormals(cloud, surface, parameters, nullptr, threads, own);
    for (std::size_t i = 0; i < found.normals.size(); ++i)
      isopoints[begin + i].getNormalVector3fMap() =
          Eigen::Vector3f(found.normals[i].normal);
    report.count("degenerate_normals", found.degenerate);
    begin = end;
  }
}

void
replaceMissingNormals(pcl::PointCloud<PointIso>& isopoints,
                      const SurfaceNormalParameters& parameters,
                      unsigned threads,
                      Report& report)
{
  const auto has_none = [](const PointIso& point) {
    return std::isnan(point.mean_curvature);
  };
  if (std::none_of(isopoints.begin(), isopoints.end(), has_none))
    return;
  pcl::PointCloud<PointIso> replaced = isopoints;
  replaceNormals(replaced, parameters, threads, report);
  for (std::size_t i = 0; i < isopoints.size(); ++i)
    if (has_none(isopoints[i]))
      isopoints[i] = replaced[i];
}

} // namespace detail

} // namespace pcl_uvol
