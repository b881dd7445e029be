// SPDX-License-Identifier: BSD-3-Clause
// Splats: discs with linear normal fields that cover a surface given as points (thesis
// 4.2.1).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief Parameters of SplatGeneration. */
struct PCL_UVOL_EXPORTS SplatParameters {
  /** Largest distance of covered points to their splat, > 0. */
  double delta = 1e-4;
  /** In units of the coordinates; else in parts of the longest side of the bounding
   * box. A few points that lie so far from the others that it is more than twice as
   * long with them do not count. */
  bool delta_is_length = false;
  /** Part of a splat's radius within which no other one starts, in [0, 1]. */
  double lambda = 0.2;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = SplatParameters;
    return std::make_tuple(Member{"delta", &Own::delta},
                           Member{"delta_is_length", &Own::delta_is_length},
                           Member{"lambda", &Own::lambda});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static SplatParameters
  fromJson(const std::string& text);
};

/** \brief Splats, and the input point that each is grown from. */
struct Splats {
  pcl::PointCloud<PointSplat> cloud;
  std::vector<std::uint32_t> sources;
  bool two_sided = false; ///< their normals have no meaningful sign
  /** What ends discs at the rims of the surface, one per splat, for SplatObject; empty:
   * all are whole. */
  std::vector<std::uint32_t> rims;
};

namespace detail {

/** \brief The kernel of SplatGeneration for any cloud.
 * \param use indices of the points to cover
 * \param report gets the counts of SplatGeneration and times
 * \throws InvalidArgument as SplatGeneration::compute */
PCL_UVOL_EXPORTS Splats
generateSplats(const CloudView& cloud,
               const std::vector<std::uint32_t>& use,
               const SplatParameters& parameters,
               unsigned threads,
               Report& report);

} // namespace detail

/** \brief Covers a surface with splats.
 *
 * \code
 * pcl_uvol::SplatGeneration<PointIso> generation;
 * generation.setInputCloud(surface);
 * pcl::PointCloud<PointSplat> splats;
 * generation.compute(splats);
 * \endcode
 * From every point that is not skipped, a disc grows across its neighbours, nearest
 * first, until one is farther than delta from the plane of the disc. The plane is
 * perpendicular to the point's normal, at the height that minimises the largest
 * distance. Points within lambda of its radius are then skipped.
 *
 * No hole is left: a disc is at least as large as the Voronoi cell of its point, and
 * only points whose cell lies within the disc are passed over. No disc grows across a
 * rim of the surface: it reaches some spacings beyond one at most. The order of the
 * points is random but fixed; the result does not depend on threads or on the order of
 * the input. Every finite point that has a normal is covered by a splat within delta.
 * \tparam PointT with x, y, z; normals if it has them, else they are estimated */
template <typename PointT>
class SplatGeneration : public CloudStage<PointT>,
                        public ParameterStage<SplatParameters> {
public:
  using Ptr = std::shared_ptr<SplatGeneration<PointT>>;
  using ConstPtr = std::shared_ptr<const SplatGeneration<PointT>>;

  /** \brief Largest distance of covered points to their splat, as a part of the longest
   * side of the bounding box of all points but a few far ones: > 0, default 1e-4. */
  void
  setDelta(double delta)
  {
    parameters_.delta = delta;
    parameters_.delta_is_length = false;
  }

  /** \brief The same as a length in units of the coordinates, > 0. */
  void
  setAbsoluteDelta(double delta)
  {
    parameters_.delta = delta;
    parameters_.delta_is_length = true;
  }

  /** \return The largest distance of points to their disc, see isDeltaLength(). */
  double
  getDelta() const
  {
    return parameters_.delta;
  }
  /** \brief Whether delta is a length. */
  bool
  isDeltaLength() const
  {
    return parameters_.delta_is_length;
  }

  /** \brief Part of a splat's radius within which no other one starts: in [0, 1],
   * default 0.2. Larger is fewer splats and less smooth normals. */
  void
  setLambda(double lambda)
  {
    parameters_.lambda = lambda;
  }

  /** \return The part of a splat's radius within which no other one starts. */
  double
  getLambda() const
  {
    return parameters_.lambda;
  }

  /** \brief Cover the input. Counts of the report: points, non_finite, without_normal,
   * duplicates, splats, and widened (splats that are larger than delta or a rim allows,
   * to leave no hole).
   * \param splats which cover the input
   * \throws InvalidArgument without an input cloud, without a finite point that has a
   * normal, for a delta or lambda out of range, an extent beyond float's squares; the
   * output is then untouched */
  void
  compute(pcl::PointCloud<PointSplat>& splats);

  /** \brief Index of the input point that every splat is grown from. */
  const std::vector<std::uint32_t>&
  getSources() const
  {
    return sources_;
  }

  /** \brief What ends the disc of every splat at the rims of the surface, for the ray
   * tracer (SplatObject::rims); empty if all are whole. */
  const std::vector<std::uint32_t>&
  getRims() const
  {
    return rims_;
  }

private:
  std::vector<std::uint32_t> sources_, rims_;
};

template <typename PointT>
void
SplatGeneration<PointT>::compute(pcl::PointCloud<PointSplat>& splats)
{
  this->withInput(
      "SplatGeneration", [&](const CloudView& cloud, const pcl::Indices& indices) {
        startReport();
        const std::vector<std::uint32_t> use(indices.begin(), indices.end());
        Splats generated =
            detail::generateSplats(cloud, use, parameters_, threads_, report_);
        splats = std::move(generated.cloud);
        splats.header = this->input_->header;
        sources_ = std::move(generated.sources);
        rims_ = std::move(generated.rims);
      });
}

} // namespace pcl_uvol
