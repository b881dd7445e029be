// SPDX-License-Identifier: BSD-3-Clause
// Scenes of the ray tracer as text, one item per line.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/render/renderer.h>

#include <array>
#include <optional>
#include <set>
#include <string>

namespace pcl_uvol {

/** \brief A scene and how it is looked at; what the file does not say is unset. */
struct SceneFile {
  Scene scene;
  std::optional<Camera> camera;
  std::optional<std::array<int, 2>> size;
  int supersampling = 1;
  RayTracingSettings settings;
  /** Subtracted from all coordinates: that of the first cloud, see Dataset. */
  std::array<double, 3> origin{{0.0, 0.0, 0.0}};
  std::set<double> isovalues; ///< of its clouds
};

/** \brief Read a scene. Clouds are read, and covered by splats unless the file has
 * them. README lists the items.
 * \param folder where its clouds are looked for; "": beside the scene
 * \param report gets the counts and times of reading and of splat generation
 * \throws IOError in one sentence that names file, line and column: unknown words,
 * missing or malformed numbers, values out of range, missing files, a file that
 * includes itself */
PCL_UVOL_EXPORTS SceneFile
loadScene(const std::string& path,
          const std::string& folder,
          unsigned threads,
          Report& report);

} // namespace pcl_uvol
