// SPDX-License-Identifier: BSD-3-Clause
#include "targets.h"

namespace uvol_fuzz {

const std::vector<Target>&
listTargets()
{
  static const std::vector<Target> targets{
      {"pcd", readPcd},
      {"ply", readPly},
      {"text", readText},
      {"legacy_vtk", readLegacyVtk},
      {"xml_vtk", readXmlVtk},
      {"nrrd", readNrrd},
      {"meta_image", readMetaImage},
      {"gadget", readGadget},
      {"hdf5", readHdf5},
      {"vtkhdf", readVtkHdf},
      {"bgeo", readBgeo},
      {"las", readLas},
      {"npy", readNpy},
      {"npz", readNpz},
      {"scene", readScene},
      {"parameters", readParameters},
      {"expression", readExpression},
      {"isosurface", extractIsosurface},
      {"mesh", meshSurface},
      {"level_set", evolveLevelSet},
      {"interpolation", interpolateFields},
      {"clustering", clusterAttributes},
      {"splats", makeSplats},
      {"ray_tracer", traceRays},
      {"renderer", renderPoints},
  };
  return targets;
}

} // namespace uvol_fuzz
