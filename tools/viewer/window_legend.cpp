// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/window_legend.h"

#include "charts/color_bar.h"
#include "charts/ground.h"

#include <vtkImageData.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace uvol_tools {

namespace {

constexpr std::size_t channels = 4;

/** Clear the pixels beside the columns of the bar which hold no letter. */
void
clearBeside(pcl_uvol::Image& image, const pcl_uvol::Image& ground, int columns)
{
  const auto free = image.width - static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    std::uint8_t* const pixel = &image.color[channels * i];
    if (i % image.width < free &&
        std::equal(pixel, pixel + channels, &ground.color[channels * i]))
      pixel[channels - 1] = 0;
  }
}

/** With rows upwards, as VTK has them. */
vtkNew<vtkImageData>
toVtk(const pcl_uvol::Image& image)
{
  vtkNew<vtkImageData> data;
  data->SetDimensions(static_cast<int>(image.width), static_cast<int>(image.height), 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, static_cast<int>(channels));
  const std::size_t row = channels * image.width;
  for (std::uint32_t i = 0; i < image.height; ++i)
    std::copy_n(&image.color[row * (image.height - 1 - i)],
                row,
                static_cast<std::uint8_t*>(data->GetScalarPointer()) + row * i);
  return data;
}

} // namespace

void
WindowLegend::addTo(vtkRenderer& renderer)
{
  mapper_->SetColorWindow(255.0); // bytes as they are
  mapper_->SetColorLevel(127.5);
  actor_->SetMapper(mapper_);
  actor_->VisibilityOff();
  renderer.AddViewProp(actor_);
}

void
WindowLegend::fit(vtkRenderer& renderer,
                  const ColorChoice& colors,
                  const pcl_uvol::Background& background)
{
  const int* const size = renderer.GetSize();
  if (is_drawn_ && size[0] == width_ && size[1] == height_)
    return;
  is_drawn_ = true;
  width_ = size[0];
  height_ = size[1];
  const int columns = colorBarWidth(width_, height_);
  actor_->SetVisibility(colors.hasLegend() && columns > 0);
  if (!actor_->GetVisibility())
    return;
  const pcl_uvol::Image ground = makeGround(background, width_, height_);
  pcl_uvol::Image image = ground;
  colors.drawLegend(image);
  clearBeside(image, ground, columns);
  mapper_->SetInputData(toVtk(image));
}

} // namespace uvol_tools
