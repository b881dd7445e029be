// SPDX-License-Identifier: BSD-3-Clause
// Scenes as text, and what their clouds hold.
#pragma once

#include "io/scene_file.h"
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace uvol_test {

/** \brief Splats as text, with further columns.
 * \param rows what these hold; a row that starts with ! gets a splat without radius */
inline std::string
splatTable(const std::string& columns, const std::vector<std::string>& rows)
{
  std::string text = "x,y,z,normal_x,normal_y,normal_z,tangent_x,tangent_y,tangent_z,"
                     "radius,error,tilt_u,tilt_v,slope_u,slope_v" +
                     columns + "\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool bad = rows[i][0] == '!';
    text += std::to_string(i) + ",0,0,0,0,1,1,0,0," + (bad ? "0" : "0.5") +
            ",0.01,0,0,0,0" + rows[i].substr(bad ? 1 : 0) + "\n";
  }
  return text;
}

/** \brief Loads scenes that lie in a folder of their own. */
class SceneText : public testing::Test {
protected:
  pcl_uvol::SceneFile
  load(const std::string& text, const std::string& folder = "")
  {
    writeFile(path_, text);
    report_ = pcl_uvol::Report();
    return pcl_uvol::loadScene(path_, folder, 1, report_);
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "scene.txt";
  pcl_uvol::Report report_;
};

} // namespace uvol_test
