// SPDX-License-Identifier: BSD-3-Clause
// Fields as expressions: what they give, what wins, and what is said of wrong ones.
#include "common/scalar_field.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_expressions {

Dataset
load(const std::string& text)
{
  const TemporaryFolder folder;
  writeFile(folder / "a.csv", text);
  return loadDataset(folder / "a.csv");
}

/** Two points. */
Dataset
makeDataset()
{
  return load("x,y,z,rho,u,vx,vy,vz,x velocity,rho*u,U:0,U:1,U:2,T (K),Cu%\n"
              "0,0,0,100,3,3,4,12,7,-1,1,2,2,300,0.5\n"
              "1,2,3,0.01,-2,0,0,1,8,-2,0,3,4,310,0.25\n");
}

std::vector<double>
valuesOf(const Dataset& dataset, const std::string& name)
{
  const CloudView cloud = viewOf(dataset.cloud);
  const ScalarField field(cloud.fields, name);
  std::vector<double> values;
  for (std::size_t i = 0; i < cloud.count; ++i)
    values.push_back(field.read(cloud.point(i)));
  return values;
}

std::vector<double>
compute(const std::string& expression, Dataset dataset = makeDataset())
{
  Report report;
  const std::string name = addDerivedField(dataset, expression, {}, report);
  return valuesOf(dataset, name);
}

/** The text is the sentence, the expression and the caret. */
Message
errorOf(const std::string& expression)
{
  try {
    compute(expression);
  }
  catch (const ExpressionError& error) {
    EXPECT_EQ(error.getSentence() + "\n" + error.getMarkedLines(), error.message());
    return error.asMessage();
  }
  catch (const InvalidArgument& error) {
    return error.asMessage();
  }
  return {"", {}};
}

/** Column of the caret. */
std::size_t
caretOf(const Message& error)
{
  const std::string message = error.text();
  const std::size_t line = message.rfind('\n');
  return message.find('^', line) - line - 3; // behind two blanks
}

TEST(Expressions, Values)
{
  using Values = std::vector<double>;
  const double c = static_cast<double>(0.01f);
  const std::pair<const char*, Values> cases[] = {
      {"log10(rho)", {2.0, std::log10(c)}},
      {"rho*u+1", {301.0, c * -2.0 + 1.0}},
      {"sqrt(vx^2+vy^2)", {5.0, 0.0}},
      {"-vx^2", {-9.0, 0.0}},
      {"2^3^u", {std::pow(2.0, 27.0), std::pow(2.0, std::pow(3.0, -2.0))}},
      {"|vx,vy,vz|", {13.0, 1.0}},
      {"|v|", {13.0, 1.0}},
      {"v[2]", {12.0, 1.0}},
      {"|U|", {3.0, 5.0}},
      {"U:0+U[1]*10", {21.0, 30.0}},
      {"|u|", {3.0, 2.0}},
      {"|u-1|*2", {4.0, 6.0}},
      {"|vx-vy|+|u|", {4.0, 2.0}},
      {"||vx,vy|-u|", {2.0, 2.0}},
      {"u>0 && rho>1", {1.0, 0.0}},
      {"u>0||rho<1", {1.0, 1.0}},
      {"!(u>0)", {0.0, 1.0}},
      {"u>0 ? 10 : -10", {10.0, -10.0}},
      {"max(u,vx,2)", {3.0, 2.0}},
      {"atan2(vy,vx)", {std::atan2(4.0, 3.0), 0.0}},
      {"x+10*y+100*z", {0.0, 321.0}},
      {"1.5e1*vz", {180.0, 15.0}},
      {"cos(pi*vz)", {1.0, -1.0}},
      {"floor(vx/2)+ceil(vx/2)", {3.0, 0.0}},
      {"  vx  *  2 ", {6.0, 0.0}}};
  for (const auto& [expression, values] : cases)
    EXPECT_EQ(compute(expression), values) << expression;
}

TEST(Expressions, NamesThatLookLikeExpressions)
{
  using Values = std::vector<double>;
  // A field of the very name wins, alone and as the whole of an argument.
  EXPECT_EQ(compute("rho*u"), (Values{-1.0, -2.0}));
  EXPECT_EQ(compute("abs(rho*u)"), (Values{1.0, 2.0}));
  EXPECT_EQ(compute("rho*u*2"), (Values{600.0, static_cast<double>(0.01f) * -4.0}));
  EXPECT_EQ(compute("\"rho*u\"*2"), (Values{-2.0, -4.0}));
  EXPECT_EQ(compute("x velocity+1"), (Values{8.0, 9.0}));
  EXPECT_EQ(compute("\"x velocity\"*x"), (Values{0.0, 8.0}));
  EXPECT_EQ(compute("T (K)>305"), (Values{0.0, 1.0}));
  EXPECT_EQ(compute("100*Cu%"), (Values{50.0, 25.0}));
}

std::string
nameOf(const std::string& expression)
{
  Dataset dataset = makeDataset();
  Report report;
  return addDerivedField(dataset, expression, {}, report);
}

TEST(Expressions, QuotesStayOutOfNamesUnlessTheyAreNeeded)
{
  EXPECT_EQ("x velocity", nameOf("\"x velocity\""));
  EXPECT_EQ("x velocity", nameOf(" \"x velocity\" "));
  EXPECT_EQ("rho*u", nameOf("\"rho*u\""));
  EXPECT_EQ("v[2]", nameOf("\"v\"[2]"));
  EXPECT_EQ("x velocity*2", nameOf("\"x velocity\"*2"));
  EXPECT_EQ("abs(rho*u)", nameOf("abs(\"rho*u\")"));
  EXPECT_EQ("\"rho*u\"*2", nameOf("\"rho*u\"*2"));
}

TEST(Expressions, TheFieldIsCalledAsItIsWritten)
{
  Dataset dataset = makeDataset();
  Report report;
  EXPECT_EQ(addDerivedField(dataset, "rho", {}, report), "rho");
  EXPECT_EQ(addDerivedField(dataset, "|v|", {}, report), "|v|");
  EXPECT_EQ(dataset.cloud.fields.size(), makeDataset().cloud.fields.size());
  EXPECT_EQ(addDerivedField(dataset, " rho * 2 ", {}, report), "rho * 2");
  const auto& field = dataset.cloud.fields.back();
  EXPECT_EQ(field.name, "rho * 2");
  EXPECT_EQ(field.datatype, pcl::PCLPointField::FLOAT64);
  // and is found again under that name
  EXPECT_EQ(addDerivedField(dataset, "rho * 2", {}, report), "rho * 2");
  EXPECT_EQ(&field, &dataset.cloud.fields.back());
  EXPECT_TRUE(report.warnings.empty());
}

TEST(Expressions, DoublesStayDoubles)
{
  const Dataset dataset = load("x,y,z,t\n0,0,0,1600000000.125\n0,0,1,1600000000.25\n");
  EXPECT_EQ(compute("t-1600000000", dataset), (std::vector<double>{0.125, 0.25}));
  const Dataset far = load("x,y,z\n5000000.125,1,2\n5000001.125,3,4\n");
  EXPECT_EQ(compute("x*1", far), (std::vector<double>{5000000.125, 5000001.125}));
}

TEST(Expressions, UndefinedNumbersAreCounted)
{
  Dataset dataset = load("x,y,z,a,b\n0,0,0,1,0\n0,0,1,2,2\n0,0,2,,0\n0,0,3,-1,1\n");
  Report report;
  addDerivedField(dataset, "a/b", {}, report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(
      report.warnings[0], // the third has no a
      Message("undefined_field", {{"field", "a/b"}, {"undefined", 1}, {"points", 4}}));
  const auto values = valuesOf(dataset, "a/b");
  EXPECT_TRUE(std::isnan(values[0]) && std::isnan(values[2]));
  EXPECT_EQ(values[1], 1.0);
  EXPECT_TRUE(std::isnan(compute("sqrt(a)", dataset)[3]));
  // What is not known is neither greater nor not greater.
  EXPECT_TRUE(std::isnan(compute("a>0", dataset)[2]));
  EXPECT_TRUE(std::isnan(compute("max(a,b)", dataset)[2]));
  EXPECT_TRUE(std::isnan(compute("ln(b)", dataset)[0]));
}

TEST(Expressions, FieldsOfCellsAreNamed)
{
  Dataset dataset = load("x,y,z,a\n0,0,0,1\n");
  dataset.cell_fields = {"b", "c", "d", "e", "f", "g", "h", "i", "EQPS"};
  Report report;
  for (const char* const text : {"EQPS", "2*EQPS"})
    try {
      addDerivedField(dataset, text, {}, report);
      ADD_FAILURE() << text;
    }
    catch (const InvalidArgument& error) {
      EXPECT_EQ("EQPS", wordOf(error.asMessage(), "field"));
      EXPECT_EQ("EQPS, b, c, d, e, f, g, h, ...",
                wordOf(error.asMessage(), "cell_fields"));
    }
}

TEST(Expressions, WrongOnesAreMarked)
{
  const std::tuple<const char*, const char*, std::size_t> cases[] = {
      {"log10(roh)", "unknown_operand", 6},
      {"rho+nothing", "unknown_operand", 4},
      {"lgo10(rho)", "unknown_function", 0},
      {"2*foo(rho)", "unknown_function", 2},
      {"log10(rho", "parenthesis_not_closed", 5},
      {"rho)", "no_parenthesis_open", 3},
      {"rho*", "operand_missing_at_end", 4},
      {"*rho", "operand_missing", 0},
      {"rho u", "operator_missing", 4},
      {"rho+(u-)", "operand_missing", 7},
      {"rho,u", "misplaced_comma", 3},
      {"(rho,u)", "misplaced_comma", 4},
      {"sqrt(rho,u)", "too_many_arguments", 10},
      {"atan2(rho)", "too_few_arguments", 9},
      {"rho?1", "misplaced_condition", 4},
      {"0<rho<1", "chained_comparisons", 5},
      {"rho & u", "single_ampersand", 4},
      {"\"rho", "quotation_not_closed", 0},
      {"2*|rho", "bar_not_closed", 2},
      {"rho[1]*2", "operand_component_too_large", 4},
      {"rho[x]*2", "component_not_in_brackets", 3},
      {"v*2", "several_components", 0},
      {"1+2", "expression_without_field", 0},
      {"grad(1)", "no_field_derived", 0},
      {"2*grad(rho)", "several_components", 2},
      {"1+Q(rho)", "argument_not_vector", 2},
      {"grad(v)", "argument_not_one_number", 0},
      {"rho+1e999", "number_too_large", 4},
      {"rho # 2", "operator_missing", 4},
      {"\xC3\xA4+rho", "unknown_operand", 0},
      {"rho*(\"\xC3\xA4\")", "unknown_operand", 5}};
  for (const auto& [expression, code, column] : cases) {
    const Message error = errorOf(expression);
    EXPECT_EQ(error.code, code) << expression;
    EXPECT_EQ(caretOf(error), column) << expression;
  }
  EXPECT_EQ(wordOf(errorOf("log10(roh)"), "similar"), "rho");
  EXPECT_EQ(wordOf(errorOf("lgo10(rho)"), "similar"), "log10");
  EXPECT_EQ(numberOf(errorOf("v*2"), "components"), 3.0);
  // A lone name needs no caret.
  EXPECT_EQ(errorOf("roh").text().find('\n'), std::string::npos);
  EXPECT_EQ(wordOf(errorOf("roh"), "similar"), "rho");
  EXPECT_NE(errorOf("grad(rho)").text().find("grad(rho)[2]"), std::string::npos);
  EXPECT_EQ(errorOf("rho*\x1b[2J").text().find('\x1b'), std::string::npos);
}

TEST(Expressions, LongAndDeepOnes)
{
  std::string sum = "rho";
  for (int i = 0; i < 900; ++i)
    sum += "+vz";
  EXPECT_EQ(compute(sum)[0], 100.0 + 900.0 * 12.0);
  EXPECT_EQ(numberOf(errorOf(sum + sum + sum), "most"), 4000.0);
  const std::string open(1500, '('), close(1500, ')');
  EXPECT_EQ(compute(open + "rho" + close + "*1")[0], 100.0);
  std::string bars = "u";
  for (int i = 0; i < 40; ++i)
    bars = "|" + bars + ",1|";
  EXPECT_EQ(errorOf(bars).code, "expression_too_deep");
  std::string derived = "rho";
  for (int i = 0; i < 40; ++i)
    derived = "laplacian(" + derived + ")";
  EXPECT_EQ(errorOf(derived).code, "expression_too_deep");
  // The line that is shown stays a line.
  const std::string message = errorOf(sum + "+nothing" + sum).text();
  EXPECT_LT(message.size() - message.find('\n'), 200u) << message;
}

TEST(Expressions, DerivativesCanBeRefused)
{
  Dataset dataset = makeDataset();
  Report report;
  const Message refusal = thrownBy<InvalidArgument>([&] {
    addDerivedField(dataset, "log10(|grad(rho)|)", {0, "on a Sunday"}, report);
  });
  EXPECT_EQ("no_derivatives", refusal.code);
  EXPECT_EQ("on a Sunday", wordOf(refusal, "reason"));
  EXPECT_EQ(addDerivedField(dataset, "u*2", {0, "on a Sunday"}, report), "u*2");
}

std::size_t
kept(const std::string& where)
{
  Dataset dataset = load(
      "x,y,z,n,T\n5000000.125,0,0,1,4.1\n5000001.125,0,3,2,\n5000002.125,4,3,2,5\n");
  Report report;
  const std::size_t removed = selectRows(dataset, where, {}, report);
  EXPECT_EQ(dataset.cloud.width + removed, 3u);
  EXPECT_EQ(dataset.cloud.data.size(),
            std::size_t(dataset.cloud.width) * dataset.cloud.point_step);
  return dataset.cloud.width;
}

TEST(SelectRows, Relations)
{
  for (const auto& [where, count] : std::vector<std::pair<std::string, std::size_t>>{
           {"n=2", 2},           {"n == 1", 1},
           {"n!=1", 2},          {"T=4.1", 1},
           {"4.1=T", 1},         {"T>=4.1", 2},
           {"T>4.1", 1},         {"4.1<T", 1},
           {"T!=4.1", 2},        {"T<100", 2},
           {"T<inf", 2},         {" n = 2 && T > 0 ", 1},
           {"n<=1&&n>=2", 0},    {"n<=1||n>=2", 3},
           {"x=5000001.125", 1}, {"x<5000001.5", 2},
           {"|y,z|=5", 1},       {"|x,z|>5000000", 3},
           {"z>-1e0", 3},        {"(T=4.1)", 1},
           {"-4.1=-T", 0}, // no field alone: the double 4.1 is another number
           {"-4.1<T", 2},        {"n*2>T", 0},
           {"n+4>T", 2},         {"log10(n) > 0.3", 2},
           {"y=z || n=1", 1}})
    EXPECT_EQ(kept(where), count) << where;
}

TEST(SelectRows, MalformedExpressions)
{
  for (const char* const where : {"",
                                  "n",
                                  "n=",
                                  "=2",
                                  "n=two",
                                  "n=2&&",
                                  "&&",
                                  "n=nan",
                                  "n=2&n=3",
                                  "q=1",
                                  "n<<2",
                                  "n!2",
                                  "1<2"})
    EXPECT_THROW(kept(where), InvalidArgument) << where;
}

TEST(Selection, ComparesNames)
{
  const std::string table = "x,y,z,T,hole\n0,0,0,1,A-1\n1,0,0,2,B (old)\n2,0,0,3,\n"
                            "3,0,0,4,\"say \"\"a\"\" && b\"\n4,0,0,5,A-1\n";
  const auto left = [&](const std::string& where) {
    Dataset dataset = load(table);
    Report report;
    selectRows(dataset, where, {}, report);
    return valuesOf(dataset, "x");
  };
  using Places = std::vector<double>;
  EXPECT_EQ((Places{0, 4}), left("hole=\"A-1\""));
  EXPECT_EQ((Places{0, 4}), left("hole == A-1"));
  EXPECT_EQ((Places{1, 2, 3}), left("hole!=A-1"));
  EXPECT_EQ((Places{1}), left("hole=\"B (old)\""));
  EXPECT_EQ((Places{3}), left("hole=\"say \"\"a\"\" && b\""));
  EXPECT_EQ((Places{2}), left("hole=\"\""));
  EXPECT_EQ((Places{4}), left("T>1 && (hole=A-1 || T>4)"));
  EXPECT_EQ((Places{1, 4}), left("hole=\"B (old)\"||hole=A-1&&T>1"));
  for (const char* const wrong : {"hole=A-2",
                                  "hole",
                                  "hole=",
                                  "hole=\"A-1",
                                  "hole<A-1",
                                  "hole+1=2",
                                  "-hole=A-1&&"})
    EXPECT_THROW(left(wrong), ExpressionError) << wrong;
}

} // namespace test_expressions
