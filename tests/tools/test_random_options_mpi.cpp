// SPDX-License-Identifier: BSD-3-Clause
// Random command lines of the tool of many processes, which is one of them.
#include "support/random_lines.h"

#include <gtest/gtest.h>

namespace test_random_options_mpi {

using uvol_test::countDefaultLines;
using uvol_test::RandomLines;
using uvol_test::RandomTool;

/** Ranks take half a second to start. */
const std::uint64_t default_lines = countDefaultLines() / 5;

/** Started without mpirun; MPI looks for no network, which took most of the time. */
const RandomTool ranks{"isosurface_mpi",
                       "pvtp ply pcd csv vtp",
                       "-iso 0;-iso 0,0.1",
                       1,
                       "",
                       "env OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_pml=ob1 "
                       "OMPI_MCA_btl=self uvol_isosurface_mpi"};

TEST(RandomRankOptions, EndInASentenceOrAResult)
{
  RandomLines(ranks).run(0, default_lines);
}

TEST(RandomRankOptions, EndInASentenceOrAResult_long)
{
  RandomLines(ranks).run(default_lines, 800);
}

} // namespace test_random_options_mpi
