// SPDX-License-Identifier: BSD-3-Clause
#include "support/environment.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace uvol_test {

namespace fs = std::filesystem;

double
Random::uniform()
{
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

TemporaryFolder::TemporaryFolder()
{
  // Digits alone: tests look for words such as "0x" in messages that name their files.
  const std::string stem =
      (fs::temp_directory_path() / "uvol_test_").string() + std::to_string(getpid());
  for (int number = 0; path_.empty(); ++number) {
    const std::string path = stem + "_" + std::to_string(number);
    if (fs::create_directory(path)) // throws unless it is there already
      path_ = path;
  }
}

TemporaryFolder::~TemporaryFolder()
{
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string
TemporaryFolder::operator/(const std::string& name) const
{
  return (fs::path(path_) / name).string();
}

std::vector<std::string>
TemporaryFolder::list() const
{
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string
readFile(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw std::runtime_error("cannot read " + path);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

void
writeFile(const std::string& path, const std::string& content)
{
  std::ofstream out(path, std::ios::binary);
  out << content;
  if (!out.flush())
    throw std::runtime_error("cannot write " + path);
}

std::string
dataFolder()
{
  if (const char* folder = std::getenv("PCL_UVOL_DATA"))
    return folder;
  const fs::path beside = fs::path(PCL_UVOL_SOURCE_DIR) / ".." / "shared" / "data";
  return fs::is_directory(beside) ? beside.lexically_normal().string() : std::string();
}

bool
isSanitized()
{
  return std::getenv("LSAN_OPTIONS") != nullptr ||
         std::getenv("TSAN_OPTIONS") != nullptr;
}

bool
resetPeakMemory()
{
  return bool(std::ofstream("/proc/self/clear_refs") << "5" << std::flush);
}

CommandResult
runCommand(const std::string& command)
{
  const TemporaryFolder folder;
  const std::string out = folder / "out", err = folder / "err";
  const std::string line = "PATH='" PCL_UVOL_TOOL_DIR "':\"$PATH\"; ( " + command +
                           "\n) >'" + out + "' 2>'" + err + "' </dev/null";
  const int status = std::system(line.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return {code, readFile(out), readFile(err)};
}

} // namespace uvol_test
