// SPDX-License-Identifier: BSD-3-Clause
#include "shared/convert.h"

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

} // namespace pcl_uvol::python
