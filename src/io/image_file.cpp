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
#include <cmath>
#include <string>
#include <zlib.h>

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

/** \throws InvalidArgument for a resolution that no file can say */
void
checkResolution(double dots_per_inch)
{
  constexpr double largest = 1e6;
  if (!(dots_per_inch == 0.0 || (dots_per_inch >= 1.0 && dots_per_inch <= largest)))
    throw InvalidArgument("A picture has 1 to a million dots per inch, or 0 where it "
                          "does not say how many, not " +
                          std::to_string(dots_per_inch) + ".");
}

void
appendBig(std::string& bytes, std::uint32_t number)
{
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(number >> shift);
}

/** The chunk of a PNG file that says how large its pixels are printed; VTK writes none.
 */
std::string
makeSizeChunk(double dots_per_inch)
{
  constexpr double meters_per_inch = 0.0254;
  const auto per_meter =
      static_cast<std::uint32_t>(std::lround(dots_per_inch / meters_per_inch));
  std::string body = "pHYs";
  appendBig(body, per_meter);
  appendBig(body, per_meter);
  body += '\1'; // the unit is the meter
  std::string chunk;
  appendBig(chunk, 9);
  chunk += body;
  appendBig(
      chunk,
      static_cast<std::uint32_t>(crc32(crc32(0, nullptr, 0),
                                       reinterpret_cast<const Bytef*>(body.data()),
                                       static_cast<uInt>(body.size()))));
  return chunk;
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
encodePng(const Image& image, const std::vector<ImageText>& texts, double dots_per_inch)
{
  checkResolution(dots_per_inch);
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
  std::vector<std::uint8_t> file(bytes->GetPointer(0),
                                 bytes->GetPointer(0) + bytes->GetNumberOfValues());
  if (dots_per_inch > 0.0) {
    constexpr std::ptrdiff_t header_bytes = 33; // of the signature and the first chunk
    const std::string chunk = makeSizeChunk(dots_per_inch);
    file.insert(file.begin() + header_bytes, chunk.begin(), chunk.end());
  }
  return file;
}

void
savePng(const std::string& path,
        const Image& image,
        const std::vector<ImageText>& texts,
        double dots_per_inch)
{
  checkPngPath(path);
  const std::vector<std::uint8_t> bytes = encodePng(image, texts, dots_per_inch);
  writeAtomically(path, [&](const std::string& file) {
    io::OutputFile target(file, path);
    target.write(bytes.data(), bytes.size());
    target.close();
  });
}

} // namespace pcl_uvol
