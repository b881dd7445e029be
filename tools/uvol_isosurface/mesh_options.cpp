// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_isosurface/mesh_options.h"

#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace uvol_tools {

void
MeshOptions::declare(Options& options)
{
  options.group("Mesh");
  options.flag("mesh",
               is_asked_for_,
               "make a closed triangle mesh whose vertices are isopoints; .obj, .off "
               "and .stl imply it, .ply, .vtp and .vtkhdf hold one as well");
  options
      .choice("remesh",
              parameters_.remesh,
              "with -mesh: remesh to isotropic triangles, or keep the triangles "
              "between the cells")
      .rare();
  options
      .number(
          "edge-length",
          parameters_.edge_length,
          0.0,
          std::numeric_limits<double>::max(),
          "with -mesh: approximate length of edges; 0: the local spacing. Edges are "
          "not made shorter than the spacing of the samples")
      .rare();
  options
      .flag("open",
            parameters_.open,
            "with -mesh: leave the surface open at the border of the samples "
            "instead of closing it by caps")
      .rare();
  options
      .integer("drop-pieces",
               drop_pieces_,
               0,
               std::numeric_limits<std::int32_t>::max(),
               "with -mesh: remove pieces of fewer triangles")
      .rare();
  options
      .choice(
          "periodic-mesh",
          periodic_mesh_,
          "with -mesh and -periodic: cut the mesh at the faces of the box, or weld it: "
          "opposite boundary loops match, and the field image_of names equal vertices")
      .rare();
  options.flag(
      "measure",
      is_measured_,
      "report area, volume and integrals of fields as uvol_measure does, with -mesh "
      "also of the samples inside; points get their share of the area and piece as "
      "fields");
  options.flag("check", is_checked_, "with -mesh: find triangles that intersect")
      .rare();
}

std::optional<pcl_uvol::MeshingParameters>
MeshOptions::finish(const Options& options, const std::string& output) const
{
  if (!is_asked_for_ && !pcl_uvol::isMeshOnly(output)) {
    for (const char* const name :
         {"remesh", "edge-length", "open", "drop-pieces", "periodic-mesh", "check"})
      if (options.given(name))
        throw UsageError(std::string("-") + name + " needs -mesh.");
    return std::nullopt;
  }
  pcl_uvol::checkMeshPath(output);
  if (parameters_.remesh == pcl_uvol::Remeshing::None && options.given("edge-length"))
    throw UsageError("-edge-length needs -remesh even.");
  pcl_uvol::MeshingParameters parameters = parameters_;
  parameters.drop_pieces = drop_pieces_;
  return parameters;
}

} // namespace uvol_tools
