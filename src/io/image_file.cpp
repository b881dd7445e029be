// SPDX-License-Identifier: BSD-3-Clause
#include "io/files.h"
#include "io/vtk_messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>

#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace pcl_uvol {

namespace {

/** VTK's first row is the lowest. */
vtkNew<vtkImageData>
toVtk(const Image& image, int channels)
{
  vtkNew<vtkImageData> data;
  data->SetDimensions(static_cast<int>(image.width), static_cast<int>(image.height), 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  auto* target = static_cast<std::uint8_t*>(data->GetScalarPointer());
  for (std::size_t row = image.height; row-- > 0;)
    for (std::size_t column = 0; column < image.width; ++column)
      target =
          std::copy_n(&image.color[4 * (row * image.width + column)], channels, target);
  return data;
}

bool
isOpaque(const Image& image)
{
  for (std::size_t i = 3; i < image.color.size(); i += 4)
    if (image.color[i] != 255)
      return false;
  return true;
}

} // namespace

void
checkPngPath(const std::string& path)
{
  if (io::getEnding(path) != ".png")
    io::throwUnwritable(path, "pictures are written as .png");
  io::checkWritable(path);
}

std::vector<std::uint8_t>
encodePng(const Image& image, const std::vector<ImageText>& texts)
{
  if (image.color.size() != 4 * image.pixels() || image.pixels() == 0)
    throw InvalidArgument("The image has no pixels.");
  const auto data = toVtk(image, isOpaque(image) ? 3 : 4);
  const io::VtkMessages messages;
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->WriteToMemoryOn();
  for (const auto& [keyword, text] : texts)
    writer->AddText(keyword.c_str(), text.c_str());
  writer->Write();
  vtkUnsignedCharArray* const bytes = writer->GetResult();
  if (bytes == nullptr || !messages.getError().empty())
    throw IOError("VTK could not encode a picture: " + messages.getError());
  return {bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues()};
}

void
savePng(const std::string& path,
        const Image& image,
        const std::vector<ImageText>& texts)
{
  checkPngPath(path);
  const std::vector<std::uint8_t> bytes = encodePng(image, texts);
  writeAtomically(path, [&](const std::string& file) {
    io::OutputFile target(file, path);
    target.write(bytes.data(), bytes.size());
    target.close();
  });
}

} // namespace pcl_uvol
