// SPDX-License-Identifier: BSD-3-Clause
// Every front end warns of the same things on the same samples: the tool, the tool on
// ranks, Python, the filter of VTK and the viewer.
#include "support/mpi_job.h"
#include "support/snapshots.h"
#include "support/virtual_display.h"
#include "vtk_setup.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/message.h>
#include <pcl_uvol/filters/vtkUvolIsosurface.h>
#include <pcl_uvol/filters/vtkUvolLevelSet.h>
#include <pcl_uvol/io/dataset.h>

#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

namespace test_same_warnings {

using namespace uvol_test;
using nlohmann::json;
using pcl_uvol::Message;
using pcl_uvol::ParameterNames;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/** Samples of the field `f`. */
struct Samples {
  std::vector<double> xyz;
  std::vector<float> f;

  void
  add(double x, double y, double z, double value)
  {
    xyz.insert(xyz.end(), {x, y, z});
    f.push_back(static_cast<float>(value));
  }
};

/** A ball's distance at random places of a cube, and what goes wrong with it. */
Samples
makeBall(const std::function<void(Random&, Samples&, std::size_t i)>& spoil,
         double offset = 0.0)
{
  Random random(11);
  Samples samples;
  for (std::size_t i = 0; i < 4000; ++i) {
    double place[3];
    for (double& coordinate : place)
      coordinate = 2.0 * random.uniform() - 1.0;
    samples.add(offset + place[0],
                offset + place[1],
                offset + place[2],
                std::hypot(place[0], place[1], place[2]));
    spoil(random, samples, i);
  }
  return samples;
}

Samples
makeBall(double offset = 0.0)
{
  return makeBall([](Random&, Samples&, std::size_t) {}, offset);
}

/** Vertical lines of samples far apart. */
Samples
makeLines()
{
  Random random(5);
  Samples samples;
  for (int line = 0; line < 40; ++line) {
    const double x = random.uniform(), y = random.uniform();
    for (int i = 0; i < 60; ++i)
      samples.add(x, y, i / 200.0, x + 0.05 * std::sin(i / 3.0));
  }
  return samples;
}

struct Subject {
  const char* name;
  Samples samples;
  double isovalue;
  const char* code; ///< of a warning that is there; empty: there is none
};

const std::vector<Subject>&
listSubjects()
{
  static const std::vector<Subject> subjects{
      {"Ball", makeBall(), 0.6, ""},
      {"NoSurface", makeBall(), 7.0, "no_isopoints"},
      {"Border", makeBall(), 1.6, "isopoints_at_border"},
      {"Lines", makeLines(), 0.5, "contradicted_isopoints"},
      {"Noise",
       makeBall([](Random& random, Samples& samples, std::size_t) {
         samples.f.back() += static_cast<float>(random.uniform() - 0.5);
       }),
       0.6,
       "thin_parts"},
      {"Spikes",
       makeBall([](Random&, Samples& samples, std::size_t i) {
         if (i % 50 == 0)
           samples.f.back() = 5.0f;
       }),
       1.0,
       "spikes"},
      {"Conflicts",
       makeBall([](Random&, Samples& samples, std::size_t i) {
         if (i % 4 == 0)
           samples.add(samples.xyz[samples.xyz.size() - 3],
                       samples.xyz[samples.xyz.size() - 2],
                       samples.xyz[samples.xyz.size() - 1],
                       static_cast<double>(samples.f.back()) + 0.01);
       }),
       0.6,
       "conflicting_samples"},
      {"FarPoints",
       makeBall([](Random&, Samples& samples, std::size_t i) {
         if (i == 7)
           samples.xyz.back() = 1e30;
       }),
       0.6,
       "far_points"},
      {"Missing",
       makeBall([](Random&, Samples& samples, std::size_t i) {
         if (i % 3 == 0)
           samples.f.back() = static_cast<float>(nan);
       }),
       0.6,
       ""},
      {"Sheet",
       [] {
         Random random(3);
         Samples samples;
         for (int i = 0; i < 3000; ++i) {
           const double x = random.uniform(), y = random.uniform();
           samples.add(x, y, 1e-4 * random.uniform(), x);
         }
         return samples;
       }(),
       0.5,
       ""},
      {"FarAway", makeBall(1e7), 0.6, ""}};
  return subjects;
}

/** A message and its texts: as the options of a tool and as properties of VTK name
 * parameters. */
std::vector<Message>
toMessages(const json& warnings)
{
  std::vector<Message> messages;
  for (const json& warning : warnings) {
    Message message(warning.at("code").get<std::string>(), {});
    for (const auto& [name, value] : warning.at("values").items())
      if (value.is_number())
        message.values.emplace_back(name, value.get<double>());
      else
        message.values.emplace_back(name, value.get<std::string>());
    messages.push_back(message);
  }
  return messages;
}

std::vector<std::string>
sortedTexts(const std::vector<Message>& messages)
{
  std::vector<std::string> texts;
  for (const Message& message : messages)
    texts.push_back(message.text(ParameterNames::Properties));
  std::sort(texts.begin(), texts.end());
  return texts;
}

std::vector<std::string>
sortedCodes(const std::vector<Message>& messages)
{
  std::vector<std::string> codes;
  for (const Message& message : messages)
    codes.push_back(message.code);
  std::sort(codes.begin(), codes.end());
  return codes;
}

/** Front ends that read the same file. */
class FrontEnds : public testing::Test {
protected:
  /** Write samples into the file. */
  void
  save(const Samples& samples) const
  {
    pcl_uvol::Dataset dataset;
    setCoordinates(dataset, samples.xyz);
    setField(dataset, "f", samples.f);
    pcl_uvol::saveDataset(folder_ / in_, dataset);
  }

  /** What a command that prints a report tells.
   * \param output what it writes, and further options */
  std::vector<Message>
  runTool(const std::string& tool, const std::string& output = "out.vtp") const
  {
    const auto result =
        runCommand("cd " + (folder_ / "") + " && " + tool + " " + in_ + " " + output +
                   " -field '" + field_ + "' -json -iso " + json(isovalue_).dump());
    EXPECT_EQ(0, result.exit_code) << result.err;
    return toMessages(json::parse(result.out).at("warnings"));
  }

  /** What Python tells of a surface or samples.
   * \param call of a function of the module, up to its isovalue
   * \param options behind it */
  std::vector<Message>
  runPython(const std::string& call, const std::string& options = "") const
  {
    writeFile(folder_ / "run.py",
              "import json, sys, warnings\n"
              "import pcl_uvol as uvol\n"
              "warnings.simplefilter('ignore')\n"
              "found = uvol." +
                  call + "(uvol.read('" + in_ + "'), field='" + field_ +
                  "', iso=" + json(isovalue_).dump() + options +
                  ")\n"
                  "print(json.dumps(found.report['warnings']))\n");
    const auto result = runCommand("cd " + (folder_ / "") + " && " +
                                   std::string(PCL_UVOL_PYTHON) + " run.py");
    EXPECT_EQ(0, result.exit_code) << result.err;
    return result.exit_code == 0 ? toMessages(json::parse(result.out))
                                 : std::vector<Message>();
  }

  /** Tool, ranks and Python warn of the same.
   * \param options of the tools
   * \param arguments of Python that say the same
   * \return the codes */
  std::vector<std::string>
  compareFrontEnds(const std::string& options, const std::string& arguments) const
  {
    const auto told = runTool("uvol_isosurface", "out.vtp" + options);
    const auto codes = sortedCodes(told);
    if (hasMpirun()) {
      EXPECT_EQ(
          codes,
          sortedCodes(runTool(mpirun(2) + "uvol_isosurface_mpi", "out.vtp" + options)));
    }
    if (!std::string(PCL_UVOL_PYTHON).empty()) {
      EXPECT_EQ(sortedTexts(told), sortedTexts(runPython("isosurface", arguments)));
    }
    return codes;
  }

  std::string in_ = "in.vtp", field_ = "f";
  double isovalue_ = 0.6;
  TemporaryFolder folder_;
};

class SameWarnings : public FrontEnds, public testing::WithParamInterface<std::size_t> {
protected:
  void
  SetUp() override
  {
    isovalue_ = subject().isovalue;
    save(subject().samples);
  }

  /** Not above all values. */
  static bool
  hasLevelSet()
  {
    return std::string(subject().code) != "no_isopoints";
  }

  static const Subject&
  subject()
  {
    return listSubjects()[GetParam()];
  }

  /** The words of a filter's warnings, without the place that VTK puts in front. */
  template <typename Filter>
  std::vector<std::string>
  runFilter(const std::function<void(Filter&)>& set_isovalue) const
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder_ / "in.vtp").c_str());
    vtkNew<Filter> filter;
    const Listener listener(*filter);
    filter->SetInputConnection(reader->GetOutputPort());
    filter->SetInputArrayToProcess(
        0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "f");
    set_isovalue(*filter);
    filter->Update();
    return listener.warnings;
  }

  /** Each of the texts is among what the filter told, and nothing else is. */
  static void
  expectHeard(const std::vector<Message>& told, const std::vector<std::string>& heard)
  {
    const auto expected = sortedTexts(told);
    ASSERT_EQ(expected.size(), heard.size()) << json(expected) << json(heard);
    for (const std::string& text : expected)
      EXPECT_TRUE(std::any_of(heard.begin(),
                              heard.end(),
                              [&](const std::string& words) {
                                return words.find(text) != std::string::npos;
                              }))
          << text << json(heard);
  }
};

TEST_P(SameWarnings, ToolAndFilter)
{
  const auto told = runTool("uvol_isosurface");
  const auto codes = sortedCodes(told);
  if (const std::string code = subject().code; !code.empty())
    EXPECT_EQ(1, std::count(codes.begin(), codes.end(), code)) << json(codes);
  else
    EXPECT_EQ(std::vector<std::string>(), codes);
  expectHeard(told, runFilter<vtkUvolIsosurface>([](vtkUvolIsosurface& filter) {
                filter.SetValue(0, subject().isovalue);
              }));
}

/** Ranks have other normals where there is no fit, and so other numbers. */
TEST_P(SameWarnings, ToolAndBoundedMemory)
{
  in_ = "in.ply"; // which can be read in parts
  save(subject().samples);
  EXPECT_EQ(sortedCodes(runTool("uvol_isosurface")),
            sortedCodes(runTool("uvol_isosurface", "out.vtp -max-memory 500M")));
}

TEST_P(SameWarnings, ToolAndRanks)
{
  if (!hasMpirun())
    GTEST_SKIP() << "there is no mpirun";
  EXPECT_EQ(sortedCodes(runTool("uvol_isosurface")),
            sortedCodes(runTool(mpirun(2) + "uvol_isosurface_mpi")));
}

TEST_P(SameWarnings, ToolAndPython)
{
  if (std::string(PCL_UVOL_PYTHON).empty())
    GTEST_SKIP() << "Python's module is not built";
  EXPECT_EQ(sortedTexts(runTool("uvol_isosurface")),
            sortedTexts(runPython("isosurface")));
}

TEST_P(SameWarnings, ToolAndViewer)
{
  if (!VirtualDisplay::isInstalled())
    GTEST_SKIP() << "there is no Xvfb";
  if (std::string(subject().code) == "no_isopoints")
    GTEST_SKIP() << "the window has a slider over the values, and refuses others";
  static const VirtualDisplay display; // for all of them
  EXPECT_EQ(sortedTexts(runTool("uvol_isosurface")),
            sortedTexts(runTool("uvol_viewer", "-screenshot out.png -size 100x75")));
}

TEST_P(SameWarnings, OfLevelSets)
{
  if (!hasLevelSet())
    GTEST_SKIP() << "the values do not enclose the isovalue";
  const auto told = runTool("uvol_levelset");
  expectHeard(told, runFilter<vtkUvolLevelSet>([](vtkUvolLevelSet& filter) {
                filter.SetIsovalue(subject().isovalue);
              }));
  if (!std::string(PCL_UVOL_PYTHON).empty()) {
    EXPECT_EQ(sortedTexts(told), sortedTexts(runPython("level_set")));
  }
}

INSTANTIATE_TEST_SUITE_P(Subjects,
                         SameWarnings,
                         testing::Range(std::size_t{0}, listSubjects().size()),
                         [](const auto& index) {
                           return std::string(listSubjects()[index.param].name);
                         });

using SameWarningsOfBox = FrontEnds;

TEST_F(SameWarningsOfBox, PeriodicBox)
{
  save(makeBall());
  compareFrontEnds(" -periodic 2,2,2", ", periodic=(2, 2, 2)");
}

TEST_F(SameWarningsOfBox, BoxOfTheFileThatIsNotUsed)
{
  GadgetLayout layout;
  layout.here[0] = layout.total[0] = 200;
  layout.box = 101.0;
  in_ = "snapshot";
  field_ = "|VEL|";
  isovalue_ = 200.0;
  writeFile(folder_ / in_, makeGadget(layout));
  const auto codes = compareFrontEnds("", "");
  EXPECT_EQ(1, std::count(codes.begin(), codes.end(), "box_in_file")) << json(codes);
  EXPECT_EQ(codes, sortedCodes(runTool("uvol_isosurface", "out.vtp -max-memory 500M")));
  if (VirtualDisplay::isInstalled()) {
    const VirtualDisplay display;
    EXPECT_EQ(codes,
              sortedCodes(runTool("uvol_viewer", "-screenshot out.png -size 100x75")));
  }
}

} // namespace test_same_warnings
