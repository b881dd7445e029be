// SPDX-License-Identifier: BSD-3-Clause
// Grids written part by part, and read back by VTK and by our own readers.
#include "io/lattice_file.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>
#include <pcl/PCLPointField.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLStructuredGridReader.h>

#include <cmath>
#include <numeric>

namespace test_lattice_file {

using namespace pcl_uvol;
using pcl_uvol::detail::QueryLattice;
using uvol_test::TemporaryFolder;
using Type = pcl::PCLPointField;

const std::vector<LatticeArray> arrays{{"a<b", Type::FLOAT64, 1},
                                       {"error", Type::FLOAT32, 1},
                                       {"gradient", Type::FLOAT32, 3},
                                       {"support", Type::UINT8, 1}};

QueryLattice
makeLattice(bool slants)
{
  QueryLattice lattice;
  lattice.origin = {0.1, -2.0, 1e6 + 1.0 / 3.0};
  lattice.counts = {4, 3, 2};
  lattice.steps = {{{0.5, 0, 0}, {0, 0.25, 0}, {0, 0, 2}}};
  if (slants)
    lattice.steps = {{{0.3, 0.4, 0}, {-0.2, 0.15, 0}, {0, 0, 2}}};
  return lattice;
}

/** Numbers i, i + 100, i + 200 + component, i + 1, the later half first. */
void
fill(const PutNumbers& put, std::size_t count)
{
  for (const std::size_t first : {count / 2, std::size_t{0}}) {
    std::vector<double> values;
    std::vector<float> errors, gradients;
    std::vector<std::uint8_t> support;
    for (std::size_t i = first; i < first + count / 2; ++i) {
      values.push_back(static_cast<double>(i));
      errors.push_back(static_cast<float>(i + 100));
      for (std::size_t k = 0; k < 3; ++k)
        gradients.push_back(static_cast<float>(i + 200 + k));
      support.push_back(static_cast<std::uint8_t>(i + 1));
    }
    put(0, first, count / 2, values.data());
    put(1, first, count / 2, errors.data());
    put(2, first, count / 2, gradients.data());
    put(3, first, count / 2, support.data());
  }
}

void
save(const std::string& path, const QueryLattice& lattice)
{
  saveLattice(
      path, lattice, arrays, [&](const PutNumbers& put) { fill(put, lattice.size()); });
}

void
expectArrays(vtkDataSet& data, const QueryLattice& lattice)
{
  ASSERT_EQ(static_cast<std::size_t>(data.GetNumberOfPoints()), lattice.size());
  for (const LatticeArray& array : arrays)
    ASSERT_NE(data.GetPointData()->GetArray(array.name.c_str()), nullptr) << array.name;
  const auto number = [&](const char* name, vtkIdType i, int component) {
    return data.GetPointData()->GetArray(name)->GetComponent(i, component);
  };
  EXPECT_STREQ(data.GetPointData()->GetScalars()->GetName(), "a<b");
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    const auto at = static_cast<double>(i);
    EXPECT_EQ(number("a<b", i, 0), at);
    EXPECT_EQ(number("error", i, 0), at + 100.0);
    EXPECT_EQ(number("gradient", i, 2), at + 202.0);
    EXPECT_EQ(number("support", i, 0), at + 1.0);
    const auto expected = lattice.at(static_cast<std::size_t>(i));
    double place[3];
    data.GetPoint(i, place);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(place[axis], expected[axis], 1e-9);
  }
}

TEST(LatticeFile, VtkReadsImagesAndGrids)
{
  const TemporaryFolder folder;
  for (const bool slants : {false, true}) {
    const QueryLattice lattice = makeLattice(slants);
    save(folder / "grid.vti", lattice);
    vtkNew<vtkXMLImageDataReader> images;
    images->SetFileName((folder / "grid.vti").c_str());
    images->Update();
    expectArrays(*images->GetOutput(), lattice);
    EXPECT_EQ(images->GetOutput()->GetDirectionMatrix()->IsIdentity(), !slants);
    save(folder / "grid.vts", lattice);
    vtkNew<vtkXMLStructuredGridReader> grids;
    grids->SetFileName((folder / "grid.vts").c_str());
    grids->Update();
    expectArrays(*grids->GetOutput(), lattice);
  }
}

TEST(LatticeFile, OurReadersTakeWhatTheyCanHold)
{
  const TemporaryFolder folder;
  const QueryLattice lattice = makeLattice(false);
  for (const std::string ending : {".nrrd", ".mha"}) {
    SCOPED_TRACE(ending);
    save(folder / ("grid" + ending), lattice);
    const std::vector<std::string> names{"grid" + ending,
                                         "grid_error" + ending,
                                         "grid_gradient" + ending,
                                         "grid_support" + ending};
    EXPECT_EQ(folder.list(), names);
    const double offsets[] = {0.0, 100.0, 0.0, 1.0};
    for (const std::size_t i : {0, 1, 3}) {
      const Volume volume = loadVolume(folder / names[i]);
      EXPECT_EQ(volume.dims, lattice.counts);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(volume.origin[axis], lattice.origin[axis]);
        EXPECT_NEAR(volume.spacing[axis], lattice.spacing(axis), 1e-15);
      }
      for (std::size_t k = 0; k < lattice.size(); ++k)
        EXPECT_EQ(volume.values[k], static_cast<double>(k) + offsets[i]);
    }
    // Three numbers per point are no scalar volume, and told to be none.
    EXPECT_THROW(loadVolume(folder / names[2]), IOError);
    for (const std::string& name : names)
      std::remove((folder / name).c_str());
  }
  save(folder / "grid.vti", lattice);
  EXPECT_EQ(loadVolume(folder / "grid.vti").values[7], 7.0f);
}

TEST(LatticeFile, AppearsWholeOrNotAtAll)
{
  const TemporaryFolder folder;
  for (const std::string name : {"grid.vti", "grid.nrrd"})
    EXPECT_THROW(saveLattice(folder / name,
                             makeLattice(false),
                             arrays,
                             [](const PutNumbers&) { throw InvalidArgument("No."); }),
                 InvalidArgument);
  EXPECT_TRUE(folder.list().empty());
  EXPECT_THROW(latticeFiles(folder / "grid.ply", arrays), IOError);
  EXPECT_THROW(latticeFiles(folder / "no/such/grid.vti", arrays), IOError);
  EXPECT_TRUE(isLatticeFile("a.VTI"));
  EXPECT_FALSE(isLatticeFile("a.vtp"));
}

} // namespace test_lattice_file
