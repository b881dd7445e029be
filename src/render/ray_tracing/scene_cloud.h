// SPDX-License-Identifier: BSD-3-Clause
// Clouds on their way into a scene: covered by splats, coloured and put into their
// places.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Where a cloud goes: a point x comes to turn * (scale * x) + at. */
struct CloudPlacement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< a rotation
  double scale = 1.0;
  Eigen::Vector3d at{0.0, 0.0, 0.0};
  /** The bounding box is first centred at the origin, and its longest side scaled to
   * this length; 0: it is not, and scale counts. */
  double fit_size = 0.0;
};

/** \brief What a scene wants of a cloud. */
struct CloudLook {
  std::string name; ///< for messages
  RayMaterial material;
  CloudPlacement placement;
  SplatParameters parameters;
  bool has_parameters = false; ///< the scene says something about them
  std::string color_field;     ///< "": the colours that the cloud may have
  ColorMap color_map;
  std::optional<std::array<double, 2>> color_range;
};

/** \brief A cloud covered by splats. */
struct SceneCloud {
  pcl::PointCloud<PointSplat>::Ptr splats;
  std::vector<std::uint32_t> sources; ///< points of the cloud, per splat
  std::vector<Rgba> colors;
  std::vector<std::uint32_t> rims; ///< see SplatObject
  bool two_sided = false;          ///< see SplatObject
  Eigen::AlignedBox3d box;         ///< of the finite points
  Eigen::Vector3d origin;          ///< of their coordinates
};

/** \brief Cover a cloud by splats, unless it has some.
 * \param report gets counts, times, and warnings with the name in front
 * \throws InvalidArgument for a bad cloud, and if no splat is usable */
PCL_UVOL_EXPORTS SceneCloud
coverCloud(const Dataset& dataset,
           const CloudLook& look,
           unsigned threads,
           Report& report);

/** \brief Colour the splats by their points.
 * \throws InvalidArgument for an unknown field, or one without a number */
PCL_UVOL_EXPORTS void
colorCloud(const Dataset& dataset, const CloudLook& look, SceneCloud& cloud);

/** \brief The origin of a scene's coordinates: that of the first cloud that is not
 * fitted, where its placement brings it, so that float keeps the digits of large
 * coordinates. */
PCL_UVOL_EXPORTS Eigen::Vector3d
findSceneOrigin(const std::vector<CloudLook>& looks,
                const std::vector<SceneCloud>& clouds);

/** \brief Put a cloud into its place.
 * \throws InvalidArgument for a cloud without extent that is fitted to a size, and
 * where a splat leaves the range of float */
PCL_UVOL_EXPORTS void
placeCloud(const CloudLook& look,
           const Eigen::Vector3d& scene_origin,
           SceneCloud& cloud);

} // namespace pcl_uvol
