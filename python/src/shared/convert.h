// SPDX-License-Identifier: BSD-3-Clause
// From the library's results to Python's objects.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/report.h>

#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <utility>
#include <vector>

namespace pcl_uvol::python {

/** \brief The numbers as an array that owns them: no copy. */
template <typename T>
pybind11::array_t<T>
toArray(std::vector<T>&& numbers, std::vector<pybind11::ssize_t> shape)
{
  auto kept = std::make_unique<std::vector<T>>(std::move(numbers));
  T* const data = kept->data();
  const pybind11::capsule owner(kept.release(), [](void* vector) {
    delete static_cast<std::vector<T>*>(vector);
  });
  return pybind11::array_t<T>(std::move(shape), data, owner);
}

/** \brief Text of a file or a user as Python's; bytes that are no UTF-8 become marks.
 */
pybind11::str
toText(const std::string& text);

/** \brief {"counts": ..., "milliseconds": ..., "warnings": ...}. */
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
