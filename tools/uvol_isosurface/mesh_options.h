// SPDX-License-Identifier: BSD-3-Clause
// The options of meshes.
#pragma once

#include "shared/options.h"
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <cstdint>
#include <optional>
#include <string>

namespace uvol_tools {

/** \brief -mesh and what goes with it. */
class MeshOptions {
public:
  void
  declare(Options& options);

  /** \brief How to mesh; none unless it was asked for, by -mesh or by the ending of the
   * output.
   * \throws UsageError for options of meshes without one */
  std::optional<pcl_uvol::MeshingParameters>
  finish(const Options& options, const std::string& output) const;

  /** \brief -periodic-mesh. */
  pcl_uvol::PeriodicMesh
  getPeriodicMesh() const
  {
    return periodic_mesh_;
  }

  /** \brief -measure: whether to tell area, volume and the like. */
  bool
  isMeasured() const
  {
    return is_measured_;
  }

  /** \brief -check: whether to look for triangles that go through one another. */
  bool
  isChecked() const
  {
    return is_checked_;
  }

private:
  bool is_asked_for_ = false, is_measured_ = false, is_checked_ = false;
  std::uint64_t drop_pieces_ = 0;
  pcl_uvol::MeshingParameters parameters_;
  pcl_uvol::PeriodicMesh periodic_mesh_ = pcl_uvol::PeriodicMesh::Cut;
};

} // namespace uvol_tools
