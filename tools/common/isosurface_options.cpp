// SPDX-License-Identifier: BSD-3-Clause
#include "common/isosurface_options.h"

namespace uvol_tools {

void
IsosurfaceOptions::declareSamples(Options& options, bool automatic)
{
  options.numbers("iso", "v,...", 0, isovalues, "isovalues (required)");
  options.text("field",
               "name",
               field,
               "scalar field: density, vel[1], |vel|, |vx,vy,vz| (default: intensity, "
               "else the only candidate)");
  options.text("where",
               "expr",
               where,
               "use only the points for which it holds: \"experiment=1 && T>4\"");
  options.text("scale",
               automatic ? "sx,sy,sz|auto" : "sx,sy,sz",
               scale,
               std::string("measure distances in a stretched space") +
                   (automatic ? "; auto: equal spread per axis" : ""));
  options.numbers("xyz",
                  "ix,iy,iz",
                  3,
                  xyz,
                  "columns of a text file that hold the coordinates, from 0");
  options.choice("outside",
                 {"lower", "higher"},
                 outside,
                 "the side normals point to: where values are lower or higher");
}

void
IsosurfaceOptions::declareMethod(Options& options)
{
  options.choice("criterion",
                 {"kept", "all"},
                 criterion,
                 "angle criterion against kept or against all closer candidates");
  options.choice("interpolation",
                 {"linear", "smooth"},
                 interpolation,
                 "isopoints along the edges, or on local polynomial fits");
}

void
IsosurfaceOptions::check() const
{
  if (isovalues.empty())
    throw UsageError(
        "-iso is missing: give one isovalue or several, as in -iso 0.3,0.6.");
}

pcl_uvol::LoadOptions
IsosurfaceOptions::makeLoadOptions() const
{
  pcl_uvol::LoadOptions options;
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    options.xyz_columns[i] = static_cast<int>(xyz[i]);
    if (options.xyz_columns[i] < 0 || options.xyz_columns[i] != xyz[i])
      throw UsageError("-xyz takes three column numbers from 0.");
  }
  return options;
}

pcl_uvol::IsosurfaceSettings
IsosurfaceOptions::makeSettings() const
{
  pcl_uvol::IsosurfaceSettings settings;
  settings.isovalues = isovalues;
  settings.outside =
      outside == "lower" ? pcl_uvol::Outside::Lower : pcl_uvol::Outside::Higher;
  settings.interpolation = interpolation == "smooth" ? pcl_uvol::Interpolation::Smooth
                                                     : pcl_uvol::Interpolation::Linear;
  settings.criterion = criterion == "kept" ? pcl_uvol::AngleCriterion::Kept
                                           : pcl_uvol::AngleCriterion::All;
  return settings;
}

} // namespace uvol_tools
