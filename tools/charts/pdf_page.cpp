// SPDX-License-Identifier: BSD-3-Clause
#include "charts/pdf_page.h"

#include <pcl_uvol/common/exceptions.h>

#include <cairo-pdf.h>
#include <cmath>
#include <memory>

namespace uvol_tools {

namespace {

using pcl_uvol::Image;
using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;

/** A page while it is drawn. */
class Page {
public:
  Page(std::string& pdf, double width, double height)
      : surface_(cairo_pdf_surface_create_for_stream(append, &pdf, width, height),
                 cairo_surface_destroy)
      , pen_(cairo_create(surface_.get()), cairo_destroy)
  {
    // The same picture has the same bytes whenever it is written.
    for (const auto date :
         {CAIRO_PDF_METADATA_CREATE_DATE, CAIRO_PDF_METADATA_MOD_DATE})
      cairo_pdf_surface_set_metadata(surface_.get(), date, "");
  }

  void
  describe(const std::vector<pcl_uvol::ImageText>& texts)
  {
    std::string all;
    for (const auto& [keyword, text] : texts)
      all.append(all.empty() ? "" : "; ").append(keyword).append(": ").append(text);
    cairo_pdf_surface_set_metadata(
        surface_.get(), CAIRO_PDF_METADATA_SUBJECT, all.c_str());
  }

  /** From here on places are pixels. */
  void
  scale(double points_per_pixel)
  {
    cairo_scale(pen_.get(), points_per_pixel, points_per_pixel);
  }

  void
  draw(const Image& image)
  {
    std::vector<unsigned char> pixels = premultiply(image);
    const auto width = static_cast<int>(image.width);
    const Surface source(
        cairo_image_surface_create_for_data(pixels.data(),
                                            CAIRO_FORMAT_ARGB32,
                                            width,
                                            static_cast<int>(image.height),
                                            4 * width),
        cairo_surface_destroy);
    cairo_set_source_surface(pen_.get(), source.get(), 0.0, 0.0);
    cairo_paint(pen_.get());
    cairo_surface_finish(source.get());
  }

  void
  write(const TextLine& line)
  {
    cairo_t* const pen = pen_.get();
    cairo_save(pen);
    cairo_select_font_face(
        pen, "Arial", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(pen, line.size);
    cairo_set_source_rgb(
        pen, line.ink[0] / 255.0, line.ink[1] / 255.0, line.ink[2] / 255.0);
    cairo_translate(pen, line.column + 0.5, line.row + 0.5);
    if (line.is_upright)
      cairo_rotate(pen, -0.5 * M_PI);
    cairo_text_extents_t extents{};
    cairo_text_extents(pen, line.text.c_str(), &extents);
    const double part = line.anchor == TextAnchor::Left     ? 0.0
                        : line.anchor == TextAnchor::Center ? 0.5
                                                            : 1.0;
    cairo_move_to(pen, -part * extents.x_advance, line.getBaseline());
    cairo_show_text(pen, line.text.c_str());
    cairo_restore(pen);
  }

  /** \throws IOError */
  void
  finish()
  {
    pen_.reset();
    cairo_surface_finish(surface_.get());
    const cairo_status_t status = cairo_surface_status(surface_.get());
    if (status != CAIRO_STATUS_SUCCESS)
      throw pcl_uvol::IOError(
          "page_not_made", {{"reason", std::string(cairo_status_to_string(status))}});
  }

private:
  static cairo_status_t
  append(void* to, const unsigned char* data, unsigned int length)
  {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  }

  /** Blue, green, red and opacity, as 32 bits of this machine. */
  static std::vector<unsigned char>
  premultiply(const Image& image)
  {
    std::vector<unsigned char> pixels(image.color.size());
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
      const int opacity = image.color[i + 3];
      for (std::size_t k = 0; k < 3; ++k)
        pixels[i + k] =
            static_cast<unsigned char>((image.color[i + 2 - k] * opacity + 127) / 255);
      pixels[i + 3] = image.color[i + 3];
    }
    return pixels;
  }

  Surface surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> pen_;
};

} // namespace

std::string
makePdf(const Image& image,
        const std::vector<TextLine>& lines,
        const std::vector<pcl_uvol::ImageText>& texts,
        double dots_per_inch)
{
  constexpr double points_per_inch = 72.0, of_screens = 96.0;
  const double points_per_pixel =
      points_per_inch / (dots_per_inch > 0.0 ? dots_per_inch : of_screens);
  std::string pdf;
  Page page(pdf, image.width * points_per_pixel, image.height * points_per_pixel);
  page.describe(texts);
  page.scale(points_per_pixel);
  page.draw(image);
  for (const TextLine& line : lines)
    page.write(line);
  page.finish();
  return pdf;
}

} // namespace uvol_tools
