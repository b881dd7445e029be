// SPDX-License-Identifier: BSD-3-Clause
// Every tool where the system refuses: calls that fail, signals, limits, and strange
// places of input and output. It ends by itself, with one sentence unless it succeeds;
// the output is whole, or what was there before; nothing else is left.
#include "sentences.h"
#include "tools/json_warnings.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <set>
#include <sys/stat.h>

namespace test_faults {

using uvol_test::CommandResult;
using uvol_test::readFile;
using uvol_test::runCommand;
using uvol_test::writeFile;
namespace fs = std::filesystem;

struct Tool {
  const char *name, *command; ///< with IN, SURFACE and MESH read, OUT written
  /** Whether it works with FLANN, VTK's writers or OpenGL, which do not survive every
   * lack of memory. */
  bool may_die = false;
};

/** The fault itself, told by the shell or the library in front. */
struct Fault {
  std::string before, faults = {}; ///< before the command; for the library
  int signal = 0;                  ///< that may end it
};

class Faults : public testing::TestWithParam<Tool> {
protected:
  void
  SetUp() override
  {
    if (uvol_test::isSanitized())
      GTEST_SKIP() << "a sanitizer has to be loaded first";
    fs::create_directory(folder_ / "tmp");
    for (const char* const command : {"uvol_generate in.csv -n 300",
                                      "uvol_isosurface in.csv surface.ply -iso 2",
                                      "uvol_isosurface in.csv mesh.ply -iso 2 -mesh"})
      ASSERT_EQ(0, runCommand("cd '" + (folder_ / "") + "' && " + command).exit_code);
    inputs_ = folder_.list();
    uvol_test::succeeded(run({}));
    expected_ = readFile(out());
  }

  std::string
  makeCommand(const std::string& out) const
  {
    std::string line = GetParam().command;
    for (const auto& [word, file] :
         std::map<std::string, std::string>{{"IN", "in.csv"},
                                            {"SURFACE", "surface.ply"},
                                            {"MESH", "mesh.ply"},
                                            {"OUT", out}})
      if (const auto at = line.find(word); at != std::string::npos)
        line.replace(at, word.size(), file);
    return line;
  }

  std::string
  toolName() const
  {
    const std::string line = GetParam().command;
    return line.substr(0, line.find(' '));
  }

  /** What the command calls its output. */
  std::string
  outName() const
  {
    const std::string line = GetParam().command;
    const std::size_t at = line.find("OUT");
    return line.substr(at, line.find(' ', at) - at).replace(0, 3, "out");
  }

  std::string
  out() const
  {
    return folder_ / outName();
  }

  CommandResult
  run(const Fault& fault, const std::string& out = "out") const
  {
    std::string library;
    if (!fault.faults.empty())
      library = "LD_PRELOAD=" PCL_UVOL_FAULTS " UVOL_FAULTS=" + fault.faults + ' ';
    return runCommand("cd '" + (folder_ / "") + "' && " + fault.before +
                      " timeout 60 env TMPDIR='" + (folder_ / "tmp") + "' " + library +
                      makeCommand(out));
  }

  void
  expectSound(const Fault& fault)
  {
    SCOPED_TRACE(fault.before + ' ' + fault.faults);
    writeFile(out(), "old");
    const auto result = run(fault);
    constexpr int signals = 128; // of shells
    const bool ended_itself = result.exit_code >= 0 && result.exit_code <= 2;
    const bool lacks_memory = fault.faults.rfind("malloc", 0) == 0;
    const bool may_die = GetParam().may_die && lacks_memory &&
                         (result.exit_code == signals + SIGABRT ||
                          result.exit_code == signals + SIGSEGV);
    // The runtime of OpenMP ends a program where the one call that fails is its own.
    const bool ended_by_openmp =
        lacks_memory && result.err.find("libgomp: Out of memory") != std::string::npos;
    EXPECT_TRUE(ended_itself || may_die ||
                (fault.signal != 0 && result.exit_code == signals + fault.signal))
        << result.exit_code << result.err;
    if (ended_itself && !ended_by_openmp)
      uvol_test::expectSentences(toolName(), result);
    const std::string now = readFile(out());
    EXPECT_TRUE(now == expected_ || (result.exit_code != 0 && now == "old"))
        << now.size() << " bytes";
    auto left = folder_.list();
    left.erase(std::remove(left.begin(), left.end(), outName()), left.end());
    if (fault.signal == SIGKILL && left != inputs_) { // for the next run to take away
      EXPECT_EQ(0, run({}).exit_code);
      left = folder_.list();
      left.erase(std::remove(left.begin(), left.end(), outName()), left.end());
    }
    EXPECT_EQ(inputs_, left);
    EXPECT_TRUE(fs::is_empty(folder_ / "tmp"));
  }

  /** How often each call is made. */
  std::map<std::string, long>
  countCalls() const
  {
    const std::string file = folder_ / "tmp/counts";
    run({"", "count=" + file});
    std::map<std::string, long> counts;
    std::istringstream lines(readFile(file));
    long count = 0;
    for (std::string call; lines >> call >> count;)
      counts[call] = count;
    fs::remove(file);
    return counts;
  }

  /** Calls work(fault) for moments spread over all calls of a kind.
   * \param place of one moment alone, as a share of them all */
  template <typename Work>
  static void
  forMoments(const std::pair<const std::string, long>& call,
             long moments,
             double place,
             const Work& work)
  {
    const long most = std::min(moments, call.second);
    for (long i = 0; i < most; ++i) {
      const double share =
          most == 1 ? place : static_cast<double>(i) / static_cast<double>(most - 1);
      const long number =
          1 + static_cast<long>(share * static_cast<double>(call.second - 1));
      work(call.first + ':' + std::to_string(number));
    }
  }

  /** \param calls that fail; empty: all */
  void
  failCalls(long moments, const std::set<std::string>& calls = {})
  {
    for (const auto& call : countCalls())
      forMoments(call, moments, 0.5, [&](const std::string& fault) {
        if (!calls.empty() && calls.count(call.first) == 0)
          return;
        expectSound({"", fault});
        if (call.first != "malloc" && call.first != "open")
          expectSound({"", fault + '+'}); // a disk that is full stays full
      });
  }

  void
  sendSignals(long moments,
              const std::vector<int>& signals,
              const std::vector<const char*>& calls)
  {
    const auto counts = countCalls();
    double place = 0.2;
    for (const int signal : signals)
      for (const char* const call : calls) {
        forMoments(*counts.find(call), moments, place, [&](const std::string& fault) {
          expectSound({"", fault + ':' + std::to_string(signal), signal});
        });
        place += 0.3;
      }
  }

  /** \param size KB of the first limit, those that follow grow by 2 % */
  void
  limitMemory(double size, int steps)
  {
    for (int i = 0; i < steps; ++i, size *= 1.02) {
      const std::string limit =
          "ulimit -v " + std::to_string(static_cast<long>(size)) + " && exec";
      if (canLoad(limit))
        expectSound({limit});
    }
  }

  /** False where the tool's libraries find no room, before it begins: they are not
   * loaded, or VTK's static objects end the program. */
  bool
  canLoad(const std::string& limit) const
  {
    constexpr int not_loaded = 127, aborted = 128 + SIGABRT;
    const int code = runCommand(limit + ' ' + toolName() + " -version").exit_code;
    return code != not_loaded && code != aborted;
  }

  const uvol_test::TemporaryFolder folder_;
  std::vector<std::string> inputs_;
  std::string expected_;
};

TEST_P(Faults, CallsThatFail)
{
  failCalls(1, {"write", "rename"}); // a full disk
}

TEST_P(Faults, CallsThatFail_long)
{
  failCalls(40);
}

TEST_P(Faults, Signals)
{
  sendSignals(1, {SIGINT}, {"malloc"});
}

TEST_P(Faults, Signals_long)
{
  sendSignals(
      17, {SIGKILL, SIGINT, SIGTERM}, {"malloc", "open", "write", "fsync", "rename"});
}

TEST_P(Faults, LimitsOfMemory)
{
  limitMemory(104e3, 1);
}

TEST_P(Faults, LimitsOfMemory_long)
{
  limitMemory(90e3, 40);
}

TEST_P(Faults, LimitsOfFiles)
{
  for (const char* const limit : {"-n 8", "-n 5", "-f 1"})
    expectSound({std::string("ulimit ") + limit + " && exec"});
}

TEST_P(Faults, StrangeSurroundings)
{
  expectSound({"LC_ALL=de_DE.UTF-8"});
  for (const char* const closed : {"<&-", ">&-", "2>&-", "<&- >&-"})
    expectSound({std::string("exec ") + closed + " ;"});
}

TEST_P(Faults, NoFolderForTemporaryFiles)
{
  fs::remove(folder_ / "tmp");
  const auto result = run({});
  EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << result.exit_code;
  uvol_test::expectSentences(toolName(), result);
  if (result.exit_code == 0) {
    EXPECT_EQ(expected_, readFile(out()));
  }
}

TEST_P(Faults, StrangeOutputs)
{
  const std::string ending = outName().substr(3);
  fs::create_directory(folder_ / ("folder" + ending));
  ASSERT_EQ(0, ::mkfifo((folder_ / ("pipe" + ending)).c_str(), 0600));
  fs::create_symlink("/dev/full", folder_ / ("full" + ending));
  fs::create_symlink("loop" + ending, folder_ / ("loop" + ending));
  const auto before = folder_.list();
  for (const std::string name :
       {"folder", "pipe", "full", "loop", "none/out", "/proc/out", "in.csv/out"}) {
    SCOPED_TRACE(name);
    const auto result = run({}, name);
    EXPECT_TRUE(result.exit_code == 1 || result.exit_code == 2) << result.exit_code;
    uvol_test::expectSentences(toolName(), result);
    EXPECT_EQ(before, folder_.list());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Tools,
    Faults,
    testing::Values(Tool{"isosurface", "uvol_isosurface IN OUT.ply -iso 2"},
                    Tool{"mesh", "uvol_isosurface IN OUT.vtp -iso 2 -mesh", true},
                    Tool{"bounded",
                         "uvol_isosurface IN OUT.csv -iso 2 -max-memory 150M"},
                    Tool{"levelset", "uvol_levelset IN OUT.csv -iso 2"},
                    Tool{"probe", "uvol_probe IN OUT.vti -plane z=0 -size 8", true},
                    Tool{"cluster", "uvol_cluster IN OUT.ply -attributes radial"},
                    Tool{"project", "uvol_project IN OUT.csv -attributes x,y,radial"},
                    Tool{"voronoi", "uvol_voronoi IN OUT.vti -grid 6", true},
                    Tool{"normals", "uvol_normals SURFACE OUT.pcd", true},
                    Tool{"splats", "uvol_splats SURFACE OUT.csv"},
                    Tool{"render", "uvol_render SURFACE OUT.png -size 24x24", true},
                    Tool{"raytrace", "uvol_raytrace SURFACE OUT.png -size 16x16", true},
                    Tool{"generate", "uvol_generate OUT.csv -n 50"},
                    Tool{"convert", "uvol_convert IN OUT.npz"},
                    Tool{"hdf5", "uvol_convert IN OUT.vtkhdf"},
                    Tool{"measure", "uvol_measure MESH OUT.csv"},
                    Tool{"compare", "uvol_compare MESH SURFACE OUT.ply"}),
    [](const auto& tool) { return tool.param.name; });

} // namespace test_faults
