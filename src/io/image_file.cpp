// SPDX-License-Identifier: BSD-3-Clause
#include "io/files.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <png.h>
#include <string>

namespace pcl_uvol {

namespace {

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
    throw InvalidArgument("resolution_not_allowed", {{"resolution", dots_per_inch}});
}

/** A file of libpng in memory. */
class PngWriter {
public:
  /** libpng's own way back from an error, longjmp(), would pass over destructors. */
  PngWriter()
      : png_(png_create_write_struct(
            PNG_LIBPNG_VER_STRING,
            nullptr,
            [](png_structp, png_const_charp message) {
              throw IOError("png_not_encoded", {{"reason", message}});
            },
            [](png_structp, png_const_charp) {}))
      , info_(png_ == nullptr ? nullptr : png_create_info_struct(png_))
  {
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
  }

  PngWriter(const PngWriter&) = delete;
  PngWriter&
  operator=(const PngWriter&) = delete;

  ~PngWriter()
  {
    png_destroy_write_struct(&png_, &info_);
  }

  std::vector<std::uint8_t>
  write(const Image& image,
        const std::vector<ImageText>& texts,
        double dots_per_inch) const
  {
    std::vector<std::uint8_t> file;
    png_set_write_fn(
        png_,
        &file,
        [](png_structp png, png_bytep bytes, std::size_t count) {
          auto& target = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
          target.insert(target.end(), bytes, bytes + count);
        },
        nullptr);
    constexpr int level =
        5; // that of VTK's writer, so that files are those of older versions
    png_set_compression_level(png_, level);
    const bool opaque = isOpaque(image);
    png_set_IHDR(png_,
                 info_,
                 static_cast<png_uint_32>(image.width),
                 static_cast<png_uint_32>(image.height),
                 8,
                 opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA,
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (dots_per_inch > 0.0) {
      constexpr double meters_per_inch = 0.0254;
      const auto per_meter =
          static_cast<png_uint_32>(std::lround(dots_per_inch / meters_per_inch));
      png_set_pHYs(png_, info_, per_meter, per_meter, PNG_RESOLUTION_METER);
    }
    for (const auto& [keyword, text] : texts) {
      png_text entry{};
      entry.compression = PNG_TEXT_COMPRESSION_NONE;
      entry.key = const_cast<char*>(keyword.c_str());
      entry.text = const_cast<char*>(text.c_str());
      entry.text_length = text.size();
      png_set_text(png_, info_, &entry, 1);
    }
    png_write_info(png_, info_);
    if (opaque)
      png_set_filler(png_, 0, PNG_FILLER_AFTER); // the fourth byte is no opacity
    for (std::size_t row = 0; row < image.height; ++row)
      png_write_row(png_, &image.color[4 * row * image.width]);
    png_write_end(png_, info_);
    return file;
  }

private:
  png_structp png_;
  png_infop info_;
};

} // namespace

void
checkPngPath(const std::string& path)
{
  if (io::getEnding(path) != ".png")
    io::throwUnwritable(path, {"unwritten_ending", "images", ".png"});
  io::checkWritable(path);
}

std::vector<std::uint8_t>
encodePng(const Image& image, const std::vector<ImageText>& texts, double dots_per_inch)
{
  checkResolution(dots_per_inch);
  if (image.color.size() != 4 * image.pixels() || image.pixels() == 0)
    throw InvalidArgument("image_without_pixels", {});
  return PngWriter().write(image, texts, dots_per_inch);
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
