// SPDX-License-Identifier: BSD-3-Clause
// Text as pixels, in the font that VTK brings along: the same on every machine.
#include "io_vtk/entries.h"
#include "io_vtk/vtk_messages.h"

#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <mutex>

namespace pcl_uvol {
namespace io {

Letters
drawLetters(const std::string& text, int size)
{
  vtkNew<vtkTextProperty> font;
  font->SetFontSize(size);
  font->SetFontFamilyToArial();
  font->SetColor(1.0, 1.0, 1.0);
  vtkNew<vtkImageData> image;
  int extent[2];
  constexpr int dpi = 72;
  // VTK's letters are those of one object, which serves one caller at a time.
  static std::mutex only_one;
  const std::lock_guard<std::mutex> lock(only_one);
  const VtkMessages messages;
  Letters letters;
  if (!vtkFreeTypeTools::GetInstance()->RenderString(
          font, vtkStdString(text), dpi, image, extent))
    return letters;
  letters.width = extent[0];
  letters.height = extent[1];
  for (int y = 0; y < letters.height; ++y)
    for (int x = 0; x < letters.width; ++x) {
      const auto* const pixel = // blanks have a width, and may have no pixels
          static_cast<const std::uint8_t*>(image->GetScalarPointer(x, y, 0));
      letters.opacities.push_back(pixel == nullptr ? 0 : pixel[3]);
    }
  return letters;
}

} // namespace io
} // namespace pcl_uvol
