// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/extract_points.h"

namespace pcl_uvol {

SurfaceTriangles
extractPoints(IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
              const IsosurfaceParameters& parameters,
              unsigned threads,
              Report& report)
{
  extraction.setParameters(parameters);
  extraction.setNumberOfThreads(threads);
  extraction.setProgressCallback(report.progress);
  SurfaceTriangles found;
  extraction.extract(found.vertices);
  report.merge(extraction.getReport());
  found.edges = extraction.getEdges();
  found.tally = extraction.getTally();
  return found;
}

} // namespace pcl_uvol
