// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/color_choice.h"

#include "charts/color_bar.h"
#include "render/point_colors.h"

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

/** The colours of a bar. */
void
fill(vtkLookupTable& table,
     const pcl_uvol::ColorMapping& mapping,
     const pcl_uvol::ColorScale& scale,
     const std::vector<pcl_uvol::CategoryColor>& categories)
{
  const auto set = [&table](vtkIdType i, const pcl_uvol::Color& color) {
    table.SetTableValue(i, color.r, color.g, color.b);
  };
  if (!categories.empty()) {
    const auto count = static_cast<vtkIdType>(categories.size());
    table.SetNumberOfTableValues(count);
    table.IndexedLookupOn();
    for (vtkIdType i = 0; i < count; ++i) {
      const auto& [category, color] = categories[static_cast<std::size_t>(i)];
      table.SetAnnotation(category, shortNumber(category));
      set(i, color);
    }
    return;
  }
  constexpr int steps = 256;
  table.SetNumberOfTableValues(steps);
  for (int i = 0; i < steps; ++i)
    set(i, mapping.map.at(i / (steps - 1.0)));
  table.SetScale(scale.is_logarithmic ? VTK_SCALE_LOG10 : VTK_SCALE_LINEAR);
  table.SetTableRange(scale.low, scale.high);
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
    const pcl_uvol::CloudView view = pcl_uvol::viewOf(cloud);
    pcl_uvol::ColorMapping mapping = look_.getColors().mapFor(view, field);
    if (chosen_ != 0) // the range of the options is that of their field
      mapping.range.reset();
    const pcl_uvol::ColorScale scale = findColorScale(view, field, mapping);
    renderer.setColorMap(mapping.map);
    renderer.setLogarithmicColors(mapping.is_logarithmic);
    renderer.setColorRange(scale.low, scale.high);
    vtkNew<vtkLookupTable> table;
    fill(*table,
         mapping,
         scale,
         mapping.map.isCategorical()
             ? pcl_uvol::colorCategories(view, field, mapping.map, most_categories)
             : std::vector<pcl_uvol::CategoryColor>());
    bar.SetLookupTable(table);
    bar.SetTitle(field.c_str());
    bar.SetVisibility(look_.hasBar());
  }
  renderer.setColorField(field);
}

} // namespace uvol_tools
