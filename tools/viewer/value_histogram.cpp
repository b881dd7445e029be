// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/value_histogram.h"

#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace uvol_tools {

namespace {

constexpr std::size_t bins = 80;

std::array<std::uint64_t, bins>
countValues(const std::vector<double>& values, const pcl_uvol::ColorScale& scale)
{
  std::array<std::uint64_t, bins> counts{};
  for (const double value : values) {
    const double place = scale.placeOf(value);
    if (place >= 0.0 && place <= 1.0)
      ++counts[std::min(bins - 1, static_cast<std::size_t>(bins * place))];
  }
  return counts;
}

} // namespace

vtkSmartPointer<vtkActor2D>
drawHistogram(const std::vector<double>& values,
              const pcl_uvol::ColorScale& scale,
              const std::array<double, 4>& corners)
{
  const auto counts = countValues(values, scale);
  const double highest =
      std::log1p(static_cast<double>(*std::max_element(counts.begin(), counts.end())));
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> bars;
  const double width = (corners[2] - corners[0]) / bins;
  for (std::size_t i = 0; i < bins; ++i) {
    if (counts[i] == 0)
      continue;
    const double left = corners[0] + static_cast<double>(i) * width,
                 top = corners[1] + (corners[3] - corners[1]) *
                                        std::log1p(static_cast<double>(counts[i])) /
                                        highest;
    const vtkIdType first = points->InsertNextPoint(left, corners[1], 0.0);
    points->InsertNextPoint(left + width, corners[1], 0.0);
    points->InsertNextPoint(left + width, top, 0.0);
    points->InsertNextPoint(left, top, 0.0);
    bars->InsertNextCell({first, first + 1, first + 2, first + 3});
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(bars);
  vtkNew<vtkCoordinate> viewport;
  viewport->SetCoordinateSystemToNormalizedViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape);
  mapper->SetTransformCoordinate(viewport);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.5, 0.55, 0.65);
  actor->GetProperty()->SetOpacity(0.4);
  return actor;
}

} // namespace uvol_tools
