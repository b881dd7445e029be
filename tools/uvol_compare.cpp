// SPDX-License-Identifier: BSD-3-Clause
// How far two surfaces are apart, and how much their fields differ.
#include "mesh/measured_mesh.h"
#include "mesh/surface_distance.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::Report;
using pcl_uvol::Triangle;
using pcl_uvol::detail::FieldDifference;
using pcl_uvol::detail::SurfaceDistances;
using uvol_tools::Fact;
using uvol_tools::Facts;
using uvol_tools::Options;

constexpr std::size_t most_fields_listed = 1000;

struct Surface {
  Dataset vertices;
  std::vector<Triangle> triangles;
};

Surface
loadSurface(const std::string& path, Report& report)
{
  Surface surface;
  if (pcl_uvol::isMeshPath(path))
    surface.vertices = uvol_tools::loadMesh(path, surface.triangles, report);
  else
    surface.vertices = uvol_tools::loadPoints(path, report);
  if (surface.vertices.cloud.width == 0)
    throw pcl_uvol::InvalidArgument("no_points", {{"path", path}});
  try {
    pcl_uvol::detail::checkTriangles(pcl_uvol::viewOf(surface.vertices.cloud),
                                     surface.triangles);
  }
  catch (const pcl_uvol::InvalidArgument& error) {
    throw pcl_uvol::IOError(
        "unusable_mesh",
        {{"path", path},
         {"reason", error.asMessage().text(pcl_uvol::ParameterNames::Options)}});
  }
  return surface;
}

/** The distances one way.
 * \param name as in "a to b" */
void
describe(const SurfaceDistances& distances, const std::string& name, Facts& facts)
{
  const Eigen::Vector3d& at = distances.farthest;
  uvol_tools::FactText text;
  text << "mean " << distances.mean << ", root mean square "
       << distances.root_mean_square << ", 99.9 % within " << distances.permille
       << ", largest " << distances.largest << " at " << at[0] << "," << at[1] << ","
       << at[2];
  facts.push_back(Fact(name,
                       text.str(),
                       Fact::Members{{"mean", {distances.mean}},
                                     {"root_mean_square", {distances.root_mean_square}},
                                     {"percentile_99_9", {distances.permille}},
                                     {"largest", {distances.largest}},
                                     {"farthest", {at[0], at[1], at[2]}}}));
  Facts fields;
  for (const FieldDifference& field : distances.fields) {
    if (fields.size() == most_fields_listed)
      break;
    uvol_tools::FactText difference;
    difference << "differs by " << field.mean << " in the mean, " << field.largest
               << " at most";
    facts.push_back(Fact(field.name + ", " + name, difference.str()).withoutJson());
    fields.emplace_back(
        field.name,
        "",
        Fact::Members{{"mean", {field.mean}}, {"largest", {field.largest}}});
  }
  facts.emplace_back("fields " + name, fields);
}

void
warnOfManyFields(const SurfaceDistances& distances, Report& report)
{
  if (distances.fields.size() > most_fields_listed)
    report.warn("many_common_fields",
                {{"fields", distances.fields.size()}, {"listed", most_fields_listed}});
}

int
run(int argc, char** argv)
{
  std::string first, second, output;
  bool ascii = false;
  Options options(
      "uvol_compare",
      "a.ply b.ply [out.ply] [options]",
      "Measure the distances between two surfaces in both directions, and "
      "differences of common fields.\n"
      "Surfaces: meshes (ply vtp vtkhdf obj off stl) or points. Output: a with the "
      "field distance,\n"
      "negative inside b (draw it by uvol_render -color distance).");
  options.file("a", first);
  options.file("b", second);
  options.file("out", output, false);
  options.group("Output");
  options.flag("ascii", ascii, "write PCD and PLY as text");
  if (!options.parse(argc, argv))
    return 0;
  Report report;
  Surface a = loadSurface(first, report);
  if (!output.empty() && a.triangles.empty())
    pcl_uvol::checkSavePath(output, a.vertices.cloud.fields);
  else if (!output.empty())
    pcl_uvol::checkMeshPath(output);
  const Surface b = loadSurface(second, report);
  Facts facts = {{"a", first}, {"b", second}};
  const auto [there, back] =
      pcl_uvol::detail::compareSurfaces({a.vertices, a.triangles},
                                        {b.vertices, b.triangles},
                                        {"'" + first + "'", "'" + second + "'"},
                                        options.threads(),
                                        report);
  warnOfManyFields(there, report);
  describe(there, "a to b", facts);
  describe(back, "b to a", facts);
  facts.emplace_back("largest distance", std::max(there.largest, back.largest));
  if (!output.empty()) {
    setField(a.vertices, "distance", there.at_vertices);
    pcl_uvol::SaveOptions save;
    save.ascii = ascii;
    if (a.triangles.empty())
      uvol_tools::savePoints(output, a.vertices, save, report);
    else {
      pcl_uvol::saveMesh(output, a.vertices, a.triangles, save);
      uvol_tools::warnOfLosses(output, a.vertices, report);
    }
  }
  uvol_tools::printReport(options, report, facts);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_compare", [&] { return run(argc, argv); });
}
