// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/color_choice.h"

#include "viewer/shown_surface.h"

#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkScalarBarActor.h>

namespace uvol_tools {

namespace {

bool
isScalar(const std::string& color)
{
  return !color.empty() && color != "rgb" && color != "rgba";
}

void
fill(vtkLookupTable& table, const pcl_uvol::ColorMap& map)
{
  constexpr int steps = 256;
  table.SetNumberOfTableValues(steps);
  for (int i = 0; i < steps; ++i) {
    const pcl_uvol::Color color = map.at(i / (steps - 1.0));
    table.SetTableValue(i, color.r, color.g, color.b);
  }
}

} // namespace

ColorChoice::ColorChoice(const RenderOptions& look, const pcl::PCLPointCloud2& cloud)
    : look_(look)
    , fields_{look.colorField(pcl_uvol::viewOf(cloud))}
{
  if (!getField().empty())
    fields_.emplace_back();
  for (const auto& field : cloud.fields) {
    const bool is_geometry =
        field.name.size() == 1 || field.name.rfind("normal_", 0) == 0;
    if (!is_geometry && field.count == 1 && field.name != fields_[0])
      fields_.push_back(field.name);
  }
}

void
ColorChoice::next()
{
  chosen_ = (chosen_ + 1) % fields_.size();
}

void
ColorChoice::apply(const pcl::PCLPointCloud2& cloud,
                   pcl_uvol::ImageSpaceRendererBase& renderer,
                   vtkScalarBarActor& bar) const
{
  const std::string& field = getField();
  renderer.setColorField("");
  bar.VisibilityOff();
  if (isScalar(field)) {
    const auto fixed = look_.getRange();
    const auto range = chosen_ == 0 && fixed ? *fixed : findRange(cloud, field);
    renderer.setColorRange(range[0], range[1]);
    vtkNew<vtkLookupTable> table;
    fill(*table, look_.colorMap());
    table->SetTableRange(range[0], range[1]);
    bar.SetLookupTable(table);
    bar.SetTitle(field.c_str());
    bar.SetVisibility(look_.hasBar());
  }
  renderer.setColorField(field);
}

} // namespace uvol_tools
