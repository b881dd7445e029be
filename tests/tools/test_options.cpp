// SPDX-License-Identifier: BSD-3-Clause
// The command line of the tools: spellings of options, ranges of numbers, headings of
// -h.
#include "common/similar_words.h"
#include "shared/options.h"
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <gmock/gmock.h>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace test_options {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using uvol_tools::Options;
using uvol_tools::parseAutomatic;
using uvol_tools::parseNumbers;
using uvol_tools::UsageError;

struct Line {
  std::string input, output, field;
  std::vector<double> iso;
  double zoom = 1.0;
  Options options{"tool", "in out [options]", "Does something."};

  Line()
  {
    options.file("in", input);
    options.file("out", output);
    options.group("Input");
    options.text("field", "name", field, "a field");
    options.group("Surface");
    options.numbers("iso", "v,...", 0, iso, "isovalues");
    options.group("Fine points", true);
    options.number("zoom", zoom, 0.0, 9.0, "enlarge");
    options.group("Input");
    options.text("other", "name", field, "another field").rare();
  }

  bool
  parse(std::vector<const char*> words)
  {
    words.insert(words.begin(), "tool");
    return options.parse(static_cast<int>(words.size()), words.data());
  }

  std::string
  help(const std::vector<const char*>& words)
  {
    testing::internal::CaptureStdout();
    EXPECT_FALSE(parse(words));
    return testing::internal::GetCapturedStdout();
  }
};

/** Its help does not fit on a screen. */
struct LongLine : Line {
  LongLine()
  {
    options.group("Many");
    for (int i = 0; i < 60; ++i)
      options.text("many" + std::to_string(i), "name", field, "one of many");
  }
};

TEST(Options, TakeTwoDashesAndEqualSigns)
{
  for (const std::vector<const char*>& words :
       {std::vector<const char*>{"a", "b", "-field", "rho", "-iso", "-1,2"},
        {"a", "b", "--field", "rho", "--iso", "-1,2"},
        {"--field=rho", "--iso=-1,2", "a", "b"}}) {
    Line line;
    EXPECT_TRUE(line.parse(words));
    EXPECT_EQ("rho", line.field);
    EXPECT_THAT(line.iso, ElementsAre(-1.0, 2.0));
    EXPECT_EQ("a", line.input);
    EXPECT_EQ("b", line.output);
  }
}

TEST(Options, KeepEqualSignsBehindOneDashAndInValues)
{
  Line line;
  EXPECT_TRUE(line.parse({"a", "b", "-field", "x=1"}));
  EXPECT_EQ("x=1", line.field);
  EXPECT_THROW(Line().parse({"a", "b", "-field=rho"}), UsageError);
}

TEST(Options, NumbersThatMayBeAutomatic)
{
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(std::nullopt, parseAutomatic("mu", "auto", 0.0, 1.0));
  EXPECT_EQ(0.5, parseAutomatic("mu", "0.5", 0.0, 1.0));
  EXPECT_EQ(1e300, parseAutomatic("max-error", "1e300", 0.0, infinity));
  for (const char* const wrong : {"-1", "1.5", "automatic", "", "nan", "0.5,1"})
    EXPECT_THROW(parseAutomatic("mu", wrong, 0.0, 1.0), UsageError) << wrong;
  try {
    parseAutomatic("max-error", "much", 0.0, infinity);
    FAIL();
  }
  catch (const UsageError& error) {
    EXPECT_STREQ("-max-error takes auto or a number from 0, and 'much' is neither.",
                 error.what());
  }
}

TEST(Options, RefuseWhatIsNoOption)
{
  EXPECT_THROW(Line().parse({"a", "b", "--"}), UsageError);
  EXPECT_THROW(Line().parse({"a", "b", "--field"}), UsageError);
  EXPECT_THROW(Line().parse({"a", "b", "--field", "-iso"}), UsageError);
  EXPECT_THROW(Line().parse({"a", "b", "--field=r", "-field", "s"}), UsageError);
}

TEST(Options, MeanTheOptionThatBeginsSo)
{
  try {
    Line().parse({"a", "b", "-Fie", "rho"});
    FAIL();
  }
  catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("-field?"));
  }
}

TEST(Options, HelpCountsRareOptionsAndExplainsThemWhereAsked)
{
  const std::string help = LongLine().help({"-h"});
  EXPECT_THAT(help, Not(HasSubstr("enlarge")));
  EXPECT_THAT(help, Not(HasSubstr("another field")));
  EXPECT_THAT(help, HasSubstr("\nInput (1 more: -h input):\n  -field name "));
  EXPECT_THAT(help, HasSubstr("below a heading; further headings:\n"));
  EXPECT_THAT(help, HasSubstr("   Fine points\n"));
  const std::string all = LongLine().help({"--help", "all"});
  EXPECT_THAT(all, HasSubstr("\nFine points:\n  -zoom number                enlarge"));
  EXPECT_THAT(all, HasSubstr("\nInput:\n  -field name "));
  EXPECT_THAT(all, HasSubstr("\n  -other name                 another field\n"));
  EXPECT_THAT(all, Not(HasSubstr("further headings")));
  EXPECT_EQ("\nFine points:\n  -zoom number                enlarge (default 1)\n",
            LongLine().help({"-h", "fine points"}));
}

TEST(Options, HelpThatFitsOnAScreenExplainsAll)
{
  EXPECT_EQ(Line().help({"-h", "all"}), Line().help({"-h"}));
}

TEST(Options, HelpRefusesHeadingsThatAreNotThereAndListsThose)
{
  for (const std::vector<const char*>& words :
       {std::vector<const char*>{"-h", "foo"}, {"a", "--help=foo"}})
    try {
      Line().parse(words);
      FAIL();
    }
    catch (const UsageError& error) {
      EXPECT_THAT(
          error.what(),
          testing::AllOf(HasSubstr("'foo'"),
                         HasSubstr("'Run', 'Input', 'Surface', 'Fine points'")));
    }
  EXPECT_EQ(Line().help({"-h"}), Line().help({"-h", "-json"}));
}

TEST(Options, AreDeclaredOnce)
{
  Line line;
  EXPECT_THROW(line.options.text("zoom", "name", line.field, ""), std::logic_error);
  EXPECT_THROW(line.options.series("zoom", "", ""), std::logic_error);
  bool is_json = false;
  EXPECT_THROW(line.options.flag("json", is_json, ""), std::logic_error);
}

TEST(Options, NameTheValueThatIsMissing)
{
  try {
    Line().parse({"a", "b", "-iso"});
    FAIL();
  }
  catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("-iso"), HasSubstr("'v,...'")));
  }
}

TEST(Options, HelpHasOneHeadingPerTitleAndRunLast)
{
  const std::string help = Line().help({"-h"});
  const std::size_t input = help.find("\nInput:\n  -field name");
  const std::size_t surface = help.find("\nSurface:\n");
  const std::size_t run = help.find("\nRun:\n  -threads n");
  EXPECT_LT(input, help.find("  -other name"));
  EXPECT_LT(help.find("  -other name"), surface);
  EXPECT_LT(surface, run);
  EXPECT_NE(std::string::npos, run);
}

TEST(Options, HelpStandsBelowAnOptionThatLeavesItNoRoom)
{
  std::string target;
  const std::string fits(45, 'm'), too_long(46, 'm');
  Options options("tool", "[options]", "Does something.");
  options.text("map", fits, target, "one");
  options.text("way", too_long, target, "two");
  const char* const arguments[] = {"tool", "-h"};
  testing::internal::CaptureStdout();
  EXPECT_FALSE(options.parse(2, arguments));
  const std::string help = testing::internal::GetCapturedStdout();
  EXPECT_THAT(help, HasSubstr("  -map " + fits + "  one\n"));
  EXPECT_THAT(help,
              HasSubstr("  -way " + too_long + '\n' + std::string(30, ' ') + "two\n"));
}

TEST(NumberRanges, HaveBothEndsAndTheDigitsOfTheirSteps)
{
  EXPECT_THAT(parseNumbers("iso", "0.1:0.1:0.6", 0),
              ElementsAre(0.1, 0.2, 0.3, 0.4, 0.5, 0.6));
  EXPECT_THAT(parseNumbers("iso", "-0.3:0.1:0.1", 0),
              ElementsAre(-0.3, -0.2, -0.1, 0.0, 0.1));
  EXPECT_THAT(parseNumbers("iso", "3:-1:1", 0), ElementsAre(3.0, 2.0, 1.0));
  EXPECT_THAT(parseNumbers("iso", "0:0.4:1", 0), ElementsAre(0.0, 0.4, 0.8));
  EXPECT_THAT(parseNumbers("iso", "2:1:2", 0), ElementsAre(2.0));
  EXPECT_THAT(parseNumbers("iso", "1e-20:1e-20:3e-20", 0),
              ElementsAre(1e-20, 2e-20, 3e-20));
}

TEST(NumberRanges, HaveEqualRatiosWithLog)
{
  EXPECT_THAT(parseNumbers("iso", "0.01:1:3log", 0), ElementsAre(0.01, 0.1, 1.0));
  EXPECT_THAT(parseNumbers("iso", "-1:-100:3log", 0), ElementsAre(-1.0, -10.0, -100.0));
  EXPECT_THAT(parseNumbers("iso", "0.3:7:2log", 0), ElementsAre(0.3, 7.0));
}

TEST(NumberRanges, StandAmongNumbers)
{
  EXPECT_THAT(parseNumbers("iso", "9,1:1:3,1:10:2log", 0),
              ElementsAre(9.0, 1.0, 2.0, 3.0, 1.0, 10.0));
}

TEST(NumberRanges, RefuseWhatNeverEnds)
{
  for (const char* const text : {"1:2",
                                 "1:2:3:4",
                                 "a:1:2",
                                 "1:a:2",
                                 "1:1:b",
                                 "1:-1:2",
                                 "0:0:1",
                                 "0:0:0",
                                 "1::2",
                                 "0:0.001:1",
                                 "0:1:5log",
                                 "-1:1:5log",
                                 "1:2:1log",
                                 "1:2:log",
                                 "1:2:1001log",
                                 "1:2:3logs",
                                 "1:inf:2",
                                 ":",
                                 "1:2:-3log"})
    EXPECT_THROW(parseNumbers("iso", text, 0), UsageError) << text;
  EXPECT_THROW(parseNumbers("range", "0:1:2", 2), UsageError);
  EXPECT_EQ(1000u, parseNumbers("iso", "1:1:1000", 0).size());
}

TEST(SimilarWords, AreContinuationsFirst)
{
  const std::vector<std::string> words = {"x", "cu_pct_wide", "cu_pct", "Temperature"};
  EXPECT_EQ("cu_pct", pcl_uvol::findSimilar(words, "cu"));
  EXPECT_EQ("cu_pct", pcl_uvol::findSimilar(words, "CU"));
  EXPECT_EQ("Temperature", pcl_uvol::findSimilar(words, "temp"));
  EXPECT_EQ("cu_pct", pcl_uvol::findSimilar(words, "cu_ptc"));
  EXPECT_EQ("", pcl_uvol::findSimilar(words, ""));
  EXPECT_EQ("", pcl_uvol::findSimilar(words, "density"));
}

/** Names, ranges, words and help are those of the list of members. */
TEST(Options, ComeFromMembers)
{
  pcl_uvol::LevelSetParameters parameters;
  struct MemberLine : Line {
    explicit MemberLine(pcl_uvol::LevelSetParameters& target)
    {
      options.members(target, {"mu", "flow"});
      options.members(target, {"k", "band_width"}, "with something: ");
    }
  };
  EXPECT_THROW(Line().options.members(parameters, {"kk"}), std::logic_error);
  EXPECT_THROW(Line().options.members(parameters, {"scale"}), std::logic_error);
  EXPECT_TRUE(
      MemberLine(parameters)
          .parse({"a", "b", "-mu", "0.5", "-flow", "mean", "-k", "7", "-band", "4"}));
  EXPECT_EQ(0.5, parameters.mu);
  EXPECT_EQ(pcl_uvol::CurvatureFlow::Mean, parameters.flow);
  EXPECT_EQ(7u, parameters.k);
  EXPECT_EQ(4.0, parameters.band_width);
  EXPECT_TRUE(MemberLine(parameters).parse({"a", "b", "-mu", "auto"}));
  EXPECT_FALSE(parameters.mu);
  for (const auto& [option, value] : {std::pair("-mu", "1.5"),
                                      std::pair("-k", "2"),
                                      std::pair("-k", "1001"),
                                      std::pair("-flow", "up"),
                                      std::pair("-band", "-1")})
    EXPECT_THROW(MemberLine(parameters).parse({"a", "b", option, value}), UsageError)
        << option;
  const std::string help = MemberLine(parameters).help({"-h", "all"});
  EXPECT_THAT(help, HasSubstr("with something: nearest neighbours"));
  EXPECT_THAT(help, HasSubstr("mean|relative"));
}

} // namespace test_options
