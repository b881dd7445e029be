// SPDX-License-Identifier: BSD-3-Clause
// Letters and lines over the pixels of an image.
#pragma once

#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace uvol_tools {

using Ink = std::array<std::uint8_t, 3>;

constexpr Ink black{0, 0, 0};

/** \brief A colour rounded to 8 bits. */
Ink
inkOf(const pcl_uvol::Color& color);

/** \brief "#rrggbb". */
std::string
describeColor(const Ink& ink);

/** \brief Lay a color over a pixel; nothing outside the image. */
void
blend(pcl_uvol::Image& image, int column, int row, const Ink& ink, double opacity);

/** \brief The nearest pixel. */
inline int
rounded(double pixel)
{
  return static_cast<int>(std::lround(pixel));
}

/** \brief Size of letters in a picture of that many rows, pixels.
 * \param least smaller ones could not be read */
int
letterSize(int height, int least = 0);

/** \brief Black or white: what can be read on the image's upper right corner. */
Ink
inkOn(const pcl_uvol::Image& image);

enum class TextAnchor { Left, Center, Right };

/** \brief A line of text in a picture. */
struct TextLine {
  std::string text;
  int size;        ///< of the font, pixels
  int column, row; ///< of the anchor, in the middle of the letters' height
  TextAnchor anchor;
  bool is_upright; ///< it runs upwards
  Ink ink;

  /** \brief How far the foot of the letters lies below the anchor, pixels. */
  double
  getBaseline() const
  {
    return 0.35 * size; // digits and capitals are 0.7 of the font's size
  }
};

/** \brief The width of a line of text, pixels. */
int
measureText(const std::string& text, int size);

/** \brief The pixels of a line. */
Eigen::AlignedBox2d
boxAround(const TextLine& line);

/** \brief While it lives, the lines of text of its thread are kept instead of drawn:
 * for pictures whose letters stay letters. */
class TextKeeper {
public:
  TextKeeper();
  ~TextKeeper();
  TextKeeper(const TextKeeper&) = delete;
  TextKeeper&
  operator=(const TextKeeper&) = delete;

  const std::vector<TextLine>&
  getLines() const
  {
    return lines_;
  }

  /** \brief Keep a line; false where none of this thread keeps lines. */
  static bool
  keep(const TextLine& line);

private:
  std::vector<TextLine> lines_;
  TextKeeper* outer_;
};

/** \brief Write a line of text around a row.
 * \param size of the font, pixels
 * \param column of the anchor
 * \return its width, pixels */
int
writeText(pcl_uvol::Image& image,
          const std::string& text,
          int size,
          int column,
          int row,
          TextAnchor anchor,
          const Ink& ink);

/** \brief Write a line of text that runs upwards, centred at a pixel. */
void
writeUpwards(pcl_uvol::Image& image,
             const std::string& text,
             int size,
             int column,
             int row,
             const Ink& ink);

/** \brief Write a line where it stands. */
void
writeLine(pcl_uvol::Image& image, const TextLine& line);

/** \brief Visit the pixels that a straight line with soft edges covers, whole or in
 * part; coordinates of pixel centres are whole. */
void
forLinePixels(double x0,
              double y0,
              double x1,
              double y1,
              double width,
              const std::function<void(int column, int row, double opacity)>& visit);

/** \brief Draw a straight line with soft edges; coordinates of pixel centres are whole.
 */
void
drawLine(pcl_uvol::Image& image,
         double x0,
         double y0,
         double x1,
         double y1,
         double width,
         const Ink& ink);

/** \brief At most four digits. */
std::string
shortNumber(double value);

/** \brief Digits with which some five values along an axis differ, and its ends are
 * shown to a hundredth of the range. */
int
countDigits(double low, double high);

/** \brief Texts of the values along an axis. */
struct AxisLabels {
  std::vector<std::string> texts;
  /** What is to be added to all of them, as "+ 1.6e9"; empty for nothing. */
  std::string offset;
};

/** \brief As many digits as tell the values apart; where these are too many, those of
 * the differences to a round value.
 * \param values ascending */
AxisLabels
labelValues(const std::vector<double>& values);

/** \brief Round values within a range, some five of them. */
std::vector<double>
roundValues(double low, double high);

} // namespace uvol_tools
