// SPDX-License-Identifier: BSD-3-Clause
#include "filters/cell_locator.h"

#include "common/memory.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStaticCellLocator.h>
#include <vtkStructuredData.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl_uvol {

namespace {

/** Share of the longest side of the mesh: places are asked for where samples are, and
 * these are rounded to float, to 1e-7 of the extent (see setCoordinates). VTK's search
 * in cells of 1 : 50,000 is coarser: of 210 nodes of such a mesh 2.5e-7 misses five,
 * 1e-5 three. */
constexpr double rounding = 1e-5;

/** Binary digits of the longest side. VTK takes hexahedra whose determinant is below
 * 1e-20 for flat: with such sides they may be 1e-29 of the box. */
constexpr int side_digits = 10;

/** In the mean: a place inside of the blunt fin takes 3.9 us of a core, with VTK's
 * usual 10 cells 8.1 us, since each candidate is a Newton search. */
constexpr int cells_per_bin = 1;

/** Bytes of its bounds and of the bins that it is in (measured: 138 to 144). */
constexpr double cell_bytes = 140.0;

/** \return the interval of ascending coordinates that holds a number within their range
 */
int
findInterval(vtkDataArray& coordinates, double number)
{
  int low = 0, high = static_cast<int>(coordinates.GetNumberOfTuples()) - 1;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (coordinates.GetComponent(middle, 0) <= number ? low : high) = middle;
  }
  return low;
}

} // namespace

/** What a thread needs to ask. */
struct CellLocator::Finder {
  explicit Finder(vtkDataSet& mesh)
      : weights(static_cast<std::size_t>(std::max(1, mesh.GetMaxCellSize())))
  {
  }

  vtkIdType
  find(vtkDataSet& mesh,
       vtkStaticCellLocator& locator,
       double tolerance,
       std::array<double, 3>& place);

  vtkNew<vtkGenericCell> cell;
  vtkNew<vtkIdList> ids;
  std::vector<double> weights;
};

/** \return the cell around a place, or one that is no farther than a tolerance; -1 */
vtkIdType
CellLocator::Finder::find(vtkDataSet& mesh,
                          vtkStaticCellLocator& locator,
                          double tolerance,
                          std::array<double, 3>& place)
{
  double parameters[3];
  const vtkIdType found =
      locator.FindCell(place.data(), 0.0, cell, parameters, weights.data());
  if (found >= 0)
    return found;
  double box[6];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box[2 * axis] = place[axis] - tolerance;
    box[2 * axis + 1] = place[axis] + tolerance;
  }
  locator.FindCellsWithinBounds(box, ids);
  for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i) {
    mesh.GetCell(ids->GetId(i), cell);
    double closest[3], sq_distance = 0.0;
    int part = 0;
    const int status = cell->EvaluatePosition(
        place.data(), closest, part, parameters, sq_distance, weights.data());
    if (status == 1 || (status == 0 && sq_distance <= tolerance * tolerance))
      return ids->GetId(i);
  }
  return -1;
}

CellLocator::CellLocator(vtkSmartPointer<vtkDataSet> mesh,
                         Samples samples,
                         std::size_t count,
                         const std::array<double, 3>& origin)
    : mesh_(std::move(mesh))
    , sample_of_(
          vtkIdTypeArray::SafeDownCast(mesh_->GetCellData()->GetArray(sample_array)))
    , samples_(samples)
    , count_(count)
    , shift_(origin)
{
  normalize();
  mesh_->GetBounds(bounds_.data());
  double longest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    longest = std::max(longest, bounds_[2 * axis + 1] - bounds_[2 * axis]);
  tolerance_ = rounding * longest;
  if (vtkRectilinearGrid::SafeDownCast(mesh_) != nullptr)
    return;
  const vtkIdType cells = mesh_->GetNumberOfCells();
  checkMemory("Locating " + std::to_string(cells) + " cells",
              cell_bytes * static_cast<double>(cells));
  locator_ = vtkSmartPointer<vtkStaticCellLocator>::New();
  locator_->SetDataSet(mesh_);
  locator_->SetNumberOfCellsPerNode(cells_per_bin);
  locator_->CacheCellBoundsOn();
  locator_->BuildLocator();
  mesh_->GetCell(0, vtkNew<vtkGenericCell>()); // VTK: threads may ask after one did
}

CellLocator::~CellLocator() = default;

/** Move the points of a mesh to its low corner, and scale them by a power of two. */
void
CellLocator::normalize()
{
  auto* const set = vtkPointSet::SafeDownCast(mesh_);
  if (!set)
    return;
  double bounds[6], longest = 0.0;
  mesh_->GetBounds(bounds);
  for (std::size_t axis = 0; axis < 3; ++axis)
    longest = std::max(longest, bounds[2 * axis + 1] - bounds[2 * axis]);
  scale_ = longest > 0.0 ? std::ldexp(1.0, side_digits - std::ilogb(longest)) : 1.0;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(set->GetNumberOfPoints());
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i) {
    double place[3];
    set->GetPoint(i, place);
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = (place[axis] - bounds[2 * axis]) * scale_;
    points->SetPoint(i, place);
  }
  set->SetPoints(points);
  for (std::size_t axis = 0; axis < 3; ++axis)
    shift_[axis] -= bounds[2 * axis];
}

/** Bring a place that rounding has taken out of the box of the mesh back.
 * \return false for a place outside */
bool
CellLocator::enterBounds(std::array<double, 3>& place) const
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = bounds_[2 * axis], high = bounds_[2 * axis + 1];
    if (!(place[axis] >= low - tolerance_ && place[axis] <= high + tolerance_))
      return false;
    place[axis] = std::clamp(place[axis], low, high);
  }
  return true;
}

bool
CellLocator::areUsed(std::int64_t cell,
                     const std::vector<bool>& used,
                     Finder& finder) const
{
  if (used.size() != count_) // not the samples of this mesh
    return true;
  const auto isUsed = [&](vtkIdType sample) {
    return used[static_cast<std::size_t>(sample)];
  };
  if (samples_ == Samples::Centers)
    return isUsed(sample_of_ ? sample_of_->GetValue(cell) : cell);
  mesh_->GetCellPoints(cell, finder.ids);
  for (vtkIdType i = 0; i < finder.ids->GetNumberOfIds(); ++i)
    if (!isUsed(finder.ids->GetId(i)))
      return false;
  return true;
}

void
CellLocator::findInside(const std::array<double, 3>* places,
                        std::size_t count,
                        const std::vector<bool>& used,
                        std::uint8_t* inside) const
{
  Finder finder(*mesh_);
  auto* const lattice = vtkRectilinearGrid::SafeDownCast(mesh_);
  for (std::size_t i = 0; i < count; ++i) {
    inside[i] = 0;
    std::array<double, 3> place = places[i];
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = (place[axis] + shift_[axis]) * scale_;
    if (!enterBounds(place))
      continue;
    vtkIdType cell = -1;
    if (locator_)
      cell = finder.find(*mesh_, *locator_, tolerance_, place);
    else {
      // VTK's own search misses the high faces of a lattice.
      vtkDataArray* const axes[] = {lattice->GetXCoordinates(),
                                    lattice->GetYCoordinates(),
                                    lattice->GetZCoordinates()};
      int at[3], counts[3];
      lattice->GetDimensions(counts);
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] = findInterval(*axes[axis], place[axis]);
      cell = vtkStructuredData::ComputeCellId(counts, at);
    }
    inside[i] = cell >= 0 && areUsed(cell, used, finder) ? 1 : 0;
  }
}

std::size_t
CellLocator::size() const
{
  return static_cast<std::size_t>(mesh_->GetNumberOfCells());
}

} // namespace pcl_uvol
