// SPDX-License-Identifier: BSD-3-Clause
#include "charts/picture_file.h"

#include "charts/pdf_page.h"
#include "io/files.h"
#include <pcl_uvol/io/dataset.h>

#include <fstream>
#include <sstream>

namespace uvol_tools {

namespace {

using pcl_uvol::Image;

/** True for files whose letters are text. @{ */
bool
isSvg(const std::string& path)
{
  return pcl_uvol::io::getEnding(path) == ".svg";
}

bool
isPdf(const std::string& path)
{
  return pcl_uvol::io::getEnding(path) == ".pdf";
}
/** @} */

std::string
escape(const std::string& text)
{
  std::string escaped;
  for (const char letter : text)
    switch (letter) {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    default:
      // XML has no control characters.
      escaped += static_cast<unsigned char>(letter) < ' ' ? ' ' : letter;
    }
  return escaped;
}

const char*
describe(TextAnchor anchor)
{
  switch (anchor) {
  case TextAnchor::Left:
    return "start";
  case TextAnchor::Right:
    return "end";
  default:
    return "middle";
  }
}

void
writeLine(const TextLine& line, std::ostream& out)
{
  out << "<text font-size=\"" << line.size << "\" text-anchor=\""
      << describe(line.anchor) << "\" fill=\"" << describeColor(line.ink)
      << "\" transform=\"translate(" << line.column + 0.5 << ' ' << line.row + 0.5
      << ')' << (line.is_upright ? " rotate(-90)" : "") << "\" y=\""
      << line.getBaseline() << "\">" << escape(line.text) << "</text>\n";
}

/** As SVG takes it: in pixels, or as long as these are printed. */
std::string
writeLength(std::uint32_t pixels, double dots_per_inch)
{
  std::ostringstream text;
  if (dots_per_inch > 0.0)
    text << pixels / dots_per_inch << "in";
  else
    text << pixels;
  return text.str();
}

std::string
makeSvg(const Image& image,
        const std::vector<TextLine>& lines,
        const std::vector<pcl_uvol::ImageText>& texts,
        double dots_per_inch)
{
  const std::vector<std::uint8_t> png = encodePng(image);
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\""
      << writeLength(image.width, dots_per_inch) << "\" height=\""
      << writeLength(image.height, dots_per_inch) << "\" viewBox=\"0 0 " << image.width
      << ' ' << image.height
      << "\" font-family=\"Arial, Helvetica, sans-serif\">\n<desc>";
  for (const auto& [keyword, text] : texts)
    out << escape(keyword) << ": " << escape(text) << '\n';
  out << "</desc>\n<image width=\"" << image.width << "\" height=\"" << image.height
      << "\" href=\"data:image/png;base64," << encodeBase64(png.data(), png.size())
      << "\"/>\n";
  for (const TextLine& line : lines)
    writeLine(line, out);
  out << "</svg>\n";
  return out.str();
}

} // namespace

std::string
encodeBase64(const void* bytes, std::size_t count)
{
  constexpr const char* digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* const from = static_cast<const unsigned char*>(bytes);
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (std::size_t i = 0; i < count; i += 3) {
    unsigned group = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      group = group << 8 | (k < count ? from[k] : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

namespace {

/** \param endings of files that are written, for the message about others */
void
checkPath(const std::string& path, const char* endings)
{
  if (isSvg(path) || isPdf(path))
    pcl_uvol::io::checkWritable(path);
  else if (pcl_uvol::io::getEnding(path) == ".png")
    pcl_uvol::checkPngPath(path);
  else
    pcl_uvol::io::throwUnwritable(path, {"unwritten_ending", "images", endings});
}

} // namespace

void
checkPicturePath(const std::string& path)
{
  checkPath(path, ".png, .svg or .pdf");
}

void
checkDrawingPath(const std::string& path)
{
  checkPath(path, ".png, .svg or .pdf, and web pages as .html");
}

PictureFile::PictureFile(const std::string& path, double dots_per_inch)
    : path_(path)
    , dots_per_inch_(dots_per_inch)
{
  if (isSvg(path) || isPdf(path))
    letters_.emplace();
}

void
PictureFile::save(const Image& picture,
                  const std::vector<pcl_uvol::ImageText>& texts) const
{
  if (!letters_) {
    pcl_uvol::savePng(path_, picture, texts, dots_per_inch_);
    return;
  }
  const auto make = isPdf(path_) ? makePdf : makeSvg;
  const std::string page = make(picture, letters_->getLines(), texts, dots_per_inch_);
  pcl_uvol::writeAtomically(path_, [&](const std::string& file) {
    std::ofstream stream(file, std::ios::binary);
    stream << page;
    stream.close();
    if (!stream)
      pcl_uvol::io::throwUnwritable(path_, "full_disk");
  });
}

} // namespace uvol_tools
