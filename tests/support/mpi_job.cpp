// SPDX-License-Identifier: BSD-3-Clause
#include "support/mpi_job.h"

#include "support/environment.h"

namespace uvol_test {

bool
hasMpirun()
{
  return runCommand("command -v mpirun").exit_code == 0;
}

std::string
mpirun(std::size_t processes, int seconds)
{
  // Bound processes share the first cores with those of other jobs.
  return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
         "OMPI_MCA_odls_base_sigkill_timeout=0 timeout -k 1 " +
         std::to_string(seconds) +
         " mpirun "
         "-q --oversubscribe --bind-to none -np " +
         std::to_string(processes) + " ";
}

} // namespace uvol_test
