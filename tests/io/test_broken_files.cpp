// SPDX-License-Identifier: BSD-3-Clause
// Files whose headers lie, through every reader: a result that is right, or one plain
// sentence; no hang and no memory that the file does not justify.
#include "common/memory.h"
#include "common/printable.h"
#include "random_dataset.h"
#include "support/broken_files.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <chrono>
#include <cstring>
#include <filesystem>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_broken_files {

/** "" if a reader takes the file, else what it says. */
template <typename Reader>
std::string
sentenceOf(const std::string& path, const Reader& read)
{
  const auto start = std::chrono::steady_clock::now();
  testing::internal::CaptureStderr();
  std::string message = messageOf<IOError>(read);
  EXPECT_EQ("", testing::internal::GetCapturedStderr()) << path;
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 20.0) << path;
  if (message.empty())
    return message;
  EXPECT_NE(std::string::npos, message.find(path)) << message;
  EXPECT_TRUE(isPrintable(message)) << message;
  EXPECT_LE(message.size(), 300 + path.size()) << message;
  EXPECT_EQ('.', message.back()) << message;
  for (const char* const word : {"std::", "vector::", "0x"})
    EXPECT_EQ(std::string::npos, message.find(word)) << message;
  return message;
}

std::string
pointsOf(const std::string& path)
{
  return sentenceOf(path, [&] { loadDataset(path); });
}

std::string
cellsOf(const std::string& path)
{
  LoadOptions options;
  options.cells = true;
  return sentenceOf(path, [&] { loadDataset(path, options); });
}

std::string
makeVolume(const std::string& path)
{
  return sentenceOf(path, [&] { loadVolume(path); });
}

const std::string numbers(48, '\1'); // 2 x 3 x 4 of two bytes

std::string
metaImage(const std::string& from = "", const std::string& to = "")
{
  std::string text = "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                     "DimSize = 2 3 4\nElementType = MET_SHORT\n"
                     "ElementDataFile = LOCAL\n" +
                     numbers;
  return from.empty() ? text : text.replace(text.find(from), from.size(), to);
}

std::string
nrrd(const std::string& from = "", const std::string& to = "")
{
  std::string text = "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\n"
                     "endian: little\nencoding: raw\n\n" +
                     numbers;
  return from.empty() ? text : text.replace(text.find(from), from.size(), to);
}

std::string
vti(const std::string& whole, const std::string& piece, const std::string& values)
{
  return "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"" + whole +
         "\"><Piece Extent=\"" + piece +
         "\"><PointData Scalars=\"s\"><DataArray type=\"Float32\" Name=\"s\" "
         "format=\"ascii\">" +
         values + "</DataArray></PointData></Piece></ImageData></VTKFile>";
}

std::string
vtp(const std::string& points, const std::string& attributes)
{
  return "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"" + points +
         "\"><Points><DataArray type=\"Float32\" " + attributes +
         ">0 0 0</DataArray></Points></Piece></PolyData></VTKFile>";
}

struct Broken {
  std::string name, content;
};

void
expectRefused(const std::vector<Broken>& files,
              std::string (*read)(const std::string& path))
{
  for (const auto& [name, content] : files) {
    const TemporaryFolder folder;
    writeFile(folder / name, content);
    EXPECT_NE("", read(folder / name)) << content.substr(0, 300);
  }
}

TEST(BrokenFiles, MetaImages)
{
  const TemporaryFolder folder;
  writeFile(folder / "good.mha", metaImage());
  EXPECT_EQ("", makeVolume(folder / "good.mha"));
  const auto with = [](const std::string& from, const std::string& to) {
    return Broken{"a.mha", metaImage(from, to)};
  };
  expectRefused({with("= 2 3 4", "= -2 -3 4"),
                 with("= 2 3 4", "= 0 3 4"),
                 with("= 2 3 4", "= 4000000000 4000000000 4000000000"),
                 with("= 2 3 4", "= 2 3 400"),
                 with("NDims = 3", "NDims = -3"),
                 with("NDims = 3", "NDims = 5000"),
                 with("LOCAL", "%s%s%s 1 2 1"),
                 with("LOCAL", "%n 1 2 1"),
                 with("LOCAL", "v%d%d.raw 1 2 1"),
                 with("LOCAL", "v%2000000000d.raw 1 2 1"),
                 with("LOCAL", "v%d.raw 1 2000000000 1"),
                 with("LOCAL", "v%d.raw 1 2 0"),
                 with("LOCAL", "v%d.raw 2 1 1"),
                 with("LOCAL", "."),
                 with("LOCAL", "/dev/zero"),
                 with("LOCAL", "/none/" + std::string(400, 'R')),
                 with("MET_SHORT", "MET_STRING"),
                 with("MET_SHORT", "MET_SHORT\nElementNumberOfChannels = 2000000000"),
                 with("MET_SHORT", "MET_SHORT\nCompressedData = True"),
                 with("MET_SHORT", "MET_SHORT\nElementSpacing = 0 0 0"),
                 with("MET_SHORT", "MET_SHORT\nElementSpacing = 1 1"),
                 with("MET_SHORT", "MET_SHORT\nTransformMatrix = 0 1 0 1 0 0 0 0 1"),
                 with("BinaryData = True", "BinaryData = False")},
                makeVolume);
}

TEST(BrokenFiles, Nrrds)
{
  const TemporaryFolder folder;
  writeFile(folder / "good.nrrd", nrrd());
  EXPECT_EQ("", makeVolume(folder / "good.nrrd"));
  std::string comments;
  for (int i = 0; i < 200000; ++i)
    comments += "# a\n";
  writeFile(folder / "comments.nrrd", nrrd("endian", comments + "endian"));
  EXPECT_EQ("", makeVolume(folder / "comments.nrrd"));
  const auto with = [](const std::string& from, const std::string& to) {
    return Broken{"a.nrrd", nrrd(from, to)};
  };
  expectRefused({with("sizes: 2 3 4", "sizes: 1000 1000 1000"),
                 with("sizes: 2 3 4", "sizes: " + std::string(5000, 'A')),
                 with("sizes: 2 3 4", "sizes: -2 3 4"),
                 with("dimension: 3", "dimension: 4"),
                 with("short", "block"),
                 with("endian: little\n", ""),
                 with("raw\n", "raw\ndata file: v%2000000000d.raw 1 4 1\n"),
                 with("raw\n", "raw\ndata file: v%d.raw 1 2000000000 1\n"),
                 with("raw\n", "gzip\n"),
                 with("raw\n", "bzip2\n"),
                 with("raw\n", "ascii\n"),
                 with("raw\n", "raw\nbyte skip: 18446744073709551615\n"),
                 with("raw\n", "raw\nline skip: 18446744073709551615\n"),
                 with("raw\n", "raw\nspace directions: (1,0,0) (0,1 (0,0,1)\n"),
                 with("raw\n", "raw\nspace directions: (0,1,0) (1,0,0) (0,0,1)\n")},
                makeVolume);
}

TEST(BrokenFiles, ImagesOfVtk)
{
  const TemporaryFolder folder;
  writeFile(folder / "good.vti", vti("0 1 0 0 0 0", "0 1 0 0 0 0", "1 2"));
  EXPECT_EQ("", makeVolume(folder / "good.vti"));
  expectRefused(
      {{"a.vti", vti("0 9 0 9 0 9", "0 1 0 0 0 0", "1 2")},
       {"a.vti", vti("5 -5 0 0 0 0", "5 -5 0 0 0 0", "1")},
       {"a.vti", vti("0 1 0 0 0 0", "0 2 0 0 0 0", "1 2 3")},
       {"a.vti", vti("0 1 0 2147483647 0 3", "0 1 0 0 0 0", "1 2")},
       {"a.vti", vti("0 2e9 0 2e9 0 2e9", "0 2e9 0 2e9 0 2e9", "1")},
       {"a.vti", vti("0 1 0 0 0 0", "0 1 0 0 0 0", "1")},
       {"a.vti", vti("0 1 0 0 0 0", "0 1 0 0 0 0", "1 x")},
       {"a.vti",
        "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 0 0 0\"><Piece "
        "Extent=\"0 1 0 0 0 0\"><PointData><DataArray type=\"Float32\" Name=\"s\" "
        "format=\"appended\" offset=\"0\"/></PointData></Piece></ImageData>"
        "<AppendedData encoding=\"raw\">_\4"},
       {"a.vti",
        "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1999 0 1999 0 1999\">"
        "<Piece Extent=\"0 1999 0 1999 0 1999\"/></ImageData></VTKFile>"}},
      makeVolume);
}

TEST(BrokenFiles, PointsOfVtk)
{
  const TemporaryFolder folder;
  writeFile(folder / "good.vtp", vtp("1", "NumberOfComponents=\"3\""));
  EXPECT_EQ("", pointsOf(folder / "good.vtp"));
  // Cells are not looked at.
  writeFile(folder / "cells.vtu",
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece "
            "NumberOfPoints=\"1\" NumberOfCells=\"9223372036854775807\"><Points>"
            "<DataArray type=\"Float32\" NumberOfComponents=\"3\">0 0 0</DataArray>"
            "</Points></Piece></UnstructuredGrid></VTKFile>");
  EXPECT_EQ("", pointsOf(folder / "cells.vtu"));
  std::string deep = "<VTKFile type=\"PolyData\">";
  for (int i = 0; i < 200000; ++i)
    deep += "<a>";
  const std::string three = "NumberOfComponents=\"3\" ";
  expectRefused(
      {{"a.vtp", deep + "</VTKFile>"},
       {"a.vtp", vtp("9223372036854775807", three)},
       {"a.vtp", vtp("18446744073709551436", three)},
       {"a.vtp", vtp("-1", three)},
       {"a.vtp", vtp("1", "NumberOfComponents=\"1000000000\"")},
       {"a.vtp", vtp("1", "NumberOfComponents=\"4294967296\"")},
       {"a.vtp", vtp("1", "NumberOfComponents=\"-1\"")},
       {"a.vtp", vtp("1", three + "format=\"binary\"")},
       {"a.vtp", vtp("1", three + "format=\"appended\" offset=\"5\"")},
       {"a.vtp", vtp("1", three + "Name=\"" + std::string(100000, 'n') + "\"")},
       {"a.vtp", vtp("1", three + "Name=\"&bad;\"")},
       {"a.vtp", vtp("1", three + "Name=unquoted")},
       {"a.vtp", vtp("1", three + "Name=\"a")},
       // Pieces whose coordinates have different types share no array.
       {"a.vtp",
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\"><Points>"
        "<DataArray type=\"Float32\" NumberOfComponents=\"3\">0 0 0</DataArray>"
        "</Points></Piece><Piece NumberOfPoints=\"1\"><Points><DataArray "
        "type=\"Float64\" NumberOfComponents=\"3\">0 0 0</DataArray></Points></Piece>"
        "</PolyData></VTKFile>"}},
      pointsOf);
}

TEST(BrokenFiles, LegacyVtk)
{
  const std::string head = "# vtk DataFile Version 3.0\nof STRUCTURED_POINTS\nASCII\n";
  const std::string points = "DATASET POLYDATA\nPOINTS 1 float\n0 0 0\n";
  const TemporaryFolder folder;
  writeFile(folder / "title.vtk", head + points);
  EXPECT_EQ("", pointsOf(folder / "title.vtk"));
  EXPECT_FALSE(isVolumeFile(folder / "title.vtk"));
  // Only how many numbers a list of cells has matters.
  writeFile(folder / "cells.vtk",
            head + points +
                "POLYGONS 1 4\n99 -7 5 1000000\nPOINT_DATA 1\nSCALARS s "
                "float\nLOOKUP_TABLE default\n5\n");
  EXPECT_EQ("", pointsOf(folder / "cells.vtk"));
  const std::string grid =
      "DATASET RECTILINEAR_GRID\nDIMENSIONS 2 1 1\nX_COORDINATES 2 "
      "float\n0 1\n";
  expectRefused(
      {{"a.vtk", head + "DATASET TREE\nPOINTS 1 float\n0 0 0\nEDGES 100\n0 99999\n"},
       {"a.vtk", head + "DATASET MOLECULE\nVERTICES 1000000\n"},
       {"a.vtk", head + "DATASET DIRECTED_GRAPH\nPOINTS 1 float\n0 0 0\n"},
       {"a.vtk", head + "DATASET POLYDATA\nPOINTS 9223372036854775807 float\n0 0 0\n"},
       {"a.vtk", head + points + "POLYGONS 1 9223372036854775807\n3 0 0 0\n"},
       {"a.vtk", head + points + "POINT_DATA 7\nSCALARS s float\n1 2 3 4 5 6 7\n"},
       {"a.vtk", head + points + "POINT_DATA 1\nSCALARS s float 4000000000\n1\n"},
       {"a.vtk", head + points + "POINT_DATA 1\nFIELD f 4000000000\n"},
       {"a.vtk", head + points + "POINT_DATA 1\nFIELD f 1\na 1 1 string\n"},
       {"a.vtk",
        head + grid +
            "Z_COORDINATES 1 float\n0\nPOINT_DATA 2\nSCALARS s "
            "float\nLOOKUP_TABLE default\n1 2\n"},
       {"a.vtk", head + "DATASET STRUCTURED_POINTS\nDIMENSIONS 2000 2000 2000\n"},
       {"a.vtk",
        head + "DATASET STRUCTURED_POINTS\nDIMENSIONS 2000000000 2000000000 "
               "2000000000\nPOINT_DATA 8\n"}},
      pointsOf);
}

TEST(BrokenFiles, FacesOfMeshes)
{
  const auto mesh = [](const std::string& colors,
                       const std::string& count,
                       const std::string& face) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
           "y\nproperty float z\n" +
           colors + "element face " + count +
           "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 "
           "0\n" +
           face + "\n";
  };
  const TemporaryFolder folder;
  std::string colored =
      mesh("property uchar blue\nproperty uchar green\nproperty uchar "
           "red\n",
           "1",
           "3 0 1 2");
  for (const char* const vertex : {"\n0 0 0\n", "\n1 0 0\n", "\n0 1 0\n"}) {
    const std::string line = vertex;
    colored.replace(
        colored.find(line), line.size(), line.substr(0, line.size() - 1) + " 7 7 7\n");
  }
  writeFile(folder / "bgr.ply", colored);
  EXPECT_EQ(1u, loadMesh(folder / "bgr.ply").triangles.size());
  for (const auto& [count, face] : std::vector<std::pair<std::string, std::string>>{
           {"18446744073709551615", "3 0 1 2"},
           {"1", "3 0 1 4000000000"},
           {"1", "3 0 1 3"},
           {"1", "3 0 1 -1"},
           {"1", "200 0 1 2"},
           {"1", "3 0 1"},
           {"2", "3 0 1 2"},
           {"1", "x 0 1 2"},
           {"0", ""}}) {
    const std::string path = folder / "a.ply";
    writeFile(path, mesh("", count, face));
    EXPECT_NE("", sentenceOf(path, [&] { loadMesh(path); })) << count << ": " << face;
  }
}

TEST(BrokenFiles, ManyNamesAndLongCells)
{
  const TemporaryFolder folder;
  std::string same = "x,y,z", row = "\n1,2,3";
  for (int i = 0; i < 20000; ++i) {
    same += ",f";
    row += ",1";
  }
  writeFile(folder / "same.csv", same + row + "\n");
  const auto columns = loadDataset(folder / "same.csv");
  EXPECT_EQ(20003u, columns.cloud.fields.size());
  EXPECT_EQ("f_20000", columns.cloud.fields.back().name);
  EXPECT_EQ(11u, columns.notes.size());
  writeFile(folder / "long.csv",
            "x,y,z,a\n1,2,3," + std::string(1000000, 'A') + "\n1,2,3,4\n1,2,3,4\n");
  EXPECT_NE("", pointsOf(folder / "long.csv"));
  writeFile(folder / "steer.csv",
            "x,y,z,a\n1,2,3,\x1b]0;owned\x07\n1,2,3,4\n1,2,3,4\n");
  EXPECT_NE(std::string::npos,
            pointsOf(folder / "steer.csv").find("'\\x1b]0;owned\\x07'"));
  writeFile(folder / "quotes.csv",
            "x,y,z,\"" + std::string(2000000, '"') + "\"\n1,2,3,4\n");
  const auto quotes = loadDataset(folder / "quotes.csv");
  EXPECT_EQ(std::string(1000000, '"'), quotes.cloud.fields.back().name);
}

std::string
writeCells(const std::string& attributes,
           const std::string& connectivity,
           const std::string& offsets,
           const std::string& types,
           const std::string& values)
{
  const auto array = [](const std::string& name, const std::string& text) {
    return "<DataArray type=\"Int64\" Name=\"" + name + "\" format=\"ascii\">" + text +
           "</DataArray>";
  };
  return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"4\" " +
         attributes +
         "><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
         "format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>" +
         array("connectivity", connectivity) + array("offsets", offsets) +
         array("types", types) + "</Cells><CellData>" + array("s", values) +
         "</CellData></Piece></UnstructuredGrid></VTKFile>";
}

TEST(BrokenFiles, CellsOfVtk)
{
  const std::string one = "NumberOfCells=\"1\"";
  const TemporaryFolder folder;
  writeFile(folder / "good.vtu", writeCells(one, "0 1 2 3", "4", "10", "7"));
  EXPECT_EQ("", cellsOf(folder / "good.vtu"));
  expectRefused(
      {{"a.vtu", writeCells(one, "0 1 2 4", "4", "10", "7")},
       {"a.vtu", writeCells(one, "0 1 2 -1", "4", "10", "7")},
       {"a.vtu", writeCells(one, "0 1 2 99999999", "4", "10", "7")},
       {"a.vtu", writeCells(one, "0 1 2", "3", "12", "7")},
       {"a.vtu", writeCells(one, "0 1 2 3", "400", "10", "7")},
       {"a.vtu", writeCells(one, "0 1 2 3", "4", "250", "7")},
       {"a.vtu", writeCells(one, "0 1 2 3", "4", "10", "")},
       {"a.vtu", writeCells("NumberOfCells=\"3\"", "0 1 2 3", "4", "10", "7")},
       {"a.vtu",
        writeCells(
            "NumberOfCells=\"9223372036854775807\"", "0 1 2 3", "4", "10", "7")}},
      cellsOf);
}

/** libexodus prints, before we say a sentence. */
TEST(BrokenFiles, ExodusEndsInASentenceAlone)
{
  const std::string head("CDF\1\0\0\0\0", 8);
  expectRefused({{"a.ex2", head}, {"a.e", head + std::string(300, '\x7f')}}, pointsOf);
}

/** Data of cells that end early are no values. */
TEST(BrokenFiles, CellsWithShortAppendedData)
{
  const TemporaryFolder folder;
  const auto image = [](std::uint32_t bytes, const std::string& data) {
    std::string length(4, '\0');
    std::memcpy(length.data(), &bytes, 4);
    return "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\" version=\"0.1\">"
           "<ImageData WholeExtent=\"0 2 0 1 0 1\"><Piece Extent=\"0 2 0 1 0 1\">"
           "<CellData><DataArray type=\"Float32\" Name=\"s\" format=\"appended\" "
           "offset=\"0\"/></CellData></Piece></ImageData><AppendedData "
           "encoding=\"raw\">_" +
           length + data + "</AppendedData></VTKFile>";
  };
  writeFile(folder / "good.vti", image(8, std::string(8, '\1')));
  EXPECT_EQ("", cellsOf(folder / "good.vti"));
  expectRefused({{"a.vti", image(4, std::string(4, '\1'))},
                 {"a.vti", image(4, std::string(8, '\1'))},
                 {"a.vti", image(8, std::string(4, '\1'))}},
                cellsOf);
}

/** The corpora of our own readers are read by VTK's here. */
TEST(BrokenFiles, CellsOfEveryFileOfTheCorpora)
{
  const TemporaryFolder folder;
  for (const auto& [corpus, ending] :
       {std::pair<std::string, std::string>{"legacy_vtk", ".vtk"}, {"xml_vtk", ".vtu"}})
    for (const auto& entry : std::filesystem::directory_iterator(
             std::string(PCL_UVOL_SOURCE_DIR) + "/tests/fuzz/corpus/" + corpus)) {
      const std::string path = folder / entry.path().filename().string() + ending;
      writeFile(path, readFile(entry.path().string()));
      cellsOf(path);
    }
}

/** Files that were made large before they were written, and never were: lines of zeros
 * without an end. */
TEST(BrokenFiles, LinesWithoutAnEnd)
{
  const TemporaryFolder folder;
  const std::uint64_t before = peakMemory();
  const std::vector<std::pair<const char*, std::string>> files = {
      {".nrrd", ""},
      {".nrrd", "NRRD0004\n"},
      {".nrrd", "NRRD0004\ntype: int\ndimension: 3\nsizes: 2 3 4\nencoding: txt\n\n"},
      {".nhdr", ""},
      {".mha", ""},
      {".mhd", "ObjectType = Image\nElementDataFile = LIST\n"},
      {".pcd", ""},
      {".pcd", "FIELDS "},
      {".ply", ""},
      {".ply", "ply\nformat ascii 1.0\ncomment "},
      {".vtk", ""},
      {".vtk", "# vtk DataFile Version 3.0\n"},
      {".vtk",
       "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 9 float\n"},
      {".csv", ""},
      {".xyz", "1 2 3\n"},
      {".vti", ""},
      {".vtp", "<VTKFile type=\"PolyData\">"},
      {".pvd", "<VTKFile type=\"Collection\">"},
      {".pvtp", ""},
      {".las", ""},
      {".npy", ""},
      {".bgeo", ""}};
  for (const auto& [ending, start] : files) {
    const std::string path = folder / "a" + ending;
    writeFile(path, start);
    std::filesystem::resize_file(path, 20000000000u); // takes no place on the disk
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_NE("", isVolumeFile(path) ? makeVolume(path) : pointsOf(path)) << path;
    const std::chrono::duration<double> seconds =
        std::chrono::steady_clock::now() - begin;
    EXPECT_LT(seconds.count(), 2.0) << path << start;
  }
  if (!isSanitized()) { // which keeps what is freed
    EXPECT_LT(peakMemory() - before, 200u << 20);
  }
}

/** How much a file holds: of those that gzip packed, before that. */
double
sizeOf(const std::filesystem::path& path)
{
  if (path.extension() != ".gz")
    return static_cast<double>(std::filesystem::file_size(path));
  const std::string packed = readFile(path);
  std::uint32_t size = 0; // which it ends with
  std::memcpy(&size, &packed[packed.size() - sizeof(size)], sizeof(size));
  return size;
}

/** Through the readers, in memory that is not out of proportion to the file. */
void
readAll(const std::filesystem::path& path)
{
  const bool measured = !isSanitized() && resetPeakMemory();
  const auto before = static_cast<double>(residentMemory());
  const bool refused = !pointsOf(path).empty() && !makeVolume(path).empty();
  sentenceOf(path, [&] { loadMesh(path); });
  if (path.extension().string().rfind(".vt", 0) == 0)
    cellsOf(path);
  if (refused && measured) {
    EXPECT_LT(static_cast<double>(peakMemory()) - before, 10.0 * sizeOf(path) + 20e6)
        << path;
  }
}

void
readFolder(const std::string& folder)
{
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file())
      readAll(entry.path());
}

/** The files that fooled readers once. */
TEST(BrokenFiles, EveryOneEverFound)
{
  const TemporaryFolder folder;
  writeBrokenFiles(folder);
  readFolder(folder / "");
}

TEST(BrokenFiles, ThoseBesideTheData)
{
  const std::string folder = dataFolder() + "/../broken";
  if (dataFolder().empty() || !std::filesystem::exists(folder))
    GTEST_SKIP() << "no broken files";
  readFolder(folder);
}

} // namespace test_broken_files
