// SPDX-License-Identifier: BSD-3-Clause
// Datasets of any fields with random content, and their comparison.
#pragma once

#include "common/scalar_field.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace uvol_test {

using Type = pcl::PCLPointField;

struct FieldSpec {
  std::string name;
  std::uint8_t datatype;
  unsigned count = 1;
};

inline const std::vector<std::uint8_t>&
allDatatypes()
{
  static const std::vector<std::uint8_t> types{Type::INT8,
                                               Type::UINT8,
                                               Type::INT16,
                                               Type::UINT16,
                                               Type::INT32,
                                               Type::UINT32,
                                               Type::INT64,
                                               Type::UINT64,
                                               Type::FLOAT32,
                                               Type::FLOAT64};
  return types;
}

template <typename T>
void
put(std::uint8_t* to, T value)
{
  std::memcpy(to, &value, sizeof(T));
}

/** \brief Random numbers in every field; some reals are NaN. Integers and 64-bit ones
 * fill their range. */
inline void
fill(pcl::PCLPointCloud2& cloud, Random& random)
{
  for (std::size_t i = 0; i < cloud.width; ++i)
    for (const auto& field : cloud.fields)
      for (std::size_t c = 0; c < field.count; ++c) {
        const std::size_t bytes = pcl_uvol::datatypeSize(field.datatype);
        std::uint8_t* const to =
            cloud.data.data() + i * cloud.point_step + field.offset + c * bytes;
        const double value = 200.0 * random.uniform() - 100.0;
        const bool missing = field.name.size() > 1 && random.uniform() < 0.1;
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        if (field.datatype == Type::FLOAT32)
          put(to, static_cast<float>(missing ? nan : value));
        else if (field.datatype == Type::FLOAT64)
          put(to, missing ? nan : value);
        else
          for (std::size_t byte = 0; byte < bytes; ++byte)
            to[byte] = static_cast<std::uint8_t>(256.0 * random.uniform());
      }
}

/** \brief x, y, z in [-100, 100) and these fields; points take a multiple of 4 bytes.
 */
inline pcl_uvol::Dataset
makeDataset(const std::vector<FieldSpec>& specs, std::size_t count, std::uint64_t seed)
{
  pcl_uvol::Dataset dataset;
  auto& cloud = dataset.cloud;
  std::vector<FieldSpec> all{
      {"x", Type::FLOAT32}, {"y", Type::FLOAT32}, {"z", Type::FLOAT32}};
  all.insert(all.end(), specs.begin(), specs.end());
  std::size_t end = 0;
  for (const auto& spec : all) {
    pcl::PCLPointField field;
    field.name = spec.name;
    field.datatype = spec.datatype;
    field.count = spec.count;
    field.offset = static_cast<pcl::uindex_t>(end);
    end += spec.count * pcl_uvol::datatypeSize(spec.datatype);
    cloud.fields.push_back(field);
  }
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(count);
  cloud.point_step = static_cast<pcl::uindex_t>((end + 3) / 4 * 4);
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(count * cloud.point_step);
  Random random(seed);
  fill(cloud, random);
  return dataset;
}

inline double
valueOf(const pcl_uvol::Dataset& dataset, const std::string& field, std::size_t point)
{
  return pcl_uvol::ScalarField(dataset.cloud.fields, field)
      .read(dataset.cloud.data.data() + point * dataset.cloud.point_step);
}

/** \brief A coordinate with its origin. */
inline double
coordinateOf(const pcl_uvol::Dataset& dataset, std::size_t axis, std::size_t point)
{
  return dataset.origin[axis] +
         valueOf(dataset, std::string(1, static_cast<char>('x' + axis)), point);
}

/** \brief Same number, or both are NaN. */
inline void
expectSame(double actual, double expected, const std::string& what)
{
  if (std::isnan(expected))
    EXPECT_TRUE(std::isnan(actual)) << what << " is " << actual;
  else
    EXPECT_EQ(actual, expected) << what;
}

/** \brief Same names, types, counts, bytes of every field. */
inline void
expectSameFields(const pcl_uvol::Dataset& actual, const pcl_uvol::Dataset& expected)
{
  ASSERT_EQ(pcl_uvol::describeFields(actual.cloud.fields),
            pcl_uvol::describeFields(expected.cloud.fields));
  ASSERT_EQ(actual.cloud.width, expected.cloud.width);
  ASSERT_EQ(actual.cloud.height, 1u);
  ASSERT_EQ(actual.cloud.point_step % 4, 0u);
  ASSERT_EQ(actual.cloud.data.size(),
            std::size_t(actual.cloud.width) * actual.cloud.point_step);
  for (std::size_t f = 0; f < actual.cloud.fields.size(); ++f) {
    const auto& field = actual.cloud.fields[f];
    const auto& other = expected.cloud.fields[f];
    const std::size_t bytes = pcl_uvol::datatypeSize(field.datatype);
    for (std::size_t i = 0; i < actual.cloud.width; ++i)
      for (std::size_t c = 0; c < field.count; ++c) {
        const std::size_t at = c * bytes;
        const auto* const a = &actual.cloud.data[i * actual.cloud.point_step];
        const auto* const b = &expected.cloud.data[i * expected.cloud.point_step];
        const double number =
            pcl_uvol::FieldComponent{other.offset + at, other.datatype}.read(b);
        if (std::isnan(number))
          expectSame(
              pcl_uvol::FieldComponent{field.offset + at, field.datatype}.read(a),
              number,
              field.name);
        else
          ASSERT_EQ(std::memcmp(a + field.offset + at, b + other.offset + at, bytes), 0)
              << field.name << " of point " << i;
      }
  }
}

/** \brief A number of a point. */
inline double
valueAt(const pcl_uvol::Dataset& dataset, const std::string& name, std::size_t point)
{
  return pcl_uvol::ScalarField(dataset.cloud.fields, name)
      .read(dataset.cloud.data.data() + point * dataset.cloud.point_step);
}

/** \brief The message of the exception that this throws; empty if it throws none. */
template <typename ExceptionT, typename Function>
std::string
messageOf(Function&& function)
{
  try {
    function();
  }
  catch (const ExceptionT& error) {
    return error.message();
  }
  return {};
}

} // namespace uvol_test
