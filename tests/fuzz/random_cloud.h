// SPDX-License-Identifier: BSD-3-Clause
// Clouds and choices made of bytes.
#pragma once

#include <pcl_uvol/common/parameters.h>

#include <Eigen/Core>
#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace uvol_fuzz {

/** \brief Bytes that are used up from the front; zeros follow the last. */
class Bytes {
public:
  Bytes(const std::uint8_t* bytes, std::size_t size)
      : at_(bytes)
      , end_(bytes + size)
  {
  }

  std::size_t
  size() const
  {
    return static_cast<std::size_t>(end_ - at_);
  }

  template <typename T>
  T
  take()
  {
    T value{};
    const std::size_t bytes = size() < sizeof(T) ? size() : sizeof(T);
    std::memcpy(&value, at_, bytes);
    at_ += bytes;
    return value;
  }

  /** One of the first `count` numbers from 0. */
  std::size_t
  choose(std::size_t count)
  {
    return take<std::uint8_t>() % count;
  }

  bool
  flip()
  {
    return choose(2) == 1;
  }

private:
  const std::uint8_t *at_, *end_;
};

/** \brief The fields of samples that have a value each. */
constexpr std::array<const char*, 4> sample_fields{"x", "y", "z", "intensity"};

template <typename T, std::size_t count>
T
chooseOne(Bytes& bytes, const std::array<pcl_uvol::EnumWord<T>, count>& words)
{
  return words[bytes.choose(count)].value;
}

inline Eigen::Array3f
takeScale(Bytes& bytes)
{
  constexpr std::array<float, 4> factors{1.0f, 1e-3f, 1e3f, 1e30f};
  const float x = factors[bytes.choose(factors.size())];
  return {x, 1.0f, factors[bytes.choose(factors.size())]};
}

/** \brief A cloud of all the bytes that are left: any floats, or small whole numbers
 * times a power of two, of which many are equal, on a line or in a plane.
 * \param names of its fields, all float32 */
template <std::size_t fields>
pcl::PCLPointCloud2::Ptr
takeCloud(Bytes& bytes, const std::array<const char*, fields>& names)
{
  constexpr std::size_t most_points = 500; // for speed
  const bool any_float = bytes.flip();
  const float scale = any_float ? 1.0f
                                : static_cast<float>(1ull << bytes.choose(60)) /
                                      static_cast<float>(1ull << bytes.choose(60));
  const std::size_t point_bytes = fields * (any_float ? sizeof(float) : 1);
  std::size_t count = bytes.size() / point_bytes;
  if (count > most_points)
    count = most_points;
  auto cloud = std::make_shared<pcl::PCLPointCloud2>();
  for (const char* const name : names) {
    pcl::PCLPointField field;
    field.name = name;
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    field.offset = static_cast<pcl::uindex_t>(cloud->fields.size() * sizeof(float));
    cloud->fields.push_back(field);
  }
  cloud->height = 1;
  cloud->width = static_cast<pcl::uindex_t>(count);
  cloud->point_step = static_cast<pcl::uindex_t>(fields * sizeof(float));
  cloud->row_step = cloud->width * cloud->point_step;
  cloud->data.resize(count * cloud->point_step);
  for (std::size_t i = 0; i < count * fields; ++i) {
    const float value = any_float
                            ? bytes.take<float>()
                            : scale * static_cast<float>(bytes.take<std::int8_t>());
    std::memcpy(&cloud->data[i * sizeof(float)], &value, sizeof(float));
  }
  return cloud;
}

} // namespace uvol_fuzz
