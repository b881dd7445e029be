// SPDX-License-Identifier: BSD-3-Clause
// What a VTK window shows.
#pragma once

#include <pcl_uvol/render/renderer.h>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

namespace uvol_test {

/** \brief Render a window and read its colours back.
 * \param scale tiles in each direction, each as large as the window */
inline pcl_uvol::Image
screenshot(vtkRenderWindow& window, int scale = 1)
{
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(&window);
  filter->SetScale(scale);
  filter->SetInputBufferTypeToRGBA();
  filter->ReadFrontBufferOff();
  filter->Update();
  vtkImageData* const data = filter->GetOutput();
  pcl_uvol::Image image;
  image.width = static_cast<std::uint32_t>(data->GetDimensions()[0]);
  image.height = static_cast<std::uint32_t>(data->GetDimensions()[1]);
  image.color.reserve(4 * image.pixels());
  for (int row = static_cast<int>(image.height) - 1; row >= 0; --row) {
    const auto* const pixels =
        static_cast<const std::uint8_t*>(data->GetScalarPointer(0, row, 0));
    image.color.insert(image.color.end(), pixels, pixels + 4 * image.width);
  }
  return image;
}

} // namespace uvol_test
