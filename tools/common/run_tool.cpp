// SPDX-License-Identifier: BSD-3-Clause
// From exceptions to exit codes: 0 success, 1 failure, 2 a wrong command line.
#include "common/options.h"
#include <pcl_uvol/common/exceptions.h>

#include <csignal>
#include <iostream>
#include <new>

namespace uvol_tools {

int
runTool(const char* tool, const std::function<int()>& body)
{
  // Writing beyond a limit or into a closed pipe shall be an error, not a sudden death.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  const auto fail = [&](int exit_code, const std::string& sentence) {
    std::cerr << tool << ": " << sentence << '\n';
    return exit_code;
  };
  try {
    const int exit_code = body();
    if (!std::cout.flush())
      return fail(1, "Standard output could not be written.");
    return exit_code;
  }
  catch (const UsageError& error) {
    return fail(2, std::string(error.what()) + " (" + tool + " -h lists the options)");
  }
  catch (const pcl_uvol::Exception& error) {
    return fail(1, error.message());
  }
  catch (const std::bad_alloc&) {
    return fail(1, "There is not enough memory.");
  }
  catch (const std::exception& error) {
    return fail(1, error.what());
  }
}

} // namespace uvol_tools
