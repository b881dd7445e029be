// SPDX-License-Identifier: BSD-3-Clause
// Snapshots of particles: binary ones of Gadget and those in HDF5.
#include "hdf5_writer.h"
#include "io/memory_need.h"
#include "io/point_stream.h"
#include "random_dataset.h"
#include "support/messages.h"
#include "support/snapshots.h"
#include <pcl_uvol/common/exceptions.h>

#include <filesystem>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_snapshots {

/** Blocks give the bytes of the whole, and the header tells of it. */
void
expectStreams(const std::string& path, const LoadOptions& options = {})
{
  const Dataset whole = loadDataset(path, options);
  PointStream stream(path, options);
  EXPECT_EQ(whole.cloud.width, stream.size());
  EXPECT_EQ(whole.notes, stream.getHeader().notes);
  for (const std::size_t size : {1u, 3u, 1000u}) {
    std::vector<std::uint8_t> data;
    pcl::PCLPointCloud2 block;
    stream.seek(0);
    while (stream.read(size, block))
      data.insert(data.end(), block.data.begin(), block.data.end());
    EXPECT_TRUE(whole.cloud.data == data) << size;
  }
  const auto promised = peekHeader(path, options);
  ASSERT_TRUE(promised);
  EXPECT_EQ(whole.cloud.width, promised->points);
  EXPECT_EQ(whole.cloud.point_step, promised->point_step);
}

bool
hasNote(const Dataset& dataset, const Message& note)
{
  return std::find(dataset.notes.begin(), dataset.notes.end(), note) !=
         dataset.notes.end();
}

class Gadget : public testing::Test {
protected:
  std::string
  save(const std::string& name, const GadgetLayout& layout) const
  {
    writeFile(folder_ / name, makeGadget(layout));
    return folder_ / name;
  }

  /** 5 of gas, 3 of dark matter of one mass, 2 stars. */
  static GadgetLayout
  mixed()
  {
    GadgetLayout layout;
    layout.here = layout.total = {5, 3, 0, 0, 2, 0};
    layout.masses[1] = 0.75;
    return layout;
  }

  TemporaryFolder folder_;
};

TEST_F(Gadget, EveryFormatGivesTheNumbersOfEveryKind)
{
  for (const bool labels : {false, true})
    for (const bool big_endian : {false, true})
      for (const bool doubles : {false, true}) {
        SCOPED_TRACE(testing::Message() << labels << big_endian << doubles);
        GadgetLayout layout = mixed();
        layout.has_labels = labels;
        layout.big_endian = big_endian;
        layout.doubles = doubles;
        const std::string path = save("snap_000", layout);
        const Dataset gas = loadDataset(path);
        ASSERT_EQ(5u, gas.cloud.width);
        EXPECT_EQ(doubles, gas.double_coordinates);
        for (std::uint32_t i = 0; i < 5; ++i) {
          EXPECT_EQ(snapshotNumber(i, 0, 1), valueAt(gas, "y", i) + gas.origin[1]);
          EXPECT_EQ(snapshotNumber(i, 1, 2), valueAt(gas, "VEL[2]", i));
          EXPECT_EQ(i, valueAt(gas, "ID", i));
          EXPECT_EQ(snapshotNumber(i, 2, 0), valueAt(gas, "MASS", i));
          EXPECT_EQ(snapshotNumber(i, 3, 0), valueAt(gas, "U", i));
          EXPECT_EQ(snapshotNumber(i, 4, 0), valueAt(gas, "RHO", i));
          EXPECT_EQ(snapshotNumber(i, 5, 0), valueAt(gas, "HSML", i));
        }
        EXPECT_TRUE(
            hasNote(gas,
                    {"several_kinds",
                     {{"kinds", "5 of gas (0), 3 of dm (1), 2 of stars (4)"}}}));
        LoadOptions options;
        options.particles = "dm";
        const Dataset dark = loadDataset(path, options);
        ASSERT_EQ(3u, dark.cloud.width);
        EXPECT_TRUE(dark.notes.empty());
        EXPECT_EQ(nullptr, findField(dark.cloud.fields, "RHO"));
        for (std::uint32_t i = 0; i < 3; ++i) {
          EXPECT_EQ(snapshotNumber(5 + i, 0, 0),
                    valueAt(dark, "x", i) + dark.origin[0]);
          EXPECT_EQ(0.75, valueAt(dark, "MASS", i));
        }
        options.particles = "4";
        const Dataset stars = loadDataset(path, options);
        ASSERT_EQ(2u, stars.cloud.width);
        EXPECT_EQ(snapshotNumber(8, 2, 0), valueAt(stars, "MASS", 0));
        EXPECT_EQ(9.0, valueAt(stars, "ID", 1));
        for (const char* const kind : {"", "dm", "stars"}) {
          options.particles = kind;
          expectStreams(path, options);
        }
      }
}

TEST_F(Gadget, SeveralFilesAreOneSnapshot)
{
  GadgetLayout layout = mixed();
  layout.files = 3;
  layout.total = {9, 3, 0, 0, 2, 0};
  save("snap.0", layout);
  layout.first = 10;
  layout.here = {4, 0, 0, 0, 0, 0};
  save("snap.1", layout);
  layout.here = {};
  save("snap.2", layout);
  const Dataset whole = loadDataset(folder_ / "snap.1");
  ASSERT_EQ(9u, whole.cloud.width);
  EXPECT_EQ(snapshotNumber(4, 4, 0), valueAt(whole, "RHO", 4));
  EXPECT_EQ(snapshotNumber(10, 4, 0), valueAt(whole, "RHO", 5));
  EXPECT_EQ(snapshotNumber(13, 0, 2), valueAt(whole, "z", 8));
  expectStreams(folder_ / "snap.0");
  std::filesystem::remove(folder_ / "snap.2");
  EXPECT_EQ("no_required_file", codeOf([&] { loadDataset(folder_ / "snap.0"); }));
  std::filesystem::rename(folder_ / "snap.0", folder_ / "alone");
  EXPECT_EQ("snapshot_without_number", codeOf([&] { loadDataset(folder_ / "alone"); }));
}

TEST_F(Gadget, PartsOfAnotherPrecisionAreRefused)
{
  GadgetLayout layout = mixed();
  layout.files = 2;
  layout.total = {10, 6, 0, 0, 4, 0};
  save("snap.0", layout);
  layout.doubles = true;
  save("snap.1", layout);
  EXPECT_EQ("disagreeing_parts", codeOf([&] { loadDataset(folder_ / "snap.0"); }));
}

TEST_F(Gadget, ComovingUnitsAndBoxesAreReported)
{
  GadgetLayout layout = mixed();
  layout.redshift = 2.0;
  layout.hubble = 0.7;
  layout.box = 100.0;
  EXPECT_EQ(std::vector<std::string>{"several_kinds"},
            listCodes(loadDataset(save("a", layout)).notes));
  EXPECT_EQ((std::array<double, 3>{{100.0, 100.0, 100.0}}),
            loadDataset(save("a", layout)).box);
  EXPECT_EQ(0.25, peekHeader(save("a", layout))->time);
  layout.omega = 0.3;
  EXPECT_TRUE(hasNote(
      loadDataset(save("b", layout)),
      {"comoving_units", {{"redshift", 2.0}, {"has_hubble", 1}, {"hubble", 0.7}}}));
}

TEST_F(Gadget, KindsThatAreNotThereAreNamed)
{
  const std::string path = save("a", mixed());
  LoadOptions options;
  for (const char* const kind : {"bh", "3", "9", "Gass", "-1"}) {
    options.particles = kind;
    EXPECT_EQ("no_particles", codeOf([&] { loadDataset(path, options); })) << kind;
  }
  options.particles = "GAS";
  EXPECT_EQ(5u, loadDataset(path, options).cloud.width);
  saveDataset(folder_ / "a.pcd", makeDataset({}, 3, 1));
  EXPECT_THROW(loadDataset(folder_ / "a.pcd", options), InvalidArgument);
}

/** Cut off anywhere, and with any byte changed, a file is read or refused. */
TEST_F(Gadget, DamageIsOneSentence)
{
  for (const bool labels : {false, true}) {
    GadgetLayout layout = mixed();
    layout.has_labels = labels;
    const std::string bytes = makeGadget(layout);
    const std::string path = folder_ / "a";
    const auto try_bytes = [&](const std::string& content) {
      writeFile(path, content);
      const std::string message = messageOf<IOError>([&] { loadDataset(path); });
      if (!message.empty()) {
        EXPECT_NE(std::string::npos, message.find(path)) << message;
        EXPECT_LE(message.size(), 400 + path.size()) << message;
      }
      return message;
    };
    for (std::size_t size = 1; size < bytes.size(); size += size < 264 ? 40 : 4)
      if (try_bytes(bytes.substr(0, size)).empty()) {
        // It ends behind a block, and only what follows is missing.
        EXPECT_EQ(nullptr, findField(loadDataset(path).cloud.fields, "HSML")) << size;
        EXPECT_EQ(labels ? 8u : 4u,
                  std::min<std::size_t>(bytes.size() - size, labels ? 8 : 4));
      }
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
      std::string other = bytes;
      other[i] = static_cast<char>(other[i] ^ (i % 3 == 0 ? '\x01' : '\x80'));
      try_bytes(other);
    }
  }
}

TEST(PlanetRemnant, IsTheTableMadeOfIt)
{
  if (dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const Dataset snapshot =
      loadDataset(dataFolder() + "/particles/planet_remnant.gadget1");
  const Dataset table = loadDataset(dataFolder() + "/particles/planet_remnant.csv");
  ASSERT_EQ(table.cloud.width, snapshot.cloud.width);
  for (const auto& [own, other] :
       {std::pair<std::string, std::string>{"RHO", "rho_g_cm3"},
        {"HSML", "h_cm"},
        {"ID", "id"},
        {"VEL[1]", "vy_cm_s"},
        {"MASS", "mass_g"}})
    for (std::size_t i = 0; i < table.cloud.width; ++i) {
      const double expected = valueAt(table, other, i);
      EXPECT_NEAR(expected, valueAt(snapshot, own, i), 1e-6 * std::abs(expected))
          << own;
    }
}

class Hdf5 : public testing::Test {
protected:
  /** 8 of gas and 4 stars, as Gadget 4, AREPO, SWIFT and GIZMO write them. */
  void
  saveSnapshot(const std::string& name,
               double first = 0.0,
               int files = 1,
               bool is_timed = false)
  {
    Hdf5Writer file(folder_ / name);
    file.group("/Header");
    file.attribute("/Header", "NumPart_ThisFile", {8, 0, 0, 0, 4, 0});
    file.attribute("/Header", "NumPart_Total", {8.0 * files, 0, 0, 0, 4.0 * files, 0});
    file.attribute("/Header", "NumFilesPerSnapshot", {double(files)});
    file.attribute("/Header", "MassTable", {0, 0, 0, 0, 2.5, 0});
    file.attribute("/Header", "Redshift", {0.5});
    if (is_timed)
      file.attribute("/Header", "Time", {1.5});
    file.group("/PartType0");
    file.table("/PartType0/Coordinates", H5T_IEEE_F64LE, 3, numbersOf(24, first), 3);
    file.table("/PartType0/Density", H5T_IEEE_F32BE, 1, numbersOf(8, 100 + first));
    file.table("/PartType0/Masses", H5T_IEEE_F32LE, 1, numbersOf(8, 200), 5);
    file.table("/PartType0/ParticleIDs", H5T_STD_U64LE, 1, numbersOf(8, 300));
    file.group("/PartType4");
    file.table("/PartType4/Coordinates", H5T_IEEE_F32LE, 3, numbersOf(12, 50));
  }

  std::string
  refusalOf(const std::string& path) const
  {
    return codeOf([&] { loadDataset(path); });
  }

  TemporaryFolder folder_;
};

TEST_F(Hdf5, SnapshotsGiveTheirNumbers)
{
  saveSnapshot("a.hdf5");
  const Dataset gas = loadDataset(folder_ / "a.hdf5");
  ASSERT_EQ(8u, gas.cloud.width);
  EXPECT_TRUE(gas.double_coordinates);
  EXPECT_EQ(Type::UINT64, findField(gas.cloud.fields, "ParticleIDs")->datatype);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto number = static_cast<double>(i);
    EXPECT_EQ(3 * number + 2, valueAt(gas, "z", i) + gas.origin[2]);
    EXPECT_EQ(100 + number, valueAt(gas, "Density", i));
    EXPECT_EQ(200 + number, valueAt(gas, "Masses", i));
    EXPECT_EQ(300 + number, valueAt(gas, "ParticleIDs", i));
  }
  EXPECT_TRUE(
      hasNote(gas, {"several_kinds", {{"kinds", "8 of gas (0), 4 of stars (4)"}}}));
  EXPECT_TRUE(hasNote(
      gas,
      {"comoving_units", {{"redshift", 0.5}, {"has_hubble", 0}, {"hubble", 0.0}}}));
  EXPECT_FALSE(peekHeader(folder_ / "a.hdf5")->time);
  saveSnapshot("timed.hdf5", 0.0, 1, true);
  EXPECT_EQ(1.5, peekHeader(folder_ / "timed.hdf5")->time);
  expectStreams(folder_ / "a.hdf5");
  LoadOptions options;
  options.particles = "stars";
  const Dataset stars = loadDataset(folder_ / "a.hdf5", options);
  ASSERT_EQ(4u, stars.cloud.width);
  EXPECT_EQ(2.5, valueAt(stars, "Masses", 3));
  EXPECT_EQ(50.0, valueAt(stars, "x", 0));
  EXPECT_EQ(4u, loadDataset(folder_ / "a.hdf5:/PartType4").cloud.width);
  std::filesystem::rename(folder_ / "a.hdf5", folder_ / "snapshot_099");
  EXPECT_EQ(8u, loadDataset(folder_ / "snapshot_099").cloud.width);
}

TEST_F(Hdf5, SeveralFilesAreOneSnapshot)
{
  saveSnapshot("s.0.hdf5", 0.0, 2);
  saveSnapshot("s.1.hdf5", 24.0, 2);
  const Dataset gas = loadDataset(folder_ / "s.1.hdf5");
  ASSERT_EQ(16u, gas.cloud.width);
  EXPECT_EQ(24.0, valueAt(gas, "x", 8) + gas.origin[0]);
  EXPECT_EQ(131.0, valueAt(gas, "Density", 15));
  expectStreams(folder_ / "s.0.hdf5");
}

TEST_F(Hdf5, TablesOfAnyGroupCanBeNamed)
{
  {
    Hdf5Writer file(folder_ / "a.h5");
    file.group("/deep");
    file.group("/deep/er");
    for (const char* const name : {"lon", "lat", "up", "T"})
      file.table(
          std::string("/deep/er/") + name, H5T_IEEE_F32LE, 1, numbersOf(5, name[0]));
    file.table("/deep/er/other", H5T_IEEE_F32LE, 1, numbersOf(4, 0));
    file.table("/deep/er/wide", H5T_IEEE_F32LE, 70, numbersOf(350, 0));
    file.group("/Step#0");
    for (const char* const name : {"x", "y", "z", "s"})
      file.table(
          std::string("/Step#0/") + name, H5T_STD_I16LE, 1, numbersOf(3, name[0]));
  }
  const Dataset step = loadDataset(folder_ / "a.h5");
  ASSERT_EQ(3u, step.cloud.width);
  EXPECT_EQ(double('s') + 2, valueAt(step, "s", 2));
  const std::string path = folder_ / "a.h5:/deep/er/lon,lat,up";
  const Dataset named = loadDataset(path);
  ASSERT_EQ(5u, named.cloud.width);
  EXPECT_EQ(double('u') + 4, valueAt(named, "z", 4));
  EXPECT_EQ(double('T') + 4, valueAt(named, "T", 4));
  EXPECT_EQ(nullptr, findField(named.cloud.fields, "other"));
  EXPECT_TRUE(
      hasNote(named, {"wide_table", {{"table", "/deep/er/wide"}, {"components", 70}}}));
  expectStreams(path);
  EXPECT_EQ("no_usual_coordinates", refusalOf(folder_ / "a.h5:/deep/er"));
  EXPECT_EQ("wrong_count", refusalOf(folder_ / "a.h5:/deep/er/lon,lat,other"));
  EXPECT_EQ("not_coordinate_tables", refusalOf(folder_ / "a.h5:/deep/er/lon,lat"));
  EXPECT_EQ("unexpected_word", refusalOf(folder_ / "a.h5:/deep/er/lon"));
  EXPECT_EQ("no_such_file", refusalOf(folder_ / "b.h5:/deep"));
}

TEST_F(Hdf5, VtkhdfGivesItsPointData)
{
  {
    Hdf5Writer file(folder_ / "a.vtkhdf");
    file.group("/VTKHDF");
    file.table("/VTKHDF/Points", H5T_IEEE_F32LE, 3, numbersOf(6, 0));
    file.group("/VTKHDF/PointData");
    file.table("/VTKHDF/PointData/T", H5T_IEEE_F32LE, 1, numbersOf(2, 7));
  }
  const Dataset points = loadDataset(folder_ / "a.vtkhdf");
  ASSERT_EQ(2u, points.cloud.width);
  EXPECT_EQ(8.0, valueAt(points, "T", 1));
}

TEST_F(Hdf5, PhantomHasItsDensity)
{
  if (dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const std::string path = dataFolder() + "/particles/phantom_adiabatic.h5";
  const Dataset all = loadDataset(path);
  ASSERT_EQ(20736u, all.cloud.width);
  LoadOptions options;
  options.particles = "gas";
  const Dataset gas = loadDataset(path, options);
  ASSERT_EQ(16416u, gas.cloud.width);
  // The shock tube begins with densities of 1 and 0.125 to either side.
  double least = 2.0, most = 0.0;
  for (std::size_t i = 0; i < gas.cloud.width; ++i) {
    const double density = valueAt(gas, "rho", i);
    least = std::min(least, density);
    most = std::max(most, density);
    EXPECT_EQ(1.0, valueAt(gas, "itype", i));
  }
  EXPECT_NEAR(0.125, least, 1e-4);
  EXPECT_NEAR(1.0, most, 1e-3);
  EXPECT_EQ(0.0, peekHeader(path)->time);
  expectStreams(path);
  expectStreams(path, options);
}

TEST_F(Hdf5, PromisesAreHeldAgainstWhatIsStored)
{
  {
    Hdf5Writer file(folder_ / "a.h5");
    const hsize_t sizes[2] = {hsize_t(1) << 31, 3};
    const hid_t space = H5Screate_simple(2, sizes, nullptr);
    const hid_t id = H5Dcreate2(file.getId(),
                                "/pos",
                                H5T_IEEE_F32LE,
                                space,
                                H5P_DEFAULT,
                                H5P_DEFAULT,
                                H5P_DEFAULT);
    H5Dclose(id);
    H5Sclose(space);
  }
  EXPECT_EQ("truncated_data", refusalOf(folder_ / "a.h5"));
}

TEST_F(Hdf5, LinksToOtherFilesAreNotFollowed)
{
  saveSnapshot("a.h5");
  {
    Hdf5Writer file(folder_ / "b.h5");
    H5Lcreate_external((folder_ / "a.h5").c_str(),
                       "/PartType0/Coordinates",
                       file.getId(),
                       "/pos",
                       H5P_DEFAULT,
                       H5P_DEFAULT);
  }
  EXPECT_EQ("no_usual_coordinates", refusalOf(folder_ / "b.h5"));
}

TEST_F(Hdf5, DamageIsOneSentence)
{
  saveSnapshot("a.h5");
  const std::string bytes = readFile(folder_ / "a.h5");
  const std::string path = folder_ / "b.h5";
  Random random(1);
  for (int i = 0; i < 600; ++i) {
    std::string other = bytes;
    if (i % 3 == 0)
      other.resize(static_cast<std::size_t>(random.uniform() * double(bytes.size())) +
                   1);
    else
      for (int k = 0; k < 3; ++k)
        other[static_cast<std::size_t>(random.uniform() * double(bytes.size()))] =
            static_cast<char>(256.0 * random.uniform());
    writeFile(path, other);
    const std::string message = messageOf<IOError>([&] { loadDataset(path); });
    if (!message.empty()) {
      EXPECT_NE(std::string::npos, message.find(path)) << message;
      EXPECT_EQ(std::string::npos, message.find("0x")) << message;
    }
  }
  writeFile(path, "no HDF5");
  EXPECT_EQ("not_format", refusalOf(path));
}

} // namespace test_snapshots
