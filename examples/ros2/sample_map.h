// SPDX-License-Identifier: BSD-3-Clause
// Samples of a robot's sensors as they come in: a window in time, a bound on their
// number, and surfaces of what is there, extracted beside further samples.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/point_cloud.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <future>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace uvol_ros {

using pcl_uvol::CloudView;
using pcl_uvol::IsosurfaceParameters;

/** \brief What a SampleMap keeps. */
struct SampleMapParameters {
  /** Samples that are older than the newest by more are forgotten, in the unit of the
   * stamps, from 0. NaN, the default: none. */
  double window = std::numeric_limits<double>::quiet_NaN();
  /** Samples at most, from 1. Beyond it they are thinned: of those in one cube the
   * newest stays. */
  std::size_t most_samples = 100000;
  /** Side of the cubes, in units of length, from 0; it grows until three quarters of
   * the bound, or fewer, are left. 0: that of so many cubes in the samples' box. */
  double cube = 0.0;
};

namespace detail {

/** Room for samples that come next, so that not all of them are followed by thinning.
 */
constexpr double kept_part = 0.75;

/** Twice the volume, about. */
constexpr double growth = 1.26;

struct CubeEntry {
  std::array<double, 3> cube; ///< whole numbers
  std::uint32_t sample;

  bool
  operator<(const CubeEntry& other) const
  {
    return cube != other.cube ? cube < other.cube : sample < other.sample;
  }
};

/** The newest sample of each cube, in any order. */
inline std::vector<std::uint32_t>
findNewest(const CloudView& cloud,
           const std::vector<std::uint32_t>& samples,
           double side)
{
  std::vector<CubeEntry> entries;
  entries.reserve(samples.size());
  for (const std::uint32_t sample : samples) {
    CubeEntry entry{{}, sample};
    for (std::size_t axis = 0; axis < 3; ++axis)
      entry.cube[axis] =
          std::floor(static_cast<double>(cloud.xyz(sample)[axis]) / side);
    entries.push_back(entry);
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::uint32_t> newest;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (i + 1 == entries.size() || entries[i].cube != entries[i + 1].cube)
      newest.push_back(entries[i].sample);
  return newest;
}

/** The side of so many cubes in the box of samples; of a flat box those in its plane.
 */
inline double
chooseSide(const CloudView& cloud,
           const std::vector<std::uint32_t>& samples,
           double cubes)
{
  double volume = 1.0;
  int dimensions = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::uint32_t sample : samples) {
      low = std::min(low, static_cast<double>(cloud.xyz(sample)[axis]));
      high = std::max(high, static_cast<double>(cloud.xyz(sample)[axis]));
    }
    if (high > low) {
      volume *= high - low;
      ++dimensions;
    }
  }
  return dimensions == 0 ? 1.0 : std::pow(volume / cubes, 1.0 / dimensions);
}

/** \brief The samples that stay when there are too many, ascending.
 *
 * \param cloud the newest samples last; those without a finite position go
 *
 * \param most samples that may stay, from 1
 *
 * \param cube see SampleMapParameters */
inline std::vector<std::uint32_t>
thinByCubes(const CloudView& cloud, std::size_t most, double cube)
{
  std::vector<std::uint32_t> samples;
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (std::isfinite(cloud.xyz(i)[0]) && std::isfinite(cloud.xyz(i)[1]) &&
        std::isfinite(cloud.xyz(i)[2]))
      samples.push_back(static_cast<std::uint32_t>(i));
  const auto room = std::max<std::size_t>(
      static_cast<std::size_t>(kept_part * static_cast<double>(most)), 1);
  double side =
      cube > 0.0 ? cube : chooseSide(cloud, samples, static_cast<double>(room));
  for (bool is_first = true; is_first || samples.size() > room; is_first = false) {
    samples = findNewest(cloud, samples, side);
    side *= growth;
  }
  std::sort(samples.begin(), samples.end());
  return samples;
}

} // namespace detail

/** \brief Isopoints of the samples that a SampleMap held at one moment. */
template <typename PointT>
struct SampleMapSurface {
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  pcl_uvol::IsoEdges edges; ///< with indices into samples
  typename pcl::PointCloud<PointT>::ConstPtr samples;
  pcl_uvol::Report report;
};

/** \brief Samples that come in and go, and their isosurfaces at any moment.
 *
 * \code
 * uvol_ros::SampleMap<pcl::PointXYZI> map;
 * map.append(cloud, stamp); // again and again
 * auto surface = map.extractInBackground(parameters); // while more samples come
 * show(surface.get().isopoints);
 * \endcode
 * All calls may come from any thread. The tree is built anew for each extraction: what
 * comes out is that of a fresh cloud of the same samples.
 *
 * \tparam PointT any registered point type with x, y, z */
template <typename PointT>
class SampleMap {
public:
  using Cloud = pcl::PointCloud<PointT>;

  /** \param parameters of the whole life of the map
   * \throws std::invalid_argument for a window or a side below 0, and for a bound of 0
   */
  explicit SampleMap(const SampleMapParameters& parameters = {})
      : parameters_(parameters)
  {
    if (parameters.window < 0.0 || parameters.most_samples == 0 ||
        !(parameters.cube >= 0.0) || !std::isfinite(parameters.cube))
      throw std::invalid_argument(
          "A window and a cube are not negative, and there is room for a sample.");
  }

  /** \return The parameters that the map was made with. */
  SampleMapParameters
  getParameters() const
  {
    return parameters_;
  }

  /** \brief Add samples; old ones go as the parameters say.
   *
   * \param cloud the samples
   * \param stamp their time, in any order
   *
   * \throws std::invalid_argument for a stamp that is not finite */
  void
  append(const Cloud& cloud, double stamp)
  {
    if (!(std::abs(stamp) <= std::numeric_limits<double>::max()))
      throw std::invalid_argument("A time stamp is finite.");
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_ = samples_.empty() ? stamp : std::max(newest_, stamp);
    for (const PointT& point : cloud)
      samples_.push_back(point);
    stamps_.resize(samples_.size(), stamp);
    dropOld(newest_ - parameters_.window);
    if (samples_.size() > parameters_.most_samples)
      keep(detail::thinByCubes(
          pcl_uvol::viewOf(samples_), parameters_.most_samples, parameters_.cube));
  }

  /** \brief Forget all samples. */
  void
  forget()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    samples_.clear();
    stamps_.clear();
  }

  /** \brief Forget samples of an earlier time.
   * \param stamp the earliest that stays */
  void
  forgetBefore(double stamp)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    dropOld(stamp);
  }

  /** \return The number of samples that the map holds. */
  std::size_t
  size() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return samples_.size();
  }

  /** \brief A copy of the samples, those that came last behind the others. */
  typename Cloud::Ptr
  getSamples() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::make_shared<Cloud>(samples_);
  }

  /** \brief Extract the isosurfaces of the samples that are there now.
   *
   * \param parameters of the extraction
   * \param threads 0 (default) = all cores
   *
   * \throws pcl_uvol::InvalidArgument as IsosurfaceExtraction::extract */
  SampleMapSurface<PointT>
  extract(const IsosurfaceParameters& parameters, unsigned threads = 0) const
  {
    return extractFrom(getSamples(), parameters, threads);
  }

  /** \brief The same in a thread of its own, while samples come and go: those that are
   * there at the time of the call count. get() throws what extract() does.
   * \param parameters of the extraction
   * \param threads 0 (default) = all cores */
  std::future<SampleMapSurface<PointT>>
  extractInBackground(const IsosurfaceParameters& parameters,
                      unsigned threads = 0) const
  {
    return std::async(std::launch::async,
                      [samples = getSamples(), parameters, threads] {
                        return extractFrom(samples, parameters, threads);
                      });
  }

private:
  static SampleMapSurface<PointT>
  extractFrom(const typename Cloud::ConstPtr& samples,
              const IsosurfaceParameters& parameters,
              unsigned threads)
  {
    pcl_uvol::IsosurfaceExtraction<PointT> extraction;
    extraction.setInputCloud(samples);
    extraction.setParameters(parameters);
    extraction.setNumberOfThreads(threads);
    SampleMapSurface<PointT> surface;
    extraction.extract(surface.isopoints);
    surface.edges = extraction.getEdges();
    surface.report = extraction.getReport();
    surface.samples = samples;
    return surface;
  }

  /** \param stamp NaN: none is too old */
  void
  dropOld(double stamp)
  {
    std::vector<std::uint32_t> young;
    for (std::size_t i = 0; i < stamps_.size(); ++i)
      if (!(stamps_[i] < stamp))
        young.push_back(static_cast<std::uint32_t>(i));
    if (young.size() < stamps_.size())
      keep(young);
  }

  /** \param indices ascending */
  void
  keep(const std::vector<std::uint32_t>& indices)
  {
    for (std::size_t i = 0; i < indices.size(); ++i) {
      samples_[i] = samples_[indices[i]];
      stamps_[i] = stamps_[indices[i]];
    }
    samples_.resize(indices.size());
    stamps_.resize(indices.size());
  }

  const SampleMapParameters parameters_;
  mutable std::mutex mutex_;
  Cloud samples_;              // guarded by mutex_, as what follows
  std::vector<double> stamps_; // by sample
  double newest_ = 0.0;
};

} // namespace uvol_ros
