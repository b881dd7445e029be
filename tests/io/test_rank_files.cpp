// SPDX-License-Identifier: BSD-3-Clause
// What processes read of files is all of it, and what they write is there or not.
#include "io/rank_files.h"
#include "random_dataset.h"
#include "support/snapshots.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPPolyDataReader.h>

#include <filesystem>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_rank_files {

/** What all ranks read. */
struct Parts {
  std::vector<Dataset> parts;

  Parts(const std::vector<std::string>& paths, std::size_t ranks)
      : parts(ranks)
  {
    runRanks(ranks, [&](Communicator& communicator) {
      parts[communicator.rank()] = loadPart(findPieces(paths), {}, communicator);
    });
  }

  std::vector<std::uint8_t>
  join() const
  {
    std::vector<std::uint8_t> data;
    for (const Dataset& part : parts)
      data.insert(data.end(), part.cloud.data.begin(), part.cloud.data.end());
    return data;
  }
};

/** Points in a row from a place on, with a value. */
Dataset
line(std::size_t count, double x, double value = 0.0, bool in_double = false)
{
  Dataset dataset;
  std::vector<double> xyz;
  for (std::size_t i = 0; i < count; ++i)
    xyz.insert(xyz.end(), {x + static_cast<double>(i), 0.5, 0.25});
  setCoordinates(dataset, xyz);
  dataset.double_coordinates = in_double;
  setField(dataset, "value", std::vector<float>(count, static_cast<float>(value)));
  return dataset;
}

/** The error of some rank, without a code for files that are read. */
Message
refusalOf(const std::vector<std::string>& paths, std::size_t ranks = 1)
{
  return thrownBy<Exception>([&] { Parts(paths, ranks); });
}

TEST(RankFiles, PartOneFileByItsPoints)
{
  const TemporaryFolder folder;
  const Dataset dataset =
      makeDataset({{"label", Type::INT32}, {"speed", Type::FLOAT64}}, 23, 3);
  for (const std::string name : {"a.pcd", "a.ply", "a.csv"}) {
    const std::string path = folder / name;
    saveDataset(path, dataset);
    const Dataset whole = loadDataset(path);
    for (const std::size_t ranks : {1, 2, 3, 8, 30}) {
      const Parts parts({path}, ranks);
      EXPECT_EQ(whole.cloud.data, parts.join()) << name << ' ' << ranks;
      for (const Dataset& part : parts.parts) {
        EXPECT_LE(part.cloud.width, 23 / ranks + 1);
        EXPECT_EQ(whole.cloud.point_step, part.cloud.point_step);
      }
    }
  }
}

TEST(RankFiles, DealPiecesOut)
{
  const TemporaryFolder folder;
  std::vector<std::uint8_t> all;
  for (int i = 0; i < 5; ++i) {
    const Dataset piece = line(4, 10 * i, i);
    saveDataset(folder / ("in_" + std::to_string(i) + ".vtp"), piece);
    all.insert(all.end(), piece.cloud.data.begin(), piece.cloud.data.end());
  }
  for (const std::size_t ranks : {1, 2, 3, 5, 9}) {
    const Parts parts({folder / "in_*.vtp"}, ranks);
    EXPECT_EQ(all, parts.join());
    for (const Dataset& part : parts.parts) {
      EXPECT_LE(part.cloud.width, 4 * ((5 + ranks - 1) / ranks));
      EXPECT_EQ(parts.parts[0].cloud.fields.size(), part.cloud.fields.size());
    }
  }
}

TEST(RankFiles, ReportTheBoxThatAllPiecesName)
{
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, double box) {
    GadgetLayout layout;
    layout.here[0] = layout.total[0] = 20;
    layout.box = box;
    writeFile(folder / name, makeGadget(layout));
    return folder / name;
  };
  const auto expectBox = [](double side, const std::vector<std::string>& paths) {
    for (const std::size_t ranks : {1, 2, 3})
      for (const Dataset& part : Parts(paths, ranks).parts)
        EXPECT_EQ((std::array<double, 3>{side, side, side}), part.box);
  };
  const std::string first = write("a", 5.0), second = write("b", 5.0),
                    other = write("c", 6.0);
  expectBox(5.0, {first});
  expectBox(5.0, {first, second});
  expectBox(0.0, {first, second, other});
}

/** A dataset in pieces is what it was, for VTK as well. */
TEST(RankFiles, WritePiecesThatAreReadBack)
{
  const TemporaryFolder folder;
  const std::string path = folder / "out.pvtp";
  std::vector<Dataset> written;
  for (std::size_t rank = 0; rank < 3; ++rank)
    written.push_back(makeDataset({{"speed (m/s)", Type::FLOAT32},
                                   {"normal_x", Type::FLOAT32},
                                   {"normal_y", Type::FLOAT32},
                                   {"normal_z", Type::FLOAT32},
                                   {"label", Type::UINT16},
                                   {"big", Type::INT64, 3}},
                                  5 * rank,
                                  rank));
  runRanks(
      3, [&](Communicator& ranks) { savePieces(path, written[ranks.rank()], ranks); });
  EXPECT_EQ(
      (std::vector<std::string>{"out.pvtp", "out_0.vtp", "out_1.vtp", "out_2.vtp"}),
      folder.list());
  const Parts parts({path}, 3);
  const vtkNew<vtkXMLPPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  EXPECT_EQ(15, reader->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(15, reader->GetOutput()->GetVerts()->GetNumberOfCells());
  auto* const arrays = reader->GetOutput()->GetPointData();
  EXPECT_NE(nullptr, arrays->GetNormals());
  for (const char* const name : {"speed (m/s)", "label", "big"})
    ASSERT_NE(nullptr, arrays->GetArray(name)) << name;
  EXPECT_EQ(3, arrays->GetArray("big")->GetNumberOfComponents());
  std::size_t points = 0;
  for (std::size_t rank = 0; rank < 3; ++rank) {
    saveDataset(folder / "expected.vtp", written[rank]);
    EXPECT_EQ(loadDataset(folder / "expected.vtp").cloud.data,
              parts.parts[rank].cloud.data);
    points += parts.parts[rank].cloud.width;
  }
  EXPECT_EQ(15u, points);
}

TEST(RankFiles, MoveDoubleCoordinatesToOneOrigin)
{
  const TemporaryFolder folder;
  saveDataset(folder / "in_0.vtp", line(3, 4000000.125, 1.0, true));
  saveDataset(folder / "in_1.vtp", line(0, 0.0));
  saveDataset(folder / "in_2.vtp", line(3, 4000900.125, 2.0, true));
  const Parts parts({folder / "in_*.vtp"}, 4);
  const auto& origin = parts.parts[0].origin;
  EXPECT_NE(0.0, origin[0]);
  std::vector<double> x;
  for (const Dataset& part : parts.parts) {
    EXPECT_EQ(origin, part.origin);
    EXPECT_TRUE(part.double_coordinates);
    for (std::size_t i = 0; i < part.cloud.width; ++i) {
      float relative;
      std::memcpy(&relative, &part.cloud.data[i * part.cloud.point_step], 4);
      x.push_back(origin[0] + relative);
    }
  }
  EXPECT_EQ((std::vector<double>{4000000.125,
                                 4000001.125,
                                 4000002.125,
                                 4000900.125,
                                 4000901.125,
                                 4000902.125}),
            x);
}

TEST(RankFiles, CountTheNamesOfAllPieces)
{
  const TemporaryFolder folder;
  writeFile(folder / "a.csv", "x,y,z,hole\n0,0,0,B\n1,0,0,D\n");
  writeFile(folder / "b.csv", "x,y,z,hole\n2,0,0,A\n3,0,0,\n4,0,0,B\n");
  const Parts parts({folder / "a.csv", folder / "b.csv"}, 2);
  const LabelNames names{{"hole", {"A", "B", "D"}}};
  EXPECT_EQ(names, parts.parts[0].labels);
  EXPECT_EQ(names, parts.parts[1].labels);
  const Parts alone({folder / "a.csv", folder / "b.csv"}, 1);
  EXPECT_EQ(names, alone.parts[0].labels);
  EXPECT_EQ(alone.join(), parts.join());
  const double labels[] = {1, 2, 0, -1, 1};
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(labels[i], valueOf(alone.parts[0], "hole", i)) << i;
}

/** Numbers of holes would be looked up among the names of the other piece. */
TEST(RankFiles, RefuseNamesInOnePieceAndNumbersInAnother)
{
  const TemporaryFolder folder;
  writeFile(folder / "a.csv", "x,y,z,hole\n0,0,0,1\n1,0,0,34873\n");
  writeFile(folder / "b.csv", "x,y,z,hole\n2,0,0,A-117\n3,0,0,34873\n4,0,0,B\n");
  for (const std::size_t ranks : {1, 2, 3})
    EXPECT_EQ(Message("names_in_one_piece",
                      {{"field", "hole"},
                       {"path", folder / "b.csv"},
                       {"other", folder / "a.csv"}}),
              refusalOf({folder / "a.csv", folder / "b.csv"}, ranks));
}

TEST(RankFiles, RefuseWhatDoesNotFitTogether)
{
  const TemporaryFolder folder;
  saveDataset(folder / "in_0.vtp", line(3, 0.0));
  Dataset other = line(3, 5.0);
  setField(other, "label", std::vector<std::int32_t>(3));
  saveDataset(folder / "in_1.vtp", other);
  for (const std::size_t ranks : {1, 2, 5}) {
    const Message refusal = refusalOf({folder / "in_*.vtp"}, ranks);
    EXPECT_EQ("pieces_of_other_fields", refusal.code);
    EXPECT_EQ("none", wordOf(refusal, "fields"));
    EXPECT_EQ("label (int32)", wordOf(refusal, "other_fields"));
  }
  for (const std::string& path : {folder / "none.vtp", folder / "none.pcd"}) {
    saveDataset(path, line(0, 0.0));
    EXPECT_EQ(Message("no_points", {{"path", path}}), refusalOf({path}, 2));
  }
  EXPECT_EQ(Message("pieces_without_points", {{"pieces", 2}}),
            refusalOf({folder / "none.vtp", folder / "none.vtp"}, 2));
  EXPECT_EQ("no_matching_file", refusalOf({folder / "else_*.vtp"}).code);
}

TEST(RankFiles, RefuseDamagedLists)
{
  const TemporaryFolder folder;
  runRanks(2, [&](Communicator& ranks) {
    savePieces(folder / "out.pvtp", line(3, 0.0), ranks);
  });
  const std::string list = readFile(folder / "out.pvtp");
  const std::string bad = folder / "bad.pvtp";
  writeFile(bad, list.substr(0, list.size() / 2));
  EXPECT_EQ("truncated_part", refusalOf({bad}).code);
  for (const std::string& text :
       {std::string("no XML"), std::string("<VTKFile type=\"PPolyData\"/>")}) {
    writeFile(bad, text);
    EXPECT_EQ("not_format", refusalOf({bad}).code);
  }
  writeFile(bad, "<VTKFile><PPolyData><Piece/></PPolyData></VTKFile>");
  EXPECT_EQ("missing_part", refusalOf({bad}).code);
  writeFile(bad, "<VTKFile><PPolyData/></VTKFile>");
  EXPECT_EQ("nothing_inside", refusalOf({bad}).code);
  writeFile(bad, "");
  EXPECT_NE("", refusalOf({bad}).code);
  std::filesystem::remove(folder / "out_1.vtp");
  const Message missing = refusalOf({folder / "out.pvtp"});
  EXPECT_EQ("no_such_file", missing.code);
  EXPECT_EQ(folder / "out_1.vtp", wordOf(missing, "path"));
}

TEST(RankFiles, LeaveNothingIfOneCannotWrite)
{
  for (const std::string taken : {"out_1.vtp", "out_0.vtp", "out.pvtp"}) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / taken);
    EXPECT_THROW(runRanks(3,
                          [&](Communicator& ranks) {
                            savePieces(folder / "out.pvtp", line(3, 0.0), ranks);
                          }),
                 std::exception);
    EXPECT_EQ(std::vector<std::string>{taken}, folder.list());
  }
}

TEST(RankFiles, LeaveWhatWasThereIfOneCannotWrite)
{
  const TemporaryFolder folder;
  const auto save = [&](std::size_t ranks, double value) {
    runRanks(ranks, [&](Communicator& communicator) {
      savePieces(folder / "out.pvtp", line(3, 0.0, value), communicator);
    });
  };
  const auto contents = [&] {
    std::string all;
    for (const char* const name : {"out.pvtp", "out_0.vtp", "out_1.vtp"})
      all += readFile(folder / name);
    return all;
  };
  save(2, 1.0);
  const std::string before = contents();
  std::filesystem::create_directory(folder / "out_2.vtp");
  EXPECT_THROW(save(3, 2.0), std::exception);
  EXPECT_EQ(before, contents());
  save(2, 2.0);
  EXPECT_NE(before, contents());
}

TEST(RankFiles, KnowWhereTheyCanWrite)
{
  const TemporaryFolder folder;
  checkSavePieces(folder / "out.pvtp");
  EXPECT_THROW(checkSavePieces(folder / "out.vtp"), IOError);
  EXPECT_THROW(checkSavePieces(folder / "none/out.pvtp"), IOError);
}

} // namespace test_rank_files
