// SPDX-License-Identifier: BSD-3-Clause
// Every name of a field through every writer and back.
#include "common/printable.h"
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <vtkDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_names {

/** The name of the only field besides the coordinates. */
std::string
nameThrough(const std::string& ending, const std::string& name)
{
  const TemporaryFolder folder;
  const auto dataset = makeDataset({{name, Type::FLOAT32}}, 5, 1);
  const std::string path = folder / ("a" + ending);
  saveDataset(path, dataset);
  const auto loaded = loadDataset(path);
  EXPECT_EQ(4u, loaded.cloud.fields.size()) << ending << printable(name);
  const std::string back = loaded.cloud.fields.back().name;
  for (std::size_t i = 0; i < 5; ++i)
    expectSame(valueOf(loaded, back, i), valueOf(dataset, name, i), printable(name));
  if (ending == ".vtp") { // and VTK reads it, too
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(back, reader->GetOutput()->GetPointData()->GetArrayName(0));
  }
  return back;
}

TEST(Names, PlainOnesStay)
{
  for (const char* const name : {"a&b",
                                 "a<b>c",
                                 "\"quoted\"",
                                 "it's",
                                 "&amp;",
                                 "100%",
                                 "a%20b",
                                 "T_\xc2\xb0"
                                 "C",
                                 "\xe6\xb8\xa9",
                                 "a;b,c",
                                 "#1",
                                 "[m/s]",
                                 "a\\b"})
    for (const char* const ending : {".pcd", ".ply", ".csv", ".vtp"})
      EXPECT_EQ(name, nameThrough(ending, name)) << ending;
}

TEST(Names, BytesThatAFormatCannotHoldAreReplaced)
{
  const std::string control = "a\x1b[31m\tb",
                    latin = "T_\xb0"
                            "C",
                    lines = "a\nb\rc", blanks = "a b";
  for (const char* const ending : {".pcd", ".ply"}) {
    EXPECT_EQ("a_[31m_b", nameThrough(ending, control));
    EXPECT_EQ(latin, nameThrough(ending, latin));
    EXPECT_EQ("a_b_c", nameThrough(ending, lines));
    EXPECT_EQ("a_b", nameThrough(ending, blanks));
    EXPECT_EQ("field", nameThrough(ending, "\x11")) << "_ would be left out";
  }
  EXPECT_EQ("a_[31m_b", nameThrough(".vtp", control));
  EXPECT_EQ("T_\xc2\xb0"
            "C",
            nameThrough(".vtp", latin))
      << "Latin-1";
  EXPECT_EQ("a_b_c", nameThrough(".vtp", lines));
  EXPECT_EQ(blanks, nameThrough(".vtp", blanks));
  EXPECT_EQ(control, nameThrough(".csv", control));
  EXPECT_EQ(latin, nameThrough(".csv", latin));
  EXPECT_EQ("a b c", nameThrough(".csv", lines));
  EXPECT_EQ(blanks, nameThrough(".csv", blanks));
}

TEST(Names, RandomBytesNeverBreakAFile)
{
  Random random(5);
  for (int round = 0; round < 25; ++round) {
    std::string name = "n";
    for (int i = 0; i < 6; ++i)
      name += static_cast<char>(1.0 + 255.0 * random.uniform());
    for (const char* const ending : {".pcd", ".ply", ".csv", ".vtp"})
      EXPECT_NE("", nameThrough(ending, name));
  }
}

/** VTK compares each with all others. */
TEST(Names, OfVtkAreSoManyAtMost)
{
  constexpr int most = 20000;
  std::vector<FieldSpec> specs;
  for (int i = 0; i <= most; ++i)
    specs.push_back({"f" + std::to_string(i), Type::UINT8});
  const TemporaryFolder folder;
  const auto dataset = makeDataset(specs, 3, 1);
  EXPECT_THROW(saveDataset(folder / "a.vtp", dataset), pcl_uvol::IOError);
  EXPECT_THROW(saveMesh(folder / "m.vtp", dataset, {{0, 1, 2}}), pcl_uvol::IOError);
  saveDataset(folder / "a.pcd", dataset);
  EXPECT_EQ(std::vector<std::string>{"a.pcd"}, folder.list());
  std::string arrays;
  for (int i = 0; i <= most; ++i)
    arrays += "<DataArray type=\"UInt8\" Name=\"f" + std::to_string(i) +
              "\" format=\"ascii\">1</DataArray>\n";
  const std::string points = "<Points><DataArray type=\"Float32\" "
                             "NumberOfComponents=\"3\" format=\"ascii\">0 0 0"
                             "</DataArray></Points>";
  for (const std::string& data : {"<PointData>" + arrays + "</PointData>" + points,
                                  points + "<CellData>" + arrays + "</CellData>"}) {
    writeFile(folder / "b.vtp",
              "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">"
              "<PolyData><Piece NumberOfPoints=\"1\">" +
                  data + "</Piece></PolyData></VTKFile>");
    try {
      loadDataset(folder / "b.vtp");
      FAIL();
    }
    catch (const pcl_uvol::IOError& error) {
      EXPECT_EQ(20000.0, numberOf(error.asMessage(), "most")) << error.message();
    }
  }
}

TEST(Names, EscapesForTerminals)
{
  EXPECT_EQ("'a\\x1b[0m'", quoteText("a\x1b[0m"));
  EXPECT_EQ("'\\x9b'", quoteText("\x9b"));
  EXPECT_EQ("'\\xc2\\x9b'", quoteText("\xc2\x9b")) << "a control character of UTF-8";
  EXPECT_EQ("'\\xed\\xa0\\x80'", quoteText("\xed\xa0\x80")) << "half a pair of UTF-16";
  EXPECT_EQ("'\xc3\xa4'", quoteText("\xc3\xa4"));
  EXPECT_EQ("'\xf0\x9f\x98\x80'", quoteText("\xf0\x9f\x98\x80"));
  EXPECT_EQ("'\\xf4\\x90\\x80\\x80'", quoteText("\xf4\x90\x80\x80"));
  EXPECT_EQ("'" + std::string(40, 'a') + "...'", quoteText(std::string(41, 'a')));
  EXPECT_EQ("'" + std::string(40, 'a') + "'", quoteText(std::string(40, 'a')));
}

} // namespace test_names
