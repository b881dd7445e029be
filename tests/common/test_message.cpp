// SPDX-License-Identifier: BSD-3-Clause
// Messages as data become texts: values, parameters as the front end names them, one
// and many.
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/message.h>
#include <pcl_uvol/common/stage.h>

#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace test_message {

using pcl_uvol::InvalidArgument;
using pcl_uvol::IOError;
using pcl_uvol::Message;
using pcl_uvol::ParameterNames;

constexpr ParameterNames all_names[] = {
    ParameterNames::Members, ParameterNames::Options, ParameterNames::Properties};

bool
holds(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/** Each front end reads its own part, and none of the others'. */
void
expectNames(const Message& message,
            const std::string& members,
            const std::string& options,
            const std::string& properties)
{
  const std::string parts[] = {members, options, properties};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string text = message.text(all_names[i]);
    EXPECT_TRUE(holds(text, parts[i])) << text;
    for (const char brace : {'{', '}', '|'})
      EXPECT_EQ(std::string::npos, text.find(brace)) << text;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(i == k, message.text(all_names[k]) == text) << text;
  }
  EXPECT_EQ(message.text(ParameterNames::Members), message.text());
}

Message
fewIsopointsLeft(bool by_error, bool by_support)
{
  return {"few_isopoints_left",
          {{"isopoints", 100},
           {"left", 7},
           {"by_error", by_error},
           {"by_support", by_support}}};
}

TEST(Message, ParametersAreNamedAsByTheFrontEnd)
{
  expectNames(fewIsopointsLeft(true, false),
              " remain after max_error. The",
              " remain after -max-error. The",
              " remain after MaximumError. The");
  expectNames(fewIsopointsLeft(true, true),
              " remain after max_error and drop_bridged. The",
              " remain after -max-error and -drop-bridged. The",
              " remain after MaximumError and DropBridged. The");
  expectNames(fewIsopointsLeft(false, false),
              " remain after drop_bridged. The",
              " remain after -drop-bridged. The",
              " remain after DropBridged. The");
  expectNames(Message("spikes", {{"percent", 3}}),
              "Try: smooth, or -where (tools) to",
              "Try: -smooth, or -where to",
              "Try: Smooth, or -where (tools) to");
}

TEST(Message, ParametersHaveValues)
{
  expectNames(Message("tied_values", {{"isovalue", "5"}, {"percent", 12}}),
              "Try: mu=0.1.",
              "Try: -mu 0.1.",
              "Try: Mu=0.1.");
  expectNames(Message("contradicted_isopoints", {{"removed", 3}, {"isopoints", 900}}),
              "Try: interpolation=fit to keep",
              "Try: -interpolation fit to keep",
              "Try: Interpolation=fit to keep");
  expectNames(Message("nothing_covered", {{"tested", 160}}),
              "Try: extrapolate, more folds, or validate_by=blocks.",
              "Try: -extrapolate, more folds, or -validate-by blocks.",
              "Try: Extrapolate, more folds, or -validate-by blocks (tools).");
}

/** A front end that has no such parameter names the option of the tools. */
TEST(Message, ParametersOfTheToolsOnlyAreNamedSo)
{
  const Message select("conflicting_samples", {{"percent", 8}});
  const Message blocks("unconstrained_measures", {{"percent", 60}});
  const auto expect = [&](const Message& message,
                          const std::string& options,
                          const std::string& others) {
    EXPECT_TRUE(holds(message.text(ParameterNames::Options), options));
    for (const auto names : {ParameterNames::Members, ParameterNames::Properties})
      EXPECT_TRUE(holds(message.text(names), others)) << message.text(names);
  };
  expect(select,
         "Try: -where to select one, for example -where \"experiment=1\".",
         "Try: -where (tools) to select one, for example -where \"experiment=1\" "
         "(tools).");
  expect(blocks, "Try: -block dx,dy,dz for", "Try: -block dx,dy,dz (tools) for");
  EXPECT_TRUE(holds(Message("oriented_to_zero", {}).text(), "Try: view_point to"));
}

/** A name, a number of all digits, and a value of a parameter that holds both. */
TEST(Message, ValuesOfParametersHoldValues)
{
  for (const std::size_t far : {1u, 2u, 1000u}) {
    const Message message("far_positions",
                          {{"far", far},
                           {"positions", 2002},
                           {"longitude", "0.1 E"},
                           {"latitude", "42.5 S"},
                           {"distance", 4760},
                           {"field", "lat"},
                           {"degrees", -42.1}});
    const std::string words =
        std::to_string(far) + " of 2002 positions " + (far == 1 ? "is" : "are") +
        " far away, for example 0.1 E, 42.5 S, 4760 km from the median. "
        "Try: ";
    const std::string condition = "-where \"lat != -42.100000000000001\"";
    const std::string end = " to exclude missing fixes.";
    EXPECT_EQ(words + condition + end, message.text(ParameterNames::Options));
    for (const auto names : {ParameterNames::Members, ParameterNames::Properties})
      EXPECT_EQ(words + condition + " (tools)" + end, message.text(names));
  }
}

TEST(Message, ListWhatMayBeTried)
{
  const std::string weak =
      "40 % of isopoints are between sample lines or next to gaps. Only crossings with "
      "lines are reliable. Try: ";
  for (const bool validate : {false, true})
    for (const bool scale : {false, true})
      for (const bool gaps : {false, true}) {
        SCOPED_TRACE(testing::Message() << validate << scale << gaps);
        const Message message("unconstrained_isopoints",
                              {{"percent", 40},
                               {"validate", validate},
                               {"scale", scale},
                               {"gaps", gaps},
                               {"bridged", !gaps}});
        const auto expected = [&](const std::string& test,
                                  const std::string& factors,
                                  const std::string& filling,
                                  const std::string& dropping) {
          return weak + (validate ? test + ", " : "") + (scale ? factors + ", " : "") +
                 (gaps ? filling : dropping) + ", more samples.";
        };
        EXPECT_EQ(expected("validate", "scale", "fill_gaps", "drop_bridged"),
                  message.text());
        EXPECT_EQ(expected("-validate", "-scale", "-fill-gaps", "-drop-bridged"),
                  message.text(ParameterNames::Options));
        EXPECT_EQ(expected("-validate (tools)", "Scale", "FillGaps", "DropBridged"),
                  message.text(ParameterNames::Properties));
      }
}

TEST(Message, ChoicesHoldChoices)
{
  const auto advise = [](bool scale, bool gaps) {
    const std::string text = Message("worse_than_nearest_on_lines",
                                     {{"surface", 60},
                                      {"samples", 100},
                                      {"nearest", 70},
                                      {"scale", scale},
                                      {"gaps", gaps}})
                                 .text(ParameterNames::Options);
    return text.substr(text.find("Use "));
  };
  const std::string use = "Use only crossings with lines.";
  EXPECT_EQ(use, advise(false, false));
  EXPECT_EQ(use + " Try: -fill-gaps.", advise(false, true));
  EXPECT_EQ(use + " Try: -scale.", advise(true, false));
  EXPECT_EQ(use + " Try: -scale or -fill-gaps.", advise(true, true));
}

TEST(Message, OneIsNotMany)
{
  const auto beyond = [](int points) {
    return Message("points_beyond_float", {{"points", points}}).text();
  };
  EXPECT_EQ(
      "1 point has a coordinate of 3.4e38 or more, too large for float. It counts as "
      "missing.",
      beyond(1));
  for (const int points : {0, 2, 11})
    EXPECT_EQ(std::to_string(points) +
                  " points have a coordinate of 3.4e38 or more, too large for float. "
                  "They count as missing.",
              beyond(points));
  const auto left_out = [](int isopoints) {
    return Message(
               "no_isopoints_left",
               {{"isopoints", isopoints}, {"by_error", true}, {"by_support", false}})
        .text();
  };
  EXPECT_EQ(0u, left_out(1).find("max_error removed the last isopoint. "));
  EXPECT_EQ(0u, left_out(9).find("max_error removed the last 9 isopoints. "));
  const auto far_points = [](std::uint64_t count) {
    return Message("far_points",
                   {{"far_points", count},
                    {"first", 7},
                    {"x", -1e20f},
                    {"y", 0.1234567},
                    {"z", 1000000}})
        .text();
  };
  EXPECT_EQ(
      "1 outlier is ignored, 1e12 times farther out than most points. It is point 7 "
      "at (-1e+20, 0.123457, 1e+06).",
      far_points(1));
  EXPECT_EQ(
      "3 outliers are ignored, 1e12 times farther out than most points. The first is "
      "point 7 at (-1e+20, 0.123457, 1e+06).",
      far_points(3));
}

TEST(Message, OneOfTwoMayBeEmpty)
{
  const auto evolved = [](int steps, bool is_last_stage) {
    return Message("not_converged",
                   {{"isovalue", "0.5"},
                    {"steps", steps},
                    {"change", 0.0123456},
                    {"is_last_stage", is_last_stage},
                    {"mu", 0.256},
                    {"chosen_mu", 10}})
        .text();
  };
  const std::string begin = "The level set at 0.5 has not converged by step ",
                    end = ": it moves 0.012 spacings per unit time.";
  EXPECT_EQ(begin + "1" + end, evolved(1, true));
  EXPECT_EQ(begin + "200" + end + " Mu ended at 0.26, not 10.", evolved(200, false));
}

TEST(Message, WholeNumbersHaveAllDigitsAndOthersSix)
{
  const auto textOf = [](double number) {
    const std::string text =
        Message("file_attributes", {{"attributes", number}}).text();
    return text.substr(0, text.find(' '));
  };
  EXPECT_EQ("0", textOf(0.0));
  EXPECT_EQ("0", textOf(-0.0));
  EXPECT_EQ("12345678", textOf(12345678.0));
  EXPECT_EQ("-1234567890123", textOf(-1234567890123.0));
  EXPECT_EQ("9007199254740992", textOf(0x1p53)); // all doubles beyond are whole
  EXPECT_EQ("1.80144e+16", textOf(0x1p54));
  EXPECT_EQ("0.333333", textOf(1.0 / 3.0));
  EXPECT_EQ("1.23457e+06", textOf(1234567.5));
  EXPECT_EQ("inf", textOf(std::numeric_limits<double>::infinity()));
  EXPECT_EQ("nan", textOf(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Message, NumbersHaveTheDigitsThatTheTextAsksFor)
{
  const auto rounded = [](double rounding, double spacings, double spacing) {
    return Message(
               "rounded_far_points",
               {{"rounding", rounding}, {"spacings", spacings}, {"spacing", spacing}})
        .text();
  };
  EXPECT_EQ("Float rounding moves single distant points by up to 0.031, 12 times the "
            "distance between neighbours (about 0.0026).",
            rounded(0.03125, 12.4, 0.00255));
  EXPECT_EQ(
      "Float rounding moves single distant points by up to 5.1e+02, 1.2e+02 times the "
      "distance between neighbours (about 4).",
      rounded(512.0, 124.0, 4.0)); // whole ones as well
  const std::string gaps =
      Message("worse_in_gaps", {{"predicted", 2.0 / 3.0}, {"measured", 0.25}}).text();
  EXPECT_TRUE(holds(gaps, "median error is 0.667 between")) << gaps;
  EXPECT_TRUE(
      holds(gaps, "but 0.25 between measured samples across gaps. Try: no fill_gaps."))
      << gaps;
}

/** Words are those of files: what they hold stays as it is. */
TEST(Message, WordsAreNotFilled)
{
  for (const auto names : all_names) {
    EXPECT_EQ(
        "The field '{-where} {field|a|b}' of the samples is not copied, because "
        "isopoints have a field of that name.",
        Message("replaced_field", {{"field", "{-where} {field|a|b}"}}).text(names));
    EXPECT_EQ(
        "Leave out {-max-memory}: {it} | {is full.",
        Message(std::string("Leave out {-max-memory}: {it} | {is full.")).text(names));
  }
}

TEST(Message, BeginsWithWhatItIsAbout)
{
  Message message("ready_splats", {});
  const std::string text = message.text();
  EXPECT_EQ(0u, text.find("The points are splats"));
  message.about = "my s.csv";
  for (const auto names : all_names)
    EXPECT_EQ("my s.csv: " + text, message.text(names));
  std::ostringstream out;
  out << message;
  EXPECT_EQ("my s.csv: " + text, out.str());
}

TEST(Message, StreamsNameMembers)
{
  std::ostringstream out;
  out << Message("few_isopoints_left",
                 {{"isopoints", 2}, {"left", 1}, {"by_error", 1}, {"by_support", 0}});
  EXPECT_TRUE(holds(out.str(), " max_error.")) << out.str();
}

TEST(Message, TextsAreMessages)
{
  const Message message(std::string("A sentence."));
  EXPECT_EQ("text", message.code);
  EXPECT_EQ("A sentence.", uvol_test::wordOf(message, "text"));
  EXPECT_EQ(1u, message.values.size());
  EXPECT_EQ("", message.about);
  EXPECT_EQ("A sentence.", message.text());
  EXPECT_EQ(Message("text", {{"text", "A sentence."}}), message);
}

/** The sentence that is thrown. */
std::string
refusalOf(const Message& message)
{
  try {
    return "not refused: " + message.text();
  }
  catch (const InvalidArgument& error) {
    return error.what();
  }
}

TEST(Message, UnknownCodesAreRefused)
{
  for (const char* const code :
       {"no_such_code", "", "FAR_POINTS", "far_point", "far_pointss"}) {
    EXPECT_EQ("There is no message with the code '" + std::string(code) + "'.",
              refusalOf(Message(code, {{"far_points", 1}})));
    EXPECT_THROW(IOError(code, {}), InvalidArgument);
  }
}

TEST(Message, MissingValuesAreRefused)
{
  // In a text, of a number of digits, of a choice, and within one.
  EXPECT_EQ("The message 'invalid_queries' has no value 'queries'.",
            refusalOf(Message("invalid_queries", {{"invalid", 1}})));
  EXPECT_EQ("The message 'spikes' has no value 'percent'.",
            refusalOf(Message("spikes", {{"Percent", 1}})));
  EXPECT_EQ("The message 'queries_outside' has no value 'has_values'.",
            refusalOf(Message("queries_outside", {{"outside", 1}, {"queries", 2}})));
  EXPECT_EQ("The message 'few_isopoints_left' has no value 'by_support'.",
            refusalOf(Message("few_isopoints_left",
                              {{"isopoints", 2}, {"left", 1}, {"by_error", 1}})));
  EXPECT_EQ("The message 'text' has no value 'text'.", refusalOf(Message("text", {})));
  // More than the text holds do no harm.
  EXPECT_EQ("z is 0.", Message("vertical_axis", {{"z", "0"}, {"unit", "m"}}).text());
}

TEST(Message, EqualOnesHaveEqualCodesAndValues)
{
  const Message message("unfitting_array",
                        {{"array", "a"}, {"tuples", 2}, {"points", 3}});
  EXPECT_TRUE(message == Message(message));
  EXPECT_TRUE(message == Message("unfitting_array",
                                 {{"array", std::string("a")},
                                  {"tuples", std::uint8_t{2}},
                                  {"points", 3.0f}}));
  Message about = message;
  about.about = "b";
  const Message others[] = {
      about,
      Message("unfitting_arrays", message.values),
      Message("unfitting_array", {}),
      Message("unfitting_array", {{"array", "a"}, {"tuples", 2}}),
      Message("unfitting_array",
              {{"array", "a"}, {"tuples", 2}, {"points", 3}, {"more", 4}}),
      Message("unfitting_array", {{"array", "b"}, {"tuples", 2}, {"points", 3}}),
      Message("unfitting_array", {{"array", "a"}, {"tuples", 2}, {"points", 3.5}}),
      Message("unfitting_array", {{"array", "a"}, {"tuples", 2}, {"points", "3"}}),
      Message("unfitting_array", {{"array", "a"}, {"tuples", 2}, {"point", 3}}),
      Message("unfitting_array", {{"tuples", 2}, {"array", "a"}, {"points", 3}}),
  };
  for (const Message& other : others) {
    EXPECT_FALSE(message == other);
    EXPECT_FALSE(other == message);
  }
}

TEST(Message, ReportsKeepThem)
{
  pcl_uvol::Report report, other;
  report.warn("few_samples_for_choice");
  other.warn("far_points", {{"far_points", 2}});
  report.merge(other);
  EXPECT_EQ((std::vector<std::string>{"few_samples_for_choice", "far_points"}),
            uvol_test::listCodes(report.warnings));
  EXPECT_TRUE(report.warnings[0].values.empty());
  EXPECT_EQ(2.0, uvol_test::numberOf(report.warnings[1], "far_points"));
}

TEST(Message, ReportsTakeEachOfAnotherOnce)
{
  pcl_uvol::Report report, other;
  for (pcl_uvol::Report* const one : {&report, &other, &other})
    one->warn("far_points", {{"far_points", 2}});
  other.warn("far_points", {{"far_points", 3}});
  report.merge(other);
  report.warn({Message("far_points", {{"far_points", 3}})});
  EXPECT_EQ(3u, other.warnings.size());
  EXPECT_EQ(2u, report.warnings.size());
}

TEST(MessageOfAnException, IsItsText)
{
  const InvalidArgument error("derivatives_of_blocks", {{"field", "grad(f)"}});
  const std::string begin = "The derivatives in 'grad(f)' are not available for points "
                            "that are read block by block. Try: no ";
  EXPECT_EQ(begin + "-max-memory (tools).", error.what());
  EXPECT_EQ(begin + "-max-memory (tools).", error.message());
  EXPECT_EQ(Message("derivatives_of_blocks", {{"field", "grad(f)"}}),
            error.asMessage());
  EXPECT_EQ(begin + "-max-memory.", error.asMessage().text(ParameterNames::Options));
  EXPECT_EQ(begin + "-max-memory (tools).",
            error.asMessage().text(ParameterNames::Properties));
}

TEST(MessageOfAnException, ComesThroughCopiesAndBases)
{
  Message message("unknown_snapshot", {{"path", "a.h5"}});
  message.about = "Cannot read 'a.h5'";
  try {
    throw IOError(message);
  }
  catch (const pcl_uvol::Exception& error) {
    EXPECT_EQ(message, error.asMessage());
    EXPECT_EQ(
        "Cannot read 'a.h5': particles requires a snapshot, and the file is not a "
        "known snapshot.",
        std::string(error.what()));
    const pcl_uvol::Exception copy = error;
    EXPECT_EQ(message, copy.asMessage());
    EXPECT_EQ(error.message(), copy.message());
  }
  try {
    throw IOError(message);
  }
  catch (const std::exception& error) {
    EXPECT_EQ(message.text(), error.what());
  }
}

TEST(MessageOfAnException, MayBeAText)
{
  const pcl_uvol::Diverged error("It grows by {-tau 0.5}.");
  EXPECT_EQ("It grows by {-tau 0.5}.", std::string(error.what()));
  EXPECT_EQ("text", error.asMessage().code);
  for (const auto names : all_names)
    EXPECT_EQ("It grows by {-tau 0.5}.", error.asMessage().text(names));
}

} // namespace test_message
