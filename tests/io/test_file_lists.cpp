// SPDX-License-Identifier: BSD-3-Clause
// Files that list others, and those that VTK's own readers take.
#include "common/printable.h"
#include "random_dataset.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <filesystem>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_file_lists {

class FileLists : public testing::Test {
protected:
  FileLists()
  {
    std::filesystem::create_directory(folder_ / "parts");
    for (int i = 0; i < 3; ++i) {
      std::vector<FieldSpec> fields{{"f", Type::FLOAT32}, {"id", Type::INT32}};
      if (i == 1)
        fields.push_back({"extra", Type::FLOAT64});
      parts_.push_back(makeDataset(fields, 5 + i, 40 + i));
      saveDataset(part(i), parts_.back());
    }
  }

  std::string
  part(int i) const
  {
    return folder_ / ("parts/" + std::to_string(i) + ".vtp");
  }

  std::string
  save(const std::string& name, const std::string& content) const
  {
    writeFile(folder_ / name, "<VTKFile>" + content + "</VTKFile>\n");
    return folder_ / name;
  }

  TemporaryFolder folder_;
  std::vector<Dataset> parts_;
};

TEST_F(FileLists, JoinTheirFiles)
{
  for (const auto& path : {save("a.vtm",
                                "<vtkMultiBlockDataSet><Block index=\"0\">"
                                "<DataSet index=\"0\" file=\"parts/0.vtp\"/>"
                                "<DataSet index=\"1\" file=\"parts/1.vtp\"/></Block>"
                                "</vtkMultiBlockDataSet>"),
                           save("a.pvtp",
                                "<PPolyData><Piece Source=\"parts/0.vtp\"/>"
                                "<Piece Source=\"parts/1.vtp\"/></PPolyData>")}) {
    const Dataset both = loadDataset(path);
    ASSERT_EQ(11u, both.cloud.width);
    ASSERT_EQ(1u, both.notes.size());
    EXPECT_EQ(Message("field_of_some_parts", {{"field", "extra"}}), both.notes[0]);
    for (std::size_t i = 0; i < 11; ++i) {
      const Dataset& from = parts_[i < 5 ? 0 : 1];
      const std::size_t row = i < 5 ? i : i - 5;
      for (const char* const name : {"f", "id"}) {
        const double a = ScalarField(both.cloud.fields, name)
                             .read(&both.cloud.data[i * both.cloud.point_step]),
                     b = ScalarField(from.cloud.fields, name)
                             .read(&from.cloud.data[row * from.cloud.point_step]);
        EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << name << ' ' << i;
      }
    }
  }
}

TEST_F(FileLists, OfSeveralTimesTheFirstIsRead)
{
  save("inner.vtm", "<Block><DataSet file=\"parts/2.vtp\"/></Block>");
  const Dataset first = loadDataset(
      save("a.pvd",
           "<Collection><DataSet timestep=\"0.5\" file=\"inner.vtm\"/>"
           "<DataSet timestep=\"0.5\" part=\"1\" file=\"parts/0.vtp\"/>"
           "<DataSet timestep=\"1.5\" file=\"parts/1.vtp\"/></Collection>"));
  EXPECT_EQ(12u, first.cloud.width);
  ASSERT_FALSE(first.notes.empty());
  EXPECT_EQ("first_listed_time", first.notes[0].code);
  EXPECT_EQ("0.5", wordOf(first.notes[0], "time"));
}

/** Paths are those of the machine that wrote the list, and times have any order. */
TEST_F(FileLists, FindFilesBesideThem)
{
  const auto entry = [](const std::string& time, const std::string& name) {
    return "<DataSet timestep=\"" + time + "\" file=\"" + name + "\"/>";
  };
  std::filesystem::copy_file(part(0), folder_ / "0.vtp");
  std::filesystem::copy_file(part(1), folder_ / "1.vtp");
  const std::string path = save("a.pvd",
                                "<Collection>" + entry("10", "/scratch/run/1.vtp") +
                                    entry("2", "C:\\run\\0.vtp") + "</Collection>");
  EXPECT_EQ(parts_[0].cloud.width, loadDataset(path).cloud.width);
}

TEST_F(FileLists, ReadAFileOnce)
{
  std::string content = "<DataSet file=\"parts/1.vtp\"/>";
  for (int i = 0; i < 10000; ++i)
    content += "<DataSet file=\"parts/../parts/0.vtp\"/>";
  const Dataset once = loadDataset(save("many.pvd", content));
  EXPECT_EQ(11u, once.cloud.width);
  EXPECT_NE(once.notes.end(),
            std::find(once.notes.begin(),
                      once.notes.end(),
                      Message("repeated_files",
                              {{"list", shortenText(folder_ / "many.pvd")},
                               {"times", 9999}})));
}

TEST_F(FileLists, SayWhatIsWrong)
{
  for (const auto& [name, content, code] :
       {std::tuple("a.pvd", "<Collection></Collection>", "nothing_inside"),
        std::tuple("b.vtm", "<DataSet file=\"b.vtm\"/>", "endless_lists"),
        std::tuple("c.pvtu", "<Piece Source=\"none.vtu\"/>", "no_such_file"),
        std::tuple(
            "d.vtm", "<Block><DataSet file=\"parts/0.vtp\"/>", "unexpected_word")})
    EXPECT_EQ(code, codeOf([&] { loadDataset(save(name, content)); })) << name;
  writeFile(folder_ / "e.ex2", "this is no Exodus");
  const std::string message =
      messageOf<IOError>([&] { loadDataset(folder_ / "e.ex2"); });
  EXPECT_NE(std::string::npos, message.find("e.ex2")) << message;
}

TEST_F(FileLists, ThatNameOneAnotherAgainAndAgainEnd)
{
  std::string named = "parts/0.vtp";
  for (int depth = 0; depth < 7; ++depth) {
    std::string content;
    for (int i = 0; i < 4; ++i)
      content += "<DataSet file=\"" + named + "\"/>";
    named = "list" + std::to_string(depth) + ".vtm";
    save(named, content);
  }
  EXPECT_EQ("too_many_parts", codeOf([&] { loadDataset(folder_ / named); }));
}

TEST_F(FileLists, ExodusHasTheFieldsOfItsNodes)
{
  if (dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const Dataset found = loadDataset(dataFolder() + "/cfd/disk_out_ref.ex2"),
                converted = loadDataset(dataFolder() + "/cfd/disk_out_ref.vtu");
  EXPECT_EQ(converted.cloud.width, found.cloud.width);
  const auto extremes = [](const Dataset& dataset, const char* name) {
    const ScalarField field(dataset.cloud.fields, name);
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < dataset.cloud.width; ++i) {
      const double value =
          field.read(&dataset.cloud.data[i * dataset.cloud.point_step]);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    return std::pair(low, high);
  };
  for (const char* const name : {"x", "y", "z", "Temp", "AsH3"})
    EXPECT_EQ(extremes(converted, name), extremes(found, name)) << name;
}

} // namespace test_file_lists
