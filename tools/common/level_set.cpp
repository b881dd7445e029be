// SPDX-License-Identifier: BSD-3-Clause
#include "level_set.h"

#include "options.h"

#include <cstring>
#include <sstream>

namespace uvol_tools {

double
parseMu(const std::string& text)
{
  if (text == "auto")
    return pcl_uvol::LevelSetParameters::automatic;
  const double mu = parseNumbers("mu", text, 1).front();
  if (mu < 0.0 || mu > 1.0)
    throw UsageError("-mu takes auto or a number from 0 to 1, but got " + text + ".");
  return mu;
}

pcl::PCLPointCloud2
cloudOfPhi(const pcl_uvol::CloudView& cloud, const std::vector<float>& phi)
{
  pcl::PCLPointCloud2 result;
  result.width = static_cast<std::uint32_t>(phi.size());
  result.height = 1;
  result.point_step = phi_point_bytes;
  result.row_step = result.point_step * result.width;
  result.is_dense = 0;
  for (const char* name : {"x", "y", "z", "phi"}) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(sizeof(float) * result.fields.size());
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    result.fields.push_back(field);
  }
  result.data.resize(result.row_step);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    std::uint8_t* const point = result.data.data() + i * result.point_step;
    std::memcpy(point, cloud.xyz(i), 3 * sizeof(float));
    std::memcpy(point + 3 * sizeof(float), &phi[i], sizeof(float));
  }
  return result;
}

std::vector<std::pair<std::string, std::string>>
describe(const pcl_uvol::LevelSetSummary& summary, bool mu_is_automatic)
{
  const auto text = [](auto... parts) {
    std::ostringstream stream;
    stream.precision(3);
    (stream << ... << parts);
    return stream.str();
  };
  const auto& last = summary.steps.back();
  return {{"spacing", text(summary.spacing, " (median at the surface)")},
          {"noise", text(summary.noise, " spacings")},
          {"mu",
           text(summary.mu,
                mu_is_automatic ? " (automatic: by the noise and what smoothing left; "
                                  "1 follows the data, 0 "
                                  "only smooths)"
                                : "")},
          {"level set",
           text(summary.converged ? "converged" : "not converged",
                " after ",
                summary.steps.size(),
                " steps, moves by ",
                last.change,
                " spacings per unit of time, | |grad phi| - 1 | is ",
                last.slope_error)}};
}

} // namespace uvol_tools
