// SPDX-License-Identifier: BSD-3-Clause
// Processes get what others send, whatever its size, and none waits for one that
// failed.
#include "support/environment.h"
#include "support/mpi_job.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace test_mpi_communicator {

class MpiProcesses : public testing::Test {
protected:
  void
  SetUp() override
  {
    if (!uvol_test::hasMpirun())
      GTEST_SKIP() << "there is no mpirun";
  }

  static void
  expectSuccess(std::size_t processes, const std::string& arguments)
  {
    SCOPED_TRACE(std::to_string(processes) + " talk " + arguments);
    const auto result =
        uvol_test::runCommand(uvol_test::mpirun(processes) + "talk " + arguments);
    EXPECT_EQ(0, result.exit_code) << result.err;
    EXPECT_EQ("", result.err);
    for (std::size_t rank = 0; rank < processes; ++rank)
      EXPECT_NE(std::string::npos,
                result.out.find("process " + std::to_string(rank) + " of " +
                                std::to_string(processes)))
          << result.out;
  }
};

TEST_F(MpiProcesses, GetWhatOthersSend)
{
  for (const std::size_t processes : {1, 2, 5})
    expectSuccess(processes, "1000000");
}

TEST_F(MpiProcesses, PutPartsOfMessagesTogether)
{
  expectSuccess(3, "1000"); // also messages of just some parts
  expectSuccess(3, "777");
}

TEST_F(MpiProcesses, DoNotWaitForOneThatFailed)
{
  expectSuccess(3, "1000 2 allReduce");
  expectSuccess(3, "1000 2 allToAll");
  expectSuccess(3, "1000 1 allGather");
  expectSuccess(4, "1000 1 allToAll"); // three of them at once
  expectSuccess(2, "1000 0 allReduce");
  expectSuccess(5, "1000 3 group");
  expectSuccess(4, "1000 0 group");
  expectSuccess(3, "1000 1 group"); // alone in it
}

} // namespace test_mpi_communicator
