// SPDX-License-Identifier: BSD-3-Clause
// Damaged files of every encoding end in one sentence; files appear whole or not at
// all.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <csignal>
#include <sys/resource.h>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_bad_files {

/** The code of the error of loading such a file: one sentence that names it, nothing
 * printed.
 * \param line that the error names, 0 for any */
std::string
errorOf(const std::string& name, const std::string& content, double line = 0.0)
{
  const TemporaryFolder folder;
  writeFile(folder / name, content);
  testing::internal::CaptureStderr();
  const Message thrown = thrownBy([&] { loadDataset(folder / name); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name;
  if (!thrown.code.empty()) {
    const std::string message = thrown.text();
    EXPECT_NE(message.find(folder / name), std::string::npos) << message;
    EXPECT_EQ(message.back(), '.');
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  if (line > 0.0) {
    EXPECT_EQ(numberOf(thrown, "line"), line);
  }
  return thrown.code;
}

std::string
replaced(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string
saved(const std::string& name, bool ascii)
{
  const TemporaryFolder folder;
  SaveOptions options;
  options.ascii = ascii;
  saveDataset(folder / name,
              makeDataset({{"a", Type::FLOAT32}, {"id", Type::INT32}}, 20, 4),
              options);
  return readFile(folder / name);
}

/** Such a file with the compressed body that pcl::lzfCompress could have made of two
 * points (1, 2, 3) and (4, 5, 6): one literal run. */
std::string
compressedPcd()
{
  const float columns[] = {1, 4, 2, 5, 3, 6};
  const std::uint32_t sizes[] = {25, 24};
  std::string text = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                     "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary_compressed\n";
  text.append(reinterpret_cast<const char*>(sizes), sizeof(sizes));
  text += '\x17'; // 24 bytes follow as they are
  return text.append(reinterpret_cast<const char*>(columns), sizeof(columns));
}

std::string
bigEndianPly(std::uint64_t count)
{
  std::string text = "ply\r\nformat binary_big_endian 1.0\r\nelement thing 2\r\n"
                     "property list uchar short skipped\r\nproperty int i\r\n"
                     "element vertex " +
                     std::to_string(count) +
                     "\r\nproperty double x\r\nproperty list ushort int l\r\nproperty "
                     "short y\r\nproperty uchar z\r\nelement face 1\r\nproperty list "
                     "uchar int i\r\nend_header\r\n";
  text += std::string("\x01\x00\x05\x00\x00\x00\x01", 7);
  text += std::string("\x00\x00\x00\x00\x02", 5);
  text += std::string("\x40\x45\x00\x00\x00\x00\x00\x00", 8); // 42.0
  text += std::string("\x00\x01\x00\x00\x00\x01", 6) + std::string("\xff\xfe\x07", 3);
  return text;
}

const char* const ascii_ply =
    "ply\nformat ascii 1.0\ncomment c\nelement pre 1\nproperty "
    "list uchar int l\nelement vertex 2\nproperty float x\n"
    "property int y\nproperty double z\nproperty list uchar "
    "int l\nelement face 1\nproperty list uchar int i\n"
    "end_header\n3 1 2 3\n1 2 nan 2 7 8\n4 5 6 0\n3 0 1 2\n";

TEST(BadFiles, MissingFolderEmptyUnknown)
{
  const TemporaryFolder folder;
  for (const char* const ending :
       {".pcd", ".ply", ".csv", ".vtk", ".vtp", ".vtu", ".vts"}) {
    EXPECT_EQ(errorOf(std::string("e") + ending, ""), "empty_file");
    const std::string path = folder / ("missing" + std::string(ending));
    EXPECT_EQ(codeOf([&] { loadDataset(path); }), "no_such_file");
  }
  const TemporaryFolder named;
  runCommand("mkdir '" + (named / "d.pcd") + "'");
  EXPECT_EQ(codeOf([&] { loadDataset(named / "d.pcd"); }), "is_directory");
  EXPECT_EQ(errorOf("a.jpg", "x"), "unknown_ending");
  EXPECT_EQ(errorOf("a", "x"), "no_ending");
}

TEST(BadFiles, EveryTruncationIsFound)
{
  for (const auto& [name, ascii] :
       std::vector<std::pair<std::string, bool>>{{"a.pcd", false},
                                                 {"a.ply", false},
                                                 {"a.vtp", false},
                                                 {"a.pcd", true},
                                                 {"a.ply", true}}) {
    const std::string whole = saved(name, ascii);
    ASSERT_EQ(errorOf(name, whole), "");
    // the last number of a text may be shorter and still be one
    const std::size_t spare = ascii ? 12 : 2;
    for (std::size_t size = 1; size + spare <= whole.size(); size += 7)
      EXPECT_NE(errorOf(name, whole.substr(0, size)), "") << name << " of " << size;
  }
  for (std::size_t size = 1; size < compressedPcd().size(); ++size)
    EXPECT_NE(errorOf("c.pcd", compressedPcd().substr(0, size)), "") << size;
  const std::string ply = bigEndianPly(1);
  for (std::size_t size = 1; size < ply.size(); ++size)
    EXPECT_NE(errorOf("b.ply", ply.substr(0, size)), "") << size;
}

TEST(BadFiles, DamagedBytesNeverCrash)
{
  Random random(9);
  for (const auto& [name, whole] : std::vector<std::pair<std::string, std::string>>{
           {"a.pcd", saved("a.pcd", false)},
           {"t.pcd", saved("a.pcd", true)},
           {"c.pcd", compressedPcd()},
           {"a.ply", saved("a.ply", false)},
           {"t.ply", ascii_ply},
           {"b.ply", bigEndianPly(1)},
           {"a.csv", saved("a.csv", true)},
           {"a.vtp", saved("a.vtp", false)}})
    for (int round = 0; round < 100; ++round) {
      std::string damaged = whole;
      for (int i = 0; i < 3; ++i)
        damaged[static_cast<std::size_t>(random.uniform() * double(whole.size()))] =
            static_cast<char>(256.0 * random.uniform());
      errorOf(name, damaged); // any end but a crash or a print
    }
}

TEST(BadFiles, PcdHeaders)
{
  const std::string good = saved("a.pcd", true);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"POINTS 20", "POINTS 21"},
           {"WIDTH 20\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 20",
            "WIDTH 9999999999\nHEIGHT 1\nPOINTS 9999999999"},
           {"WIDTH 20\nHEIGHT 1", "WIDTH 9999999999999999999\nHEIGHT 99999"},
           {"POINTS 20", "POINTS -1"},
           {"POINTS 20", "POINTS many"},
           {"SIZE 4", "SIZE 3"},
           {"TYPE F", "TYPE Q"},
           {"COUNT 1", "COUNT 0"},
           {"COUNT 1 1", "COUNT 1"},
           {"COUNT 1", "COUNT 99999999999"},
           {"FIELDS x", "FIELDS q"},
           {"DATA ascii", "DATA text"},
           {"VERSION", "VERSI"}})
    EXPECT_NE(errorOf("a.pcd", replaced(good, from, to)), "") << to;
  EXPECT_EQ(errorOf("a.pcd", replaced(good, "TYPE F F F F", "TYPE F F F Q")),
            "unsupported_value");
  EXPECT_EQ(errorOf("a.pcd", good + "1 2 3 4 5\n"), "too_many_parts");
  const std::string small =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F I\nWIDTH 2\nDATA ascii\n";
  EXPECT_EQ(errorOf("a.pcd", small + "1 2 3\n+4e0 nan 6.0"), "");
  EXPECT_EQ(errorOf("a.pcd", small + "1 2 3\n4 five 6\n", 7), "unexpected_word");
  EXPECT_EQ(errorOf("a.pcd", small + "1 2 3\n4 5 6.5\n"), "unexpected_word");
  EXPECT_EQ(errorOf("a.pcd", small + "1.0 2.0 3\n4.0 5.0\n", 7), "wrong_count");
  EXPECT_EQ(errorOf("a.pcd", small + "1 2 3\n4 1e99 5\n"), "unexpected_word");
}

TEST(BadFiles, PcdLayouts)
{
  const TemporaryFolder folder;
  writeFile(folder / "c.pcd", compressedPcd());
  const auto compressed = loadDataset(folder / "c.pcd");
  EXPECT_EQ(valueOf(compressed, "x", 1), 4.0);
  EXPECT_EQ(valueOf(compressed, "z", 0), 3.0);
  EXPECT_NE(errorOf("c.pcd", replaced(compressedPcd(), "POINTS 2", "POINTS 3")), "");
  const std::string binary = saved("a.pcd", false);
  EXPECT_EQ(errorOf("a.pcd", binary + "more"), "") << "bytes behind are harmless";
  EXPECT_EQ(errorOf("a.pcd",
                    replaced(replaced(binary, "WIDTH 20", "WIDTH 4000000000"),
                             "POINTS 20",
                             "POINTS 4000000000")),
            "truncated_data");
}

TEST(BadFiles, PlyLayouts)
{
  const TemporaryFolder folder;
  writeFile(folder / "b.ply", bigEndianPly(1));
  const auto big = loadDataset(folder / "b.ply");
  EXPECT_EQ(coordinateOf(big, 0, 0), 42.0);
  EXPECT_EQ(coordinateOf(big, 1, 0), -2.0);
  EXPECT_EQ(coordinateOf(big, 2, 0), 7.0);
  EXPECT_EQ(big.notes.size(), 1u);
  EXPECT_TRUE(big.double_coordinates);
  writeFile(folder / "t.ply", ascii_ply);
  const auto text = loadDataset(folder / "t.ply");
  EXPECT_TRUE(std::isnan(coordinateOf(text, 2, 0)));
  EXPECT_EQ(coordinateOf(text, 1, 1), 5.0);
}

TEST(BadFiles, PlyHeaders)
{
  EXPECT_EQ(errorOf("t.ply", ascii_ply), "");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"vertex 2", "vertex 3000000000000"},
           {"vertex 2", "vertex -2"},
           {"pre 1", "pre 18446744073709551615"},
           {"vertex 2", "vertax 2"},
           {"format ascii", "format text"},
           {"format ascii 1.0\n", ""},
           {"end_header", "end_heads"},
           {"property int y", "property int64 y"},
           {"property int y", "property int"},
           {"property int y", "property list float int y"},
           {"property int y", "property int q"},
           {"element pre 1\n", ""},
           {"1 2 nan 2 7 8", "1 2 nan 3 7 8"},
           {"1 2 nan 2 7 8", "1 2 nan 1 7 8"},
           {"1 2 nan 2 7 8", "1 2 nan -2 7 8"},
           {"1 2 nan", "1 two 3"},
           {"1 2 nan", "1 nan 3"}})
    EXPECT_NE(errorOf("t.ply", replaced(ascii_ply, from, to)), "") << to;
  EXPECT_EQ(errorOf("t.ply", replaced(ascii_ply, "1 2 nan", "1 two 3"), 15),
            "unexpected_word");
  EXPECT_EQ(errorOf("b.ply", bigEndianPly(4000000000)), "truncated_part");
}

TEST(BadFiles, GarbageForVtk)
{
  const std::string legacy = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n"
                             "POINTS 2 float\n0 0 0 1 1 1\nPOINT_DATA 2\nSCALARS s "
                             "float\nLOOKUP_TABLE default\n1 2\n";
  EXPECT_EQ(errorOf("a.vtk", legacy), "");
  for (const std::size_t size : {20u, 40u, 60u, 72u, 76u, 85u, 100u, 110u, 130u})
    EXPECT_NE(errorOf("a.vtk", legacy.substr(0, size)), "") << size;
  EXPECT_NE(errorOf("a.vtk", replaced(legacy, "1 2\n", "a b\n")), "");
  EXPECT_NE(errorOf("a.vtk", replaced(legacy, "0 0 0", "0 a 0")), "");
  EXPECT_NE(errorOf("a.vtk", replaced(legacy, "POINTS 2 ", "POINTS 2000000000 ")), "");
  for (const char* const name : {"a.vtk", "a.vtp", "a.vtu", "a.vts"})
    for (const char* const garbage :
         {"garbage", "<VTKFile>", "<VTKFile type=\"Table\"></VTKFile>"})
      EXPECT_NE(errorOf(name, garbage), "") << name << garbage;
  EXPECT_EQ(errorOf("a.vtu", saved("a.vtp", false)), "") << "what it holds counts";
}

TEST(AtomicWriting, FailureLeavesWhatWasThere)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.pcd";
  writeFile(path, "old");
  EXPECT_THROW(writeAtomically(path,
                               [](const std::string& temporary) {
                                 writeFile(temporary, "half");
                                 throw std::runtime_error("stop");
                               }),
               std::runtime_error);
  EXPECT_EQ(readFile(path), "old");
  EXPECT_EQ(folder.list(), std::vector<std::string>{"a.pcd"});
  writeAtomically(path, [](const std::string& file) { writeFile(file, "new"); });
  EXPECT_EQ(readFile(path), "new");
  EXPECT_EQ(folder.list(), std::vector<std::string>{"a.pcd"});
}

TEST(AtomicWriting, FullDisk)
{
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const char* const name : {"a.pcd", "a.ply", "a.csv", "a.vtp"}) {
    const TemporaryFolder folder;
    const auto dataset = makeDataset({{"a", Type::FLOAT64, 10}}, 2000, 4);
    rlimit small = before;
    small.rlim_cur = 20000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    testing::internal::CaptureStderr();
    const std::string message =
        messageOf<IOError>([&] { saveDataset(folder / name, dataset); });
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_NE(message.find(folder / name), std::string::npos) << message;
    EXPECT_EQ(message.find(".tmp"), std::string::npos) << message;
    EXPECT_TRUE(folder.list().empty());
  }
}

TEST(AtomicWriting, AKilledWriterLeavesNothing)
{
  const TemporaryFolder folder;
  writeFile(folder / "old.csv", "the old one");
  const auto killWhileWriting = [](const std::string& path) {
    writeAtomically(path, [](const std::string& file) {
      writeFile(file, "half of");
      std::raise(SIGKILL);
    });
  };
  EXPECT_EXIT(
      killWhileWriting(folder / "new.csv"), testing::KilledBySignal(SIGKILL), "");
  EXPECT_EXIT(
      killWhileWriting(folder / "old.csv"), testing::KilledBySignal(SIGKILL), "");
  EXPECT_EQ(folder.list(), (std::vector<std::string>{"old.csv"}));
  EXPECT_EQ(readFile(folder / "old.csv"), "the old one");
}

TEST(AtomicWriting, PathsThatCannotBe)
{
  const TemporaryFolder folder;
  writeFile(folder / "file", "x");
  const auto dataset = makeDataset({}, 1, 1);
  for (const auto& [path, code] : std::vector<std::pair<std::string, std::string>>{
           {folder / "file/a.pcd", "not_a_folder"},
           {folder / "none/a.pcd", "no_folder"},
           {folder / "a.obj", "unwritten_ending"},
           {folder / "a", "unwritten_ending"},
           {"/proc/a.pcd", "system_error"}}) {
    const Message checked = thrownBy([&] { checkSavePath(path); });
    const Message message = thrownBy([&] { saveDataset(path, dataset); });
    EXPECT_EQ(message.code, code) << path;
    if (path != "/proc/a.pcd") {
      EXPECT_EQ(checked, message);
    }
  }
  runCommand("mkdir '" + (folder / "d.ply") + "'");
  EXPECT_NE(messageOf<IOError>([&] { checkSavePath(folder / "d.ply"); }), "");
  EXPECT_NO_THROW(checkSavePath("in_this_folder.PLY"));
  EXPECT_EQ(folder.list(), (std::vector<std::string>{"d.ply", "file"}));
}

} // namespace test_bad_files
