// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/wide_silhouettes.h"

#include "common/parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr std::size_t silhouette_rows = 16;

/** A pixel at a step in depth. */
struct Step {
  int column;
  float strength;
};

/** 0 below the edge, 1 above twice of it, smooth between. */
float
smoothStep(float value, float edge)
{
  const float t = std::clamp((value - edge) / edge, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/** Draws the lines of an image row by row. */
class SilhouettePainter {
public:
  SilhouettePainter(const ImageSpaceSettings& settings, int width, Image& image)
      : threshold_(static_cast<float>(settings.silhouette_threshold))
      , line_{255.0f * settings.line_color.r,
              255.0f * settings.line_color.g,
              255.0f * settings.line_color.b}
      , reach_(width / 2)
      , image_(image)
      , columns_(static_cast<int>(image.width))
      , rows_(static_cast<int>(image.height))
      , steps_(image.height)
  {
    for (int dy = 0; dy <= reach_; ++dy)
      for (int dx = 0; dx <= reach_; ++dx)
        pen_.push_back(std::clamp(0.5f * static_cast<float>(width + 1) -
                                      static_cast<float>(std::hypot(dx, dy)),
                                  0.0f,
                                  1.0f));
  }

  void
  findSteps(int row)
  {
    for (int column = 0; column < columns_; ++column) {
      const float strength = smoothStep(-laplaceAt(column, row), threshold_);
      if (strength > 0.0f)
        steps_[static_cast<std::size_t>(row)].push_back({column, strength});
    }
  }

  /** When all steps are found. */
  void
  drawRow(int row)
  {
    std::vector<float> lines(static_cast<std::size_t>(columns_));
    bool is_empty = true;
    for (int there = std::max(row - reach_, 0);
         there <= std::min(row + reach_, rows_ - 1);
         ++there)
      for (const Step& step : steps_[static_cast<std::size_t>(there)]) {
        is_empty = false;
        for (int column = std::max(step.column - reach_, 0);
             column <= std::min(step.column + reach_, columns_ - 1);
             ++column) {
          float& line = lines[static_cast<std::size_t>(column)];
          line =
              std::max(line, step.strength * penAt(column - step.column, there - row));
        }
      }
    if (!is_empty)
      layOver(row, lines);
  }

private:
  float
  depthAt(int column, int row) const
  {
    return image_.depth[placeOf(std::clamp(column, 0, columns_ - 1),
                                std::clamp(row, 0, rows_ - 1))];
  }

  /** Table 4.2; the image goes on at its borders. */
  float
  laplaceAt(int column, int row) const
  {
    return 4.0f * depthAt(column, row) - depthAt(column - 1, row) -
           depthAt(column + 1, row) - depthAt(column, row - 1) -
           depthAt(column, row + 1);
  }

  /** Opacity of a line in pixels beside its step. */
  float
  penAt(int dx, int dy) const
  {
    const int place = (reach_ + 1) * std::abs(dy) + std::abs(dx);
    return pen_[static_cast<std::size_t>(place)];
  }

  std::size_t
  placeOf(int column, int row) const
  {
    return static_cast<std::size_t>(row) * image_.width +
           static_cast<std::size_t>(column);
  }

  void
  layOver(int row, const std::vector<float>& lines)
  {
    for (int column = 0; column < columns_; ++column) {
      const float above = lines[static_cast<std::size_t>(column)];
      if (!(above > 0.0f))
        continue;
      std::uint8_t* const pixel = &image_.color[4 * placeOf(column, row)];
      const float below = (1.0f - above) * static_cast<float>(pixel[3]) / 255.0f;
      for (int k = 0; k < 3; ++k)
        pixel[k] = toByte((line_[k] * above + static_cast<float>(pixel[k]) * below) /
                          (above + below));
      pixel[3] = toByte(255.0f * (above + below));
    }
  }

  static std::uint8_t
  toByte(float value)
  {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f)));
  }

  float threshold_, line_[3];
  int reach_; ///< of a line beside its step, pixels
  std::vector<float> pen_;
  Image& image_;
  int columns_, rows_;
  std::vector<std::vector<Step>> steps_; ///< of the rows
};

} // namespace

void
drawSilhouettes(const ImageSpaceSettings& settings,
                int width,
                unsigned threads,
                Image& image)
{
  SilhouettePainter painter(settings, width, image);
  const auto forRows = [&](const auto& work) {
    parallelBlocks(image.height, silhouette_rows, threads, [&](auto begin, auto end) {
      for (std::size_t row = begin; row < end; ++row)
        work(static_cast<int>(row));
    });
  };
  forRows([&](int row) { painter.findSteps(row); });
  forRows([&](int row) { painter.drawRow(row); });
}

void
WideSilhouettes::render(const Frame& frame, Image& image, Report& report)
{
  if (!frame.settings.silhouettes) {
    backend_.render(frame, image, report);
    return;
  }
  ImageSpaceSettings settings = frame.settings;
  settings.silhouettes = false;
  ImagePlanes planes = frame.planes;
  planes.depth = true;
  backend_.render(
      {frame.cloud, frame.view, settings, planes, frame.threads}, image, report);
  const StepTimer timer(report, "silhouettes");
  drawSilhouettes(settings,
                  supersampling_ * (2 * settings.silhouette_thickness - 1),
                  frame.threads,
                  image);
}

} // namespace pcl_uvol
