// SPDX-License-Identifier: BSD-3-Clause
// A small picture of how figures change from step to step.
#pragma once

#include "charts/paper.h"
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/render/renderer.h>

#include <array>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A name and a value for each of the abscissas 1, 2, ... */
struct PlotLine {
  std::string name;
  std::vector<double> values;
};

/** \brief Draw up to four lines on a logarithmic ordinate, with a legend. Values that
 * are not positive leave a gap.
 * \param paper usually 720 x 440 pixels */
pcl_uvol::Image
drawLinePlot(const std::vector<PlotLine>& lines,
             const std::string& abscissa,
             const Paper& paper = {});

/** \brief The same of members of structs that list them: their texts are the names.
 * \param rows one per abscissa
 * \param members names of up to four, which are numbers */
template <typename Row>
pcl_uvol::Image
drawLinePlot(const std::vector<Row>& rows,
             const std::vector<std::string>& members,
             const std::string& abscissa,
             const Paper& paper)
{
  std::vector<PlotLine> lines;
  for (const std::string& name : members)
    pcl_uvol::forEachDescribed<Row>([&](const auto& member) {
      if (member.name != name)
        return;
      lines.push_back({member.text.help, {}});
      for (const Row& row : rows)
        lines.back().values.push_back(row.*member.pointer);
    });
  return drawLinePlot(lines, abscissa, paper);
}

/** \brief Single values in a plot. */
struct PlotDots {
  std::string name;
  std::vector<std::array<double, 2>> places; ///< abscissa and value
};

/** \brief A quantity along a way. */
struct Profile {
  std::vector<double> abscissas;  ///< ascending
  std::vector<double> values;     ///< one per abscissa; NaN leaves a gap
  std::vector<double> errors;     ///< of the values; NaN, 0 or empty: none
  std::string abscissa, ordinate; ///< labels
  /** Up to four kinds of dots over the line, with a legend; those without a place are
   * left out. */
  std::vector<PlotDots> dots{};
};

/** \brief Draw a line on linear axes, in a band of the errors above and below.
 * \param paper usually 720 x 440 pixels */
pcl_uvol::Image
drawProfile(const Profile& profile, const Paper& paper = {});

} // namespace uvol_tools
