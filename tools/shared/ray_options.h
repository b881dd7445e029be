// SPDX-License-Identifier: BSD-3-Clause
// Ray tracing on the command line.
#pragma once

#include "io/scene_file.h"
#include "shared/splat_options.h"
#include "shared/view_options.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/render/renderer.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief What rays do, and the material of a single cloud. */
class RayOptions {
public:
  /** \brief Depth, shadows, occlusion: what a scene may be told as well. */
  void
  declareRays(Options& options);

  /** \brief Material and splats of a cloud. */
  void
  declareSurface(Options& options);

  /** \brief
   * \throws UsageError */
  void
  check(const Options& options) const;

  /** \brief Change what was given on the command line, and cull as views do. */
  void
  apply(const Options& options,
        const ViewOptions& view,
        pcl_uvol::RayTracingSettings& settings) const;

  /** \brief Draw all frames of one cloud, covered by splats unless it has them.
   * \return the number of splats */
  std::size_t
  traceCloud(const Options& options,
             const ViewOptions& view,
             const pcl_uvol::Dataset& surface,
             const std::string& output,
             pcl_uvol::Report& report) const;

  /** \brief Names of the options of a cloud's surface. */
  static const std::vector<std::string>&
  surfaceOptions();

private:
  /** \param range set to the values at the ends of its colours */
  pcl_uvol::Scene
  makeScene(const ViewOptions& view,
            const pcl_uvol::CloudView& cloud,
            pcl_uvol::Splats&& splats,
            std::array<double, 2>& range) const;

  SplatOptions splats_;
  pcl_uvol::RayTracingSettings settings_;
  bool shadows_ = true;
  double reflectivity_ = 0.0, transparency_ = 0.0, refractive_index_ = 1.0;
};

/** \brief A scene of one surface, without lights and background.
 * \param splats that cover the points of the cloud
 * \param colors of the points; none: that of the material
 * \param side shorter one of the picture, pixels
 * \throws InvalidArgument if there are no splats that can be drawn */
pcl_uvol::Scene
makeSplatScene(const pcl_uvol::CloudView& cloud,
               pcl_uvol::Splats&& splats,
               const std::vector<pcl_uvol::Rgba>& colors,
               const pcl_uvol::RayMaterial& material,
               int side);

/** \brief Draw and write all frames of a scene, whose size the tracer has.
 * \param file has its camera, unless the command line has another one */
void
traceScene(const Options& options,
           const ViewOptions& view,
           pcl_uvol::RayTracer& tracer,
           const pcl_uvol::SceneFile& file,
           const std::string& output,
           pcl_uvol::Report& report);

} // namespace uvol_tools
