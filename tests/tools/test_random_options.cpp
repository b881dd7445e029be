// SPDX-License-Identifier: BSD-3-Clause
// Random command lines of every tool but those that open windows or run ranks.
#include "support/random_lines.h"

#include <gtest/gtest.h>

namespace {

using uvol_test::RandomLines;
using uvol_test::RandomTool;

class RandomOptions : public testing::TestWithParam<RandomTool> {};

TEST_P(RandomOptions, EndInASentenceOrAResult)
{
  RandomLines(GetParam()).run(0, 25);
}

TEST_P(RandomOptions, EndInASentenceOrAResult_long)
{
  RandomLines(GetParam()).run(25, 175);
}

INSTANTIATE_TEST_SUITE_P(
    Tools,
    RandomOptions,
    testing::Values(
        RandomTool{"isosurface", "ply pcd csv vtp obj xyz", "-iso 0;-iso 0,0.1"},
        RandomTool{"levelset", "ply csv", "-iso 0"},
        RandomTool{"probe",
                   "ply csv vti",
                   "-plane z=0 -size 16;-line 0,0,0,1,1,1 -n "
                   "20;-grid 5"},
        RandomTool{"cluster", "ply csv", "-attributes f;-attributes x,f;-position"},
        RandomTool{"project", "ply csv", "-attributes x,y,f;-attributes f,g"},
        RandomTool{"voronoi", "vti ply", "-grid 8"},
        RandomTool{"normals", "ply pcd", "-k 9"},
        RandomTool{"splats", "ply csv", "-delta 0.01"},
        RandomTool{"render", "png ply", "-size 16x16"},
        RandomTool{"raytrace", "png", "-size 16x16"},
        RandomTool{"generate", "ply pcd csv vtp", "-n 20", 0},
        RandomTool{"convert", "ply pcd csv vtp vtkhdf npz", ""},
        RandomTool{"info", "", ""},
        RandomTool{"measure", "csv ply vtp", "-iso 0;-iso 0,0.1;-flat;-check"},
        RandomTool{"compare", "ply csv", "", 2}),
    [](const auto& tool) { return tool.param.name; });

} // namespace
