// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/color_choice.h"

#include "charts/color_bar.h"
#include "common/scalar_field.h"
#include "render/point_colors.h"

#include <string>

namespace uvol_tools {

namespace {

bool
isScalar(const std::string& color)
{
  return !color.empty() && color != "rgb" && color != "rgba";
}

/** The colours of a mesh. */
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
    table.ResetAnnotations();
    table.IndexedLookupOn();
    for (vtkIdType i = 0; i < count; ++i) {
      const pcl_uvol::CategoryColor& category = categories[static_cast<std::size_t>(i)];
      table.SetAnnotation(category.value, describeCategory(category));
      set(i, category.color);
    }
    return;
  }
  constexpr int steps = 256;
  table.ResetAnnotations();
  table.IndexedLookupOff();
  table.SetNumberOfTableValues(steps);
  for (int i = 0; i < steps; ++i)
    set(i, mapping.map.at(i / (steps - 1.0)));
  table.SetScale(scale.is_logarithmic ? VTK_SCALE_LOG10 : VTK_SCALE_LINEAR);
  table.SetTableRange(scale.low, scale.high);
}

/** What can colour a surface: scalars, and lengths of vectors. */
std::vector<std::string>
listScalars(const pcl::PCLPointCloud2& cloud)
{
  std::vector<std::string> names;
  for (const auto& field : cloud.fields) {
    const bool is_geometry = field.name == "x" || field.name == "y" ||
                             field.name == "z" || field.name.rfind("normal_", 0) == 0;
    if (!is_geometry && field.name != "rgb" && field.name != "rgba")
      names.push_back(field.count == 1 ? field.name : "|" + field.name + "|");
  }
  return names;
}

/** A field of one value, or of none. */
bool
isConstant(const pcl::PCLPointCloud2& cloud, const std::string& name)
{
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(cloud);
  const pcl_uvol::ScalarField field(view.fields, name);
  pcl_uvol::ColorScaleFinder finder(false);
  for (std::size_t i = 0; i < view.count; ++i)
    finder.add(field.read(view.point(i)));
  const auto scale = finder.find();
  return !scale || scale->low == scale->high;
}

} // namespace

ColorChoice::ColorChoice(const RenderOptions& look, const pcl::PCLPointCloud2& cloud)
    : look_(look)
    , fields_{look.colorField(pcl_uvol::viewOf(cloud)), ""}
{
  std::vector<std::string> constant;
  for (const std::string& name : listScalars(cloud))
    (isConstant(cloud, name) ? constant : fields_).push_back(name);
  fields_.insert(fields_.end(), constant.begin(), constant.end());
}

void
ColorChoice::next()
{
  do
    chosen_ = (chosen_ + 1) % fields_.size();
  while (chosen_ != 0 && fields_[chosen_] == fields_[0]);
}

bool
ColorChoice::hasScale() const
{
  return isScalar(getField());
}

void
ColorChoice::apply(const pcl::PCLPointCloud2& cloud,
                   pcl_uvol::ImageSpaceRendererBase& renderer)
{
  fields_[0] = look_.colorField(pcl_uvol::viewOf(cloud));
  const std::string& field = getField();
  renderer.setColorField("");
  legend_ = Legend();
  if (isScalar(field)) {
    const pcl_uvol::CloudView view = pcl_uvol::viewOf(cloud);
    pcl_uvol::ColorMapping mapping = look_.mapColors(view, field);
    if (chosen_ != 0) // the range of the options is that of their field
      mapping.range.reset();
    const pcl_uvol::ColorScale scale = findColorScale(view, field, mapping);
    renderer.setColorMap(mapping.map);
    renderer.setLogarithmicColors(mapping.is_logarithmic);
    renderer.setColorRange(scale.low, scale.high);
    legend_ = {mapping, scale, {}, true};
    legend_.categories =
        listNamedCategories(view, look_.getLabels(), field, mapping.map);
    fill(*table_, mapping, scale, legend_.categories);
  }
  renderer.setColorField(field);
}

std::vector<pcl_uvol::Rgba>
ColorChoice::colorPoints(const pcl::PCLPointCloud2& cloud) const
{
  if (getField().empty())
    return {};
  pcl_uvol::ColorMapping mapping = legend_.mapping;
  mapping.range = {legend_.scale.low, legend_.scale.high};
  return pcl_uvol::colorPoints(pcl_uvol::viewOf(cloud), getField(), mapping).colors;
}

bool
ColorChoice::hasLegend() const
{
  return legend_.is_known && look_.hasBar();
}

void
ColorChoice::drawLegend(pcl_uvol::Image& image) const
{
  if (!hasLegend())
    return;
  const std::string& title = look_.getColors().getLabel(getField());
  if (legend_.categories.empty())
    drawColorBar(image, legend_.mapping.map, legend_.scale, title);
  else
    drawCategories(image, legend_.categories, title);
}

void
ColorChoice::colorLike(pcl_uvol::ImageSpaceRendererBase& renderer) const
{
  renderer.setColorField(getField());
  renderer.setColorMap(legend_.mapping.map);
  renderer.setLogarithmicColors(legend_.mapping.is_logarithmic);
  renderer.setColorRange(legend_.scale.low, legend_.scale.high);
}

} // namespace uvol_tools
