// SPDX-License-Identifier: BSD-3-Clause
// Names of fields with commas, blanks and quotes, as options of tools.
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/tool_test.h"

#include <sstream>

namespace test_field_names {

using namespace uvol_test;

/** Porosities and depths of random samples, under the names of a spreadsheet. */
std::string
makeTable()
{
  Random random(5);
  std::ostringstream text;
  text << "\"X, m\",\"Y, m\",\"Z, m\",\"Porosity, fraction\",Porosity,\"T, K\"\n";
  for (int i = 0; i < 300; ++i) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    text << x << ',' << y << ',' << z << ',' << x + y << ',' << 10.0 * z << ','
         << 300.0 + x << '\n';
  }
  return text.str();
}

class FieldNames : public FolderTest {
protected:
  FieldNames()
  {
    write("in.csv", makeTable());
    write("at.csv", "x,y,z\n0.5,0.5,0.5\n");
  }

  /** The fields that a probe appends. */
  std::string
  probe(const std::string& fields) const
  {
    const auto result =
        runTool("probe in.csv out.csv -points at.csv -field '" + fields + "'");
    EXPECT_EQ(0, result.exit_code) << fields << ": " << result.err;
    const std::string key = "appended fields: ";
    const std::size_t at = result.out.find(key);
    return at == std::string::npos
               ? ""
               : result.out.substr(at + key.size(),
                                   result.out.find('\n', at) - at - key.size());
  }
};

TEST_F(FieldNames, WithCommasAreTakenAsTheyAre)
{
  EXPECT_EQ("Porosity, fraction, Porosity, fraction_error, support",
            probe("Porosity, fraction"));
  EXPECT_EQ("Porosity, fraction, Porosity, fraction_error, T, K, T, K_error, support",
            probe("Porosity, fraction,T, K"));
  EXPECT_EQ("Porosity, Porosity_error, T, K, T, K_error, support",
            probe("Porosity,T, K"));
  succeeded(runTool("isosurface in.csv out.csv -field 'T, K' -iso 300.5"));
  const auto wrong =
      runTool("probe in.csv out.csv -points at.csv -json -field 'Porosity, share'");
  EXPECT_EQ(1, wrong.exit_code);
  EXPECT_TRUE(uvol_test::hasMessage(wrong, "unknown_lone_field")) << wrong.out;
}

TEST_F(FieldNames, LoseTheirQuotes)
{
  EXPECT_EQ("Porosity, fraction, Porosity, fraction_error, support",
            probe("\"Porosity, fraction\""));
  EXPECT_EQ("log10(T, K), log10(T, K)_error, support", probe("log10(\"T, K\")"));
  const auto result = succeeded(
      runTool("isosurface in.csv out.csv -field '\"T, K\"' -iso 300.5 -json"));
  EXPECT_NE(std::string::npos, result.out.find("\"field\": \"T, K\"")) << result.out;
}

TEST_F(FieldNames, OfAttributesMayHaveCommas)
{
  succeeded(
      runTool("project in.csv out.csv -attributes 'Porosity, fraction,Porosity,T, K'"));
}

} // namespace test_field_names
