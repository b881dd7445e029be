// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_cluster/cluster_options.h"

#include "io/table_file.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <cmath>
#include <limits>

namespace uvol_tools {

void
ClusterOptions::declare(Options& options)
{
  constexpr double huge = std::numeric_limits<double>::max();
  options.file("in", input);
  options.file("out", output);
  options.group("Input");
  attributes.declare(options);
  reading.declare(options);
  options.group("Clusters");
  options.integer("k", k, 0, 1000, "nearest neighbours for the density estimate");
  options.integer("min-size",
                  min_size,
                  2,
                  std::numeric_limits<std::uint32_t>::max(),
                  "fewest points of a cluster (default: the larger of 10 and the "
                  "square root of the number of points)");
  options.number("cut",
                 cut,
                 std::numeric_limits<double>::min(),
                 huge,
                 "choose the clusters at that distance of attributes (default: by "
                 "persistence)");
  options.flag("single", single, "allow a single cluster");
  options.group("Output");
  options.output("tree", "out.csv", tree, "write the tree of clusters")
      .check(pcl_uvol::checkTablePath);
  options.group("Input");
  options.text(
      "label",
      "name",
      label,
      "field with the cluster labels, instead of -attributes (default: label)");
  options.group("Surface of a cluster");
  options.numbers("cluster", "n", 1, cluster, "choose the points of a cluster");
  options.choice("surface",
                 {"membership", "distance", "hull", "hull-distance"},
                 surface,
                 "surface of -cluster: border to the other samples, offset surface of "
                 "its points, hull of its outer points, or offset surface of the hull");
  options.text("probability",
               "name",
               probability,
               "membership: a field in [0, 1] instead of 0 and 1");
  options.text("smoothing-length",
               "name",
               smoothing,
               "membership: smooth it by the kernel of SPH with that field as the "
               "particles' smoothing lengths");
  options.integer("grid",
                  grid,
                  4,
                  pcl_uvol::GridShape::largest_side,
                  "cells of the distance field along the longest side");
  options.number("distance",
                 distance,
                 std::numeric_limits<double>::min(),
                 huge,
                 "distance of the surface from the points (default: just beyond the "
                 "longest edge of the points' "
                 "minimum spanning tree)");
  scale.declare(options, "distances of -surface", AutomaticScale::Spacing);
  options.group("Output");
  options.flag("ascii", ascii, "write PCD and PLY as text");
}

void
ClusterOptions::finish(const Options& options)
{
  scale.finish(options);
  if (!surface.empty() && cluster.empty())
    throw UsageError("-surface needs -cluster: choose one.");
  for (const char* const name : {"scale", "rotate"})
    if (options.given(name) && surface.empty())
      throw UsageError(std::string("-") + name + " needs -surface.");
  if (!cluster.empty() &&
      (std::abs(cluster[0]) > std::numeric_limits<std::int32_t>::max() ||
       cluster[0] != std::round(cluster[0])))
    throw UsageError("-cluster is a whole number: the label of a cluster.");
  if (attributes.areGiven() && options.given("label"))
    throw UsageError("-attributes finds clusters and -label reads them: give one.");
  for (const char* const name : {"k", "min-size", "cut", "single", "tree", "raw"})
    if (options.given(name) && !attributes.areGiven())
      throw UsageError(std::string("-") + name + " needs -attributes.");
  for (const char* const name : {"grid", "distance"})
    if (options.given(name) && !isMesh())
      throw UsageError(std::string("-") + name +
                       " needs -surface distance, hull or hull-distance.");
  for (const char* const name : {"probability", "smoothing-length"})
    if (options.given(name) && surface != "membership")
      throw UsageError(std::string("-") + name + " needs -surface membership.");
  pcl_uvol::checkSavePath(output);
  if (isMesh())
    pcl_uvol::checkMeshPath(output);
  if (tree == output)
    throw UsageError("-tree and the output are the same file.");
}

} // namespace uvol_tools
