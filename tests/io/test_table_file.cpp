// SPDX-License-Identifier: BSD-3-Clause
// Tables are written whole, or refused in one sentence.
#include "io/table_file.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace test_table_file {

using pcl_uvol::checkTablePath;
using pcl_uvol::IOError;
using pcl_uvol::saveTable;

const std::string text = "node,size\n0,17\n";

TEST(TableFile, HoldsExactlyTheText)
{
  const uvol_test::TemporaryFolder folder;
  for (const std::string& content : {text, std::string(), std::string(1 << 20, 'a')})
    for (const char* name : {"table.csv", "TABLE.CSV"}) {
      saveTable(folder / name, content);
      EXPECT_EQ(content, uvol_test::readFile(folder / name)) << name;
    }
  EXPECT_EQ((std::vector<std::string>{"TABLE.CSV", "table.csv"}), folder.list());
}

TEST(TableFile, OtherNamesAreRefused)
{
  const uvol_test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.csv");
  for (const char* name :
       {"table.txt", "table", "csv", "table.csv.gz", "no/such.csv", "folder.csv", ""}) {
    EXPECT_THROW(checkTablePath(folder / name), IOError) << name;
    EXPECT_THROW(saveTable(folder / name, text), IOError) << name;
  }
  EXPECT_EQ(std::vector<std::string>{"folder.csv"}, folder.list());
}

TEST(TableFile, AMessageNamesTheFile)
{
  const uvol_test::TemporaryFolder folder;
  try {
    checkTablePath(folder / "tree.txt");
    FAIL() << "it was accepted";
  }
  catch (const IOError& error) {
    EXPECT_NE(std::string::npos, error.message().find("tree.txt")) << error.message();
    EXPECT_EQ("unwritten_ending", error.asMessage().code) << error.message();
  }
}

TEST(TableFile, CheckingLeavesNothingBehindAndWhatIsThereAlone)
{
  const uvol_test::TemporaryFolder folder;
  checkTablePath(folder / "new.csv");
  EXPECT_TRUE(folder.list().empty());
  saveTable(folder / "old.csv", text);
  checkTablePath(folder / "old.csv");
  EXPECT_EQ(text, uvol_test::readFile(folder / "old.csv"));
}

} // namespace test_table_file
