// SPDX-License-Identifier: BSD-3-Clause
// The library for VTK, HDF5 and NetCDF: what needs it says so if it cannot be loaded,
// and all else works without it.
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace test_vtk_library {

using uvol_test::runCommand;

TEST(VtkLibrary, IsLoadedOnlyForFilesThatNeedIt)
{
  const uvol_test::TemporaryFolder folder;
  const std::string there = "cd '" + folder / "" + "' && ";
  uvol_test::runWell(there + "uvol_generate in.pcd -field torus -n 3000");
  uvol_test::writeFile(folder / "in.vti", "<VTKFile");
  // A damaged library is found before the right one.
  uvol_test::writeFile(folder / "libpcl_uvol_io_vtk.so.0.2", "");
  const std::string without = there + "LD_LIBRARY_PATH=. ";
  for (const char* const line :
       {"uvol_info in.pcd", "uvol_isosurface in.pcd out.ply -iso 0.1 -mesh"})
    EXPECT_EQ(0, runCommand(without + line).exit_code) << line;
  for (const char* const line :
       {"uvol_isosurface in.pcd out.vtp -iso 0.1", "uvol_generate in.vti in.pcd"}) {
    SCOPED_TRACE(line);
    uvol_test::expectError(runCommand(without + line + " -json"),
                           "vtk_library_not_loaded");
  }
  EXPECT_EQ((std::vector<std::string>{
                "in.pcd", "in.vti", "libpcl_uvol_io_vtk.so.0.2", "out.ply"}),
            folder.list());
}

} // namespace test_vtk_library
