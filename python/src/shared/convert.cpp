// SPDX-License-Identifier: BSD-3-Clause
#include "shared/convert.h"

#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace pcl_uvol::python {

namespace py = pybind11;

py::str
toText(const std::string& text)
{
  PyObject* const decoded = PyUnicode_DecodeUTF8(
      text.data(), static_cast<py::ssize_t>(text.size()), "replace");
  if (decoded == nullptr)
    throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

py::dict
toDict(const Report& report)
{
  py::dict counts, milliseconds;
  for (const auto& [name, count] : report.counts)
    counts[toText(name)] = count;
  for (const auto& [step, spent] : report.milliseconds)
    milliseconds[toText(step)] = spent;
  py::list warnings;
  for (const std::string& warning : report.warnings)
    warnings.append(toText(warning));
  py::dict dict;
  dict["counts"] = counts;
  dict["milliseconds"] = milliseconds;
  dict["warnings"] = warnings;
  return dict;
}

std::vector<Triangle>
toTriangles(const py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>&
                indices)
{
  if (indices.ndim() != 2 || indices.shape(1) != 3)
    throw InvalidArgument("Triangles are rows of three indices.");
  std::vector<Triangle> triangles(static_cast<std::size_t>(indices.shape(0)));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    std::copy_n(indices.data() + 3 * i, 3, triangles[i].begin());
  return triangles;
}

} // namespace pcl_uvol::python
