// SPDX-License-Identifier: BSD-3-Clause
// The data sets of tests/data with isovalues worth a look, for tables of what holds on
// real samples.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace uvol_benchmark {

/** A data set and the surface that is asked of it. */
struct DataCase {
  std::string file, field;
  double isovalue;
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f}; ///< 0: to be found from the field
  std::string by = "random";
  std::string where{};
  std::array<std::string, 3> columns{};
};

const std::vector<DataCase>&
listCases();

/** Its samples; those on generated lines have the field "line". */
std::shared_ptr<pcl_uvol::Dataset>
load(const DataCase& data);

/** What coordinates are multiplied by, found from the field where it is not given. */
Eigen::Array3f
findScale(const DataCase& data, const pcl_uvol::CloudView& cloud);

} // namespace uvol_benchmark
