// SPDX-License-Identifier: BSD-3-Clause
// Programs whose language writes 0,5 for a half read and write the same files.
#include "common/scalar_field.h"
#include "support/environment.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <locale>

using namespace pcl_uvol;
using uvol_test::readFile;
using uvol_test::writeFile;

namespace test_comma_locale {

constexpr const char* name = "de_DE.UTF-8";

/** The language of C and of streams, German from use() on. */
class CommaLocale : public testing::Test {
protected:
  ~CommaLocale() override
  {
    std::locale::global(std::locale::classic());
    ::unsetenv("LOCPATH");
  }

  /** \return false where the system cannot make it */
  bool
  use() const
  {
    static const uvol_test::TemporaryFolder made;
    const std::string command = "localedef -i de_DE -f UTF-8 '" + (made / name) + '\'';
    static const bool is_made = uvol_test::runCommand(command).exit_code == 0;
    if (!is_made)
      return false;
    ::setenv("LOCPATH", (made / "").c_str(), 1);
    std::locale::global(std::locale(name)); // C's, too
    EXPECT_STREQ(",", std::localeconv()->decimal_point);
    return true;
  }

  std::string
  write(const std::string& file, const Dataset& dataset) const
  {
    SaveOptions options;
    options.ascii = true;
    saveDataset(folder_ / file, dataset, options);
    return readFile(folder_ / file);
  }

  Dataset
  read(const std::string& text) const
  {
    writeFile(folder_ / "in.csv", text);
    return loadDataset(folder_ / "in.csv");
  }

  const uvol_test::TemporaryFolder folder_;
};

const std::string samples = "x,y,z,f,d\n0.25,0,0,0.1,1.5e-400\n1.5,2.25,1234567.5,0.3,"
                            "-2.5e-3\n12345.5,0.75,-1e-3,nan,1000000.125\n";

TEST_F(CommaLocale, FilesAreTheSame)
{
  const std::vector<std::string> files{"a.csv", "a.pcd", "a.ply", "a.vtp", "a.npz"};
  const Dataset expected = read(samples);
  std::vector<std::string> bytes;
  bytes.reserve(files.size());
  for (const std::string& file : files)
    bytes.push_back(write(file, expected));
  if (!use())
    GTEST_SKIP() << "there is no localedef";
  const Dataset dataset = read(samples);
  EXPECT_EQ(expected.cloud.data, dataset.cloud.data);
  EXPECT_EQ(expected.origin, dataset.origin);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(bytes[i], write(files[i], dataset)) << files[i];
    EXPECT_EQ(expected.cloud.width, loadDataset(folder_ / files[i]).cloud.width)
        << files[i];
  }
}

TEST_F(CommaLocale, ExpressionsAreTheSame)
{
  if (!use())
    GTEST_SKIP() << "there is no localedef";
  Dataset dataset = read(samples); // f is float: 0.1 is compared as one
  Report report;
  addDerivedField(dataset, "1.5*f", {}, report);
  const CloudView cloud = viewOf(dataset.cloud);
  EXPECT_FLOAT_EQ(
      0.45F,
      static_cast<float>(ScalarField(cloud.fields, "1.5*f").read(cloud.point(1))));
  EXPECT_EQ(2u, selectRows(dataset, "f = 0.1", {}, report));
}

TEST_F(CommaLocale, ParametersAreTheSame)
{
  IsosurfaceParameters parameters;
  parameters.isovalues = {0.5, 1e-20};
  const std::string expected = parameters.toJson();
  if (!use())
    GTEST_SKIP() << "there is no localedef";
  EXPECT_EQ(expected, parameters.toJson());
  EXPECT_EQ(parameters.isovalues, IsosurfaceParameters::fromJson(expected).isovalues);
}

} // namespace test_comma_locale
