// SPDX-License-Identifier: BSD-3-Clause
#include "paraview/representation/vtkUvolDiscActor.h"

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/filters/point_data.h>

#include <vtkAppendPolyData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>
#include <vtkUnsignedCharArray.h>

#include <memory>
#include <vector>

namespace {

/** The points of all blocks. */
vtkSmartPointer<vtkPolyData>
joinBlocks(vtkDataObject* data)
{
  std::vector<vtkPolyData*> blocks;
  if (auto* const single = vtkPolyData::SafeDownCast(data))
    blocks.push_back(single);
  if (auto* const composite = vtkCompositeDataSet::SafeDownCast(data)) {
    const auto block = vtk::TakeSmartPointer(composite->NewIterator());
    for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
      if (auto* const part = vtkPolyData::SafeDownCast(block->GetCurrentDataObject()))
        blocks.push_back(part);
  }
  if (blocks.size() == 1)
    return blocks.front();
  vtkNew<vtkAppendPolyData> all;
  for (vtkPolyData* const block : blocks)
    all->AddInputData(block);
  if (!blocks.empty())
    all->Update();
  return all->GetOutput();
}

bool
hasPointsOnly(vtkPolyData& data)
{
  return data.GetNumberOfVerts() == data.GetNumberOfCells();
}

pcl_uvol::Color
toColor(const double* rgb)
{
  return {static_cast<float>(rgb[0]),
          static_cast<float>(rgb[1]),
          static_cast<float>(rgb[2])};
}

} // namespace

vtkStandardNewMacro(vtkUvolDiscActor);

void
vtkUvolDiscActor::PrintSelf(std::ostream& out, vtkIndent indent)
{
  Superclass::PrintSelf(out, indent);
  discs_->PrintSelf(out, indent);
}

void
vtkUvolDiscActor::readInput()
{
  vtkDataObject* const input = Mapper ? Mapper->GetInputDataObject(0, 0) : nullptr;
  if (points_ && input == input_ && (input == nullptr || input->GetMTime() < read_))
    return;
  input_ = input;
  points_ = joinBlocks(input);
  read_.Modified();
}

void
vtkUvolDiscActor::convertPoints()
{
  if (converted_ > read_)
    return;
  converted_.Modified(); // also where it fails, which is to be told once
  discs_->setInputCloud(nullptr);
  if (points_->GetNumberOfPoints() == 0)
    return;
  const auto dataset =
      std::make_shared<pcl_uvol::Dataset>(pcl_uvol::toPointCloud(points_));
  origin_ = dataset->origin;
  discs_->setInputCloud({dataset, &dataset->cloud});
}

void
vtkUvolDiscActor::colorPoints()
{
  if (colored_ > converted_ && colored_ > Mapper->GetMTime())
    return;
  int is_of_cells = 0;
  vtkAbstractArray* const values =
      Mapper->GetScalarVisibility()
          ? vtkAbstractMapper::GetAbstractScalars(points_,
                                                  Mapper->GetScalarMode(),
                                                  Mapper->GetArrayAccessMode(),
                                                  Mapper->GetArrayId(),
                                                  Mapper->GetArrayName(),
                                                  is_of_cells)
          : nullptr;
  std::vector<pcl_uvol::Rgba> colors;
  if (values != nullptr &&
      values->GetNumberOfTuples() == points_->GetNumberOfPoints()) {
    const auto mapped = vtk::TakeSmartPointer(
        Mapper->GetLookupTable()->MapScalars(values, Mapper->GetColorMode(), -1));
    colors.resize(static_cast<std::size_t>(mapped->GetNumberOfTuples()));
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const unsigned char* const rgba = mapped->GetPointer(0) + 4 * i;
      colors[i] = rgba[0] | rgba[1] << 8U | rgba[2] << 16U;
    }
  }
  discs_->renderer().setPointColors(colors);
  colored_.Modified();
}

void
vtkUvolDiscActor::applyLook(vtkRenderer& renderer)
{
  vtkProperty& property = *GetProperty();
  settings().material.color = toColor(property.GetDiffuseColor());
  settings().background.color = toColor(renderer.GetBackground());
  const double opacity = property.GetOpacity();
  discs_->renderer().setOpacities(opacity < 1.0 ? std::vector<double>{opacity}
                                                : std::vector<double>());
  vtkNew<vtkMatrix4x4> shift, place;
  for (int axis = 0; axis < 3; ++axis)
    shift->SetElement(axis, 3, origin_[static_cast<std::size_t>(axis)]);
  vtkMatrix4x4::Multiply4x4(GetMatrix(), shift, place);
  discs_->SetUserMatrix(place);
}

int
vtkUvolDiscActor::RenderOpaqueGeometry(vtkViewport* viewport)
{
  auto* const renderer = vtkRenderer::SafeDownCast(viewport);
  readInput();
  if (renderer == nullptr || renderer->GetSelector() != nullptr ||
      !hasPointsOnly(*points_))
    return Superclass::RenderOpaqueGeometry(viewport);
  try {
    convertPoints();
    colorPoints();
  }
  catch (const pcl_uvol::Exception& error) {
    vtkErrorMacro(<< error.message());
    return 0;
  }
  applyLook(*renderer);
  return discs_->RenderOpaqueGeometry(viewport);
}

vtkTypeBool
vtkUvolDiscActor::HasTranslucentPolygonalGeometry()
{
  readInput();
  return hasPointsOnly(*points_) ? 0 : Superclass::HasTranslucentPolygonalGeometry();
}

void
vtkUvolDiscActor::ReleaseGraphicsResources(vtkWindow* window)
{
  discs_->ReleaseGraphicsResources(window);
  Superclass::ReleaseGraphicsResources(window);
}
