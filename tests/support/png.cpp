// SPDX-License-Identifier: BSD-3-Clause
#include "support/png.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

namespace uvol_test {

pcl_uvol::Image
readPng(const std::string& path, int& channels)
{
  pcl_uvol::Image image;
  channels = 0;
  vtkNew<vtkPNGReader> reader;
  if (reader->CanReadFile(path.c_str()) == 0)
    return image;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* const data = reader->GetOutput();
  channels = data->GetNumberOfScalarComponents();
  image.width = static_cast<std::uint32_t>(data->GetDimensions()[0]);
  image.height = static_cast<std::uint32_t>(data->GetDimensions()[1]);
  // VTK's first row is the lowest.
  for (int row = static_cast<int>(image.height) - 1; row >= 0; --row)
    for (int column = 0; column < static_cast<int>(image.width); ++column)
      for (int k = 0; k < 4; ++k)
        image.color.push_back(
            k < channels ? static_cast<std::uint8_t>(
                               data->GetScalarComponentAsDouble(column, row, 0, k))
                         : std::uint8_t(255));
  return image;
}

} // namespace uvol_test
