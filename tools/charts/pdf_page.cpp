// SPDX-License-Identifier: BSD-3-Clause
#include "charts/pdf_page.h"

#include "common/shared_library.h"
#include <pcl_uvol/common/exceptions.h>

#include <cmath>
#include <memory>

namespace uvol_tools {

namespace {

using pcl_uvol::Image;
using pcl_uvol::IOError;

// What of cairo 1.16 and later is needed; its headers are not.

/** cairo_surface_t and cairo_t. @{ */
struct CairoSurface;
struct CairoPen;
/** @} */

/** cairo_text_extents_t */
struct TextExtents {
  double x_bearing, y_bearing, width, height, x_advance, y_advance;
};

enum Metadata { subject = 2, create_date = 5, modification_date = 6 };
constexpr int argb32 = 0, no_slant = 0, no_weight = 0, success = 0;

using Write = int (*)(void* to, const unsigned char* data, unsigned int length);

struct Cairo {
  CairoSurface* (*createPage)(Write write, void* to, double width, double height);
  CairoSurface* (*wrapImage)(
      unsigned char* data, int format, int width, int height, int stride);
  void (*setMetadata)(CairoSurface*, int metadata, const char* text);
  void (*finish)(CairoSurface*);
  void (*destroySurface)(CairoSurface*);
  int (*getStatus)(CairoSurface*);
  const char* (*describe)(int status);
  CairoPen* (*createPen)(CairoSurface*);
  void (*destroyPen)(CairoPen*);
  void (*save)(CairoPen*);
  void (*restore)(CairoPen*);
  void (*scale)(CairoPen*, double x, double y);
  void (*translate)(CairoPen*, double x, double y);
  void (*rotate)(CairoPen*, double angle);
  void (*moveTo)(CairoPen*, double x, double y);
  void (*setSource)(CairoPen*, CairoSurface*, double x, double y);
  void (*setColor)(CairoPen*, double red, double green, double blue);
  void (*paint)(CairoPen*);
  void (*setFont)(CairoPen*, const char* family, int slant, int weight);
  void (*setFontSize)(CairoPen*, double size);
  void (*measure)(CairoPen*, const char* text, TextExtents*);
  void (*write)(CairoPen*, const char* text);

  explicit Cairo(const pcl_uvol::SharedLibrary& library)
  {
    library.load("cairo_pdf_surface_create_for_stream", createPage);
    library.load("cairo_image_surface_create_for_data", wrapImage);
    library.load("cairo_pdf_surface_set_metadata", setMetadata);
    library.load("cairo_surface_finish", finish);
    library.load("cairo_surface_destroy", destroySurface);
    library.load("cairo_surface_status", getStatus);
    library.load("cairo_status_to_string", describe);
    library.load("cairo_create", createPen);
    library.load("cairo_destroy", destroyPen);
    library.load("cairo_save", save);
    library.load("cairo_restore", restore);
    library.load("cairo_scale", scale);
    library.load("cairo_translate", translate);
    library.load("cairo_rotate", rotate);
    library.load("cairo_move_to", moveTo);
    library.load("cairo_set_source_surface", setSource);
    library.load("cairo_set_source_rgb", setColor);
    library.load("cairo_paint", paint);
    library.load("cairo_select_font_face", setFont);
    library.load("cairo_set_font_size", setFontSize);
    library.load("cairo_text_extents", measure);
    library.load("cairo_show_text", write);
  }
};

Cairo
loadCairo()
{
  try {
    return Cairo(
        pcl_uvol::SharedLibrary({"libcairo.so.2"}, "install libcairo2, or write .svg"));
  }
  catch (const pcl_uvol::MissingLibrary& error) {
    throw IOError(error.message());
  }
}

/** A page while it is drawn. */
class Page {
public:
  Page(const Cairo& cairo, std::string& pdf, double width, double height)
      : cairo_(cairo)
      , surface_(cairo.createPage(append, &pdf, width, height), cairo.destroySurface)
      , pen_(cairo.createPen(surface_.get()), cairo.destroyPen)
  {
    // The same picture has the same bytes whenever it is written.
    for (const Metadata date : {create_date, modification_date})
      cairo.setMetadata(surface_.get(), date, "");
  }

  void
  describe(const std::vector<pcl_uvol::ImageText>& texts)
  {
    std::string all;
    for (const auto& [keyword, text] : texts)
      all += (all.empty() ? "" : "; ") + keyword + ": " + text;
    cairo_.setMetadata(surface_.get(), subject, all.c_str());
  }

  /** From here on places are pixels. */
  void
  scale(double points_per_pixel)
  {
    cairo_.scale(pen_.get(), points_per_pixel, points_per_pixel);
  }

  void
  draw(const Image& image)
  {
    std::vector<unsigned char> pixels = premultiply(image);
    const auto width = static_cast<int>(image.width);
    const Surface source(
        cairo_.wrapImage(
            pixels.data(), argb32, width, static_cast<int>(image.height), 4 * width),
        cairo_.destroySurface);
    cairo_.setSource(pen_.get(), source.get(), 0.0, 0.0);
    cairo_.paint(pen_.get());
    cairo_.finish(source.get());
  }

  void
  write(const TextLine& line)
  {
    CairoPen* const pen = pen_.get();
    cairo_.save(pen);
    cairo_.setFont(pen, "Arial", no_slant, no_weight);
    cairo_.setFontSize(pen, line.size);
    cairo_.setColor(pen, line.ink[0] / 255.0, line.ink[1] / 255.0, line.ink[2] / 255.0);
    cairo_.translate(pen, line.column + 0.5, line.row + 0.5);
    if (line.is_upright)
      cairo_.rotate(pen, -0.5 * M_PI);
    TextExtents extents{};
    cairo_.measure(pen, line.text.c_str(), &extents);
    const double part = line.anchor == TextAnchor::Left     ? 0.0
                        : line.anchor == TextAnchor::Center ? 0.5
                                                            : 1.0;
    cairo_.moveTo(pen, -part * extents.x_advance, line.getBaseline());
    cairo_.write(pen, line.text.c_str());
    cairo_.restore(pen);
  }

  /** \throws IOError */
  void
  finish()
  {
    pen_.reset();
    cairo_.finish(surface_.get());
    const int status = cairo_.getStatus(surface_.get());
    if (status != success)
      throw IOError(std::string("Cannot make a page: ") + cairo_.describe(status) +
                    ".");
  }

private:
  using Surface = std::unique_ptr<CairoSurface, void (*)(CairoSurface*)>;

  static int
  append(void* to, const unsigned char* data, unsigned int length)
  {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return success;
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

  const Cairo& cairo_;
  Surface surface_;
  std::unique_ptr<CairoPen, void (*)(CairoPen*)> pen_;
};

} // namespace

void
checkPdf()
{
  loadCairo();
}

std::string
makePdf(const Image& image,
        const std::vector<TextLine>& lines,
        const std::vector<pcl_uvol::ImageText>& texts,
        double dots_per_inch)
{
  constexpr double points_per_inch = 72.0, of_screens = 96.0;
  const double points_per_pixel =
      points_per_inch / (dots_per_inch > 0.0 ? dots_per_inch : of_screens);
  const Cairo cairo = loadCairo();
  std::string pdf;
  Page page(
      cairo, pdf, image.width * points_per_pixel, image.height * points_per_pixel);
  page.describe(texts);
  page.scale(points_per_pixel);
  page.draw(image);
  for (const TextLine& line : lines)
    page.write(line);
  page.finish();
  return pdf;
}

} // namespace uvol_tools
