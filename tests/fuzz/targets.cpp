// SPDX-License-Identifier: BSD-3-Clause
#include "targets.h"

namespace uvol_fuzz {

const std::vector<Target>&
listTargets()
{
  static const std::vector<Target> targets{
      {"pcd", Group::readers, readPcd},
      {"ply", Group::readers, readPly},
      {"text", Group::readers, readText},
      {"legacy_vtk", Group::readers, readLegacyVtk},
      {"xml_vtk", Group::readers, readXmlVtk},
      {"nrrd", Group::readers, readNrrd},
      {"meta_image", Group::readers, readMetaImage},
      {"gadget", Group::readers, readGadget},
      {"hdf5", Group::readers, readHdf5},
      {"vtkhdf", Group::readers, readVtkHdf},
#ifdef PCL_UVOL_HAS_NETCDF
      {"netcdf", Group::readers, readNetcdf},
#endif
      {"bgeo", Group::readers, readBgeo},
      {"las", Group::readers, readLas},
      {"npy", Group::readers, readNpy},
      {"npz", Group::readers, readNpz},
      {"obj", Group::readers, readObj},
      {"off", Group::readers, readOff},
      {"stl", Group::readers, readStl},
      {"scene", Group::readers, readScene},
      {"file_list", Group::readers, readFileList},
      {"plot3d", Group::readers, readPlot3d},
      {"packed", Group::readers, readPacked},
      {"parameters", Group::texts, readParameters},
      {"expression", Group::texts, readExpression},
      {"isosurface", Group::stages, extractIsosurface},
      {"mesh", Group::stages, meshSurface},
      {"level_set", Group::stages, evolveLevelSet},
      {"interpolation", Group::stages, interpolateFields},
      {"clustering", Group::stages, clusterAttributes},
      {"splats", Group::stages, makeSplats},
      {"ray_tracer", Group::stages, traceRays},
      {"renderer", Group::stages, renderPoints},
      {"gap_filling", Group::stages, fillGaps},
      {"periodic_box", Group::stages, extractInBox},
      {"normals", Group::stages, estimateNormals},
      {"measures", Group::stages, measureSurface},
      {"voronoi_grid", Group::stages, divideSpace},
      {"hull", Group::stages, wrapCluster},
      {"convex_hull", Group::stages, wrapSamples},
      {"star_coordinates", Group::stages, projectAttributes},
  };
  return targets;
}

} // namespace uvol_fuzz
