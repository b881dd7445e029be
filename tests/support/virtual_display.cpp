// SPDX-License-Identifier: BSD-3-Clause
#include "support/virtual_display.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace uvol_test {

namespace {

/** In the child process: become Xvfb, which writes its display's number to a pipe. */
[[noreturn]] void
becomeServer(int pipe_end, std::vector<std::string> arguments)
{
  prctl(PR_SET_PDEATHSIG, SIGTERM); // a test that crashes leaves no server behind
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDERR_FILENO);
  arguments.insert(arguments.begin(),
                   {"Xvfb",
                    "-displayfd",
                    std::to_string(pipe_end),
                    "-noreset", // it would refuse who comes while it resets itself
                    "-screen",
                    "0",
                    "640x480x24",
                    "-nolisten",
                    "tcp"});
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments)
    pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execvp("Xvfb", pointers.data());
  _exit(127);
}

/** What is written to a pipe up to the end of a line. */
std::string
readLine(int pipe_end)
{
  std::string line;
  for (char c = 0; read(pipe_end, &c, 1) == 1 && c != '\n';)
    line += c;
  return line;
}

} // namespace

VirtualDisplay::VirtualDisplay(const std::vector<std::string>& arguments)
{
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error("no pipe");
  server_ = fork();
  if (server_ == 0) {
    close(ends[0]);
    becomeServer(ends[1], arguments);
  }
  close(ends[1]);
  const std::string number = readLine(ends[0]);
  close(ends[0]);
  if (number.empty())
    throw std::runtime_error("Xvfb does not start");
  if (const char* display = std::getenv("DISPLAY"))
    previous_ = display;
  setenv("DISPLAY", (":" + number).c_str(), 1);
}

VirtualDisplay::~VirtualDisplay()
{
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
  if (previous_.empty())
    unsetenv("DISPLAY");
  else
    setenv("DISPLAY", previous_.c_str(), 1);
}

bool
VirtualDisplay::isInstalled()
{
  return std::system("command -v Xvfb >/dev/null") == 0;
}

std::unique_ptr<VirtualDisplay> DisplayTest::display_;

void
DisplayTest::TearDownTestSuite()
{
  display_.reset();
}

void
DisplayTest::SetUp()
{
  if (!VirtualDisplay::isInstalled())
    GTEST_SKIP() << "Xvfb is not installed";
  if (display_ == nullptr)
    display_ = std::make_unique<VirtualDisplay>();
}

} // namespace uvol_test
