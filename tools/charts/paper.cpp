// SPDX-License-Identifier: BSD-3-Clause
#include "charts/paper.h"

#include <algorithm>
#include <cmath>

namespace uvol_tools {

int
Paper::printedLetters() const
{
  constexpr double points = 7.0, points_per_inch = 72.0;
  return static_cast<int>(std::lround(points / points_per_inch * dots_per_inch));
}

int
Paper::leastLetters(int room) const
{
  return std::min(printedLetters(), std::min(width, height) / room);
}

int
Paper::chartLetters(const Paper& usual) const
{
  constexpr double size = 14.0, least = 6.0;
  constexpr int room = 16; // for numbers, a label and a curve
  if (dots_per_inch > 0.0)
    return leastLetters(room);
  const double scale = std::min(static_cast<double>(width) / usual.width,
                                static_cast<double>(height) / usual.height);
  return static_cast<int>(std::max(least, std::round(size * scale)));
}

} // namespace uvol_tools
