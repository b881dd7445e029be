// SPDX-License-Identifier: BSD-3-Clause
// From exceptions to exit codes: 0 success, 1 failure, 2 a wrong command line.
#include "shared/options.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/io/dataset.h>

#include <pcl/console/print.h>

#include <csignal>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>

namespace uvol_tools {

namespace {

/** Signals that end a tool take its unfinished files with them. */
void
endBySignal(int signal)
{
  pcl_uvol::removeUnfinishedFiles();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/** A sentence that says which file it is about. */
std::string
withFile(const std::string& sentence)
{
  const std::string& file = namedFile();
  return file.empty() || sentence.find(file) != std::string::npos
             ? sentence
             : file + ": " + sentence;
}

/** \param is_of_file without its file a sentence could be about any */
Outcome
fail(const pcl_uvol::Message& message, bool is_of_file = false)
{
  const std::string text = message.text(pcl_uvol::ParameterNames::Options);
  return {1, is_of_file ? withFile(text) : text, "", message.code, message.values};
}

} // namespace

Outcome
catchErrors(const char* tool, const std::function<int()>& body)
{
  // What PCL would tell of errors, the sentence of the error tells.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  // Writing beyond a limit or into a closed pipe shall be an error, not a sudden death.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU})
    if (std::signal(signal, endBySignal) == SIG_IGN) // as nohup asks for
      std::signal(signal, SIG_IGN);
  using pcl_uvol::Message;
  try {
    const int exit_code = body();
    if (!std::cout.flush())
      return fail({"output_closed", {}});
    return {exit_code, ""};
  }
  catch (const UsageError& error) {
    return {2,
            std::string(error.what()) + " (" + tool + " -h lists the options)",
            "",
            "command_line",
            {{"text", std::string(error.what())}}};
  }
  catch (const pcl_uvol::IOError& error) { // which names its file
    return fail(error.asMessage());
  }
  catch (const pcl_uvol::ExpressionError& error) {
    Outcome outcome = fail(error.asMessage());
    outcome.sentence = withFile(error.getSentence());
    outcome.marked_lines = error.getMarkedLines();
    return outcome;
  }
  catch (const pcl_uvol::Exception& error) {
    return fail(error.asMessage(), true);
  }
  catch (const std::bad_alloc&) {
    return fail({"out_of_memory", {}}, true);
  }
  catch (const std::length_error&) { // of a vector longer than any memory
    return fail({"out_of_memory", {}}, true);
  }
  catch (const std::system_error&) { // of threads that the system does not give
    return fail({"out_of_threads", {}}, true);
  }
  catch (const std::exception& error) {
    // TBB, which VTK's filters run on, tells of threads that it is not given.
    if (std::string(error.what()).find("pthread_create") != std::string::npos)
      return fail({"out_of_threads", {}}, true);
    return fail(Message(error.what()));
  }
}

int
runTool(const char* tool, const std::function<int()>& body)
{
  try {
    const Outcome outcome = catchErrors(tool, body);
    if (!outcome.sentence.empty())
      printError(tool, outcome);
    return outcome.exit_code;
  }
  catch (const std::bad_alloc&) { // not even for the sentence
    std::cerr << tool << ": There is not enough memory.\n";
    return 1;
  }
}

} // namespace uvol_tools
