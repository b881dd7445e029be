// SPDX-License-Identifier: BSD-3-Clause
// From the library's results to Python's objects.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/common/message.h>
#include <pcl_uvol/common/stage.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol::python {

/** \brief The numbers as an array that owns them: no copy.
 * \tparam Item numbers, or rows of them */
template <typename Number, typename Item>
pybind11::array_t<Number>
toArrayOf(std::vector<Item>&& items, std::vector<pybind11::ssize_t> shape)
{
  static_assert(sizeof(Item) % sizeof(Number) == 0);
  auto kept = std::make_unique<std::vector<Item>>(std::move(items));
  const void* const data = kept->data();
  const pybind11::capsule owner(kept.release(), [](void* vector) {
    delete static_cast<std::vector<Item>*>(vector);
  });
  return pybind11::array_t<Number>(
      std::move(shape), static_cast<const Number*>(data), owner);
}

/** \brief toArrayOf() plain numbers. */
template <typename T>
pybind11::array_t<T>
toArray(std::vector<T>&& numbers, std::vector<pybind11::ssize_t> shape)
{
  return toArrayOf<T>(std::move(numbers), std::move(shape));
}

/** \brief toArrayOf() triangles, a row each. */
inline pybind11::array_t<std::uint32_t>
toIndices(std::vector<Triangle>&& triangles)
{
  const auto count = static_cast<pybind11::ssize_t>(triangles.size());
  return toArrayOf<std::uint32_t>(std::move(triangles), {count, 3});
}

/** \brief Longitude, latitude and coordinates per kilometre of a map; none without. */
using MapNumbers = std::optional<std::array<double, 3>>;

inline std::optional<MapProjection>
toMap(const MapNumbers& numbers)
{
  if (!numbers)
    return std::nullopt;
  return MapProjection{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

/** \brief The other way: a copy.
 * \throws InvalidArgument unless the array has rows of three */
std::vector<Triangle>
toTriangles(const pybind11::array_t<std::uint32_t,
                                    pybind11::array::c_style |
                                        pybind11::array::forcecast>& indices);

/** \brief An array of whole numbers, which are copied at once. */
using Numbers =
    pybind11::array_t<int, pybind11::array::c_style | pybind11::array::forcecast>;

inline std::vector<int>
toWholeNumbers(const Numbers& numbers)
{
  return {numbers.data(), numbers.data() + numbers.size()};
}

/** \brief Text of a file or a user as Python's; bytes that are no UTF-8 become marks.
 */
pybind11::str
toText(const std::string& text);

/** \brief {"code": ..., "text": ..., "values": {...}}; the text names parameters as
 * arguments. */
pybind11::dict
toDict(const Message& message);

/** \brief toDict() each. */
pybind11::list
toDicts(const std::vector<Message>& messages);

/** \brief The other way.
 * \param values numbers and texts by name */
Message
toMessage(const std::string& code, const pybind11::dict& values);

/** \brief {"counts": ..., "milliseconds": ..., "warnings": [...]}. */
pybind11::dict
toDict(const Report& report);

/** \brief A dataset that Python holds. */
using DatasetPtr = std::shared_ptr<Dataset>;

/** \brief Move a dataset to where Python can hold it. */
inline DatasetPtr
share(Dataset&& dataset)
{
  return std::make_shared<Dataset>(std::move(dataset));
}

} // namespace pcl_uvol::python
