// SPDX-License-Identifier: BSD-3-Clause
#include "shared/convert.h"

#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

/** Whole numbers as Python's int. */
py::object
toNumber(double number)
{
  constexpr double most_exact = 9007199254740992.0; // 2^53
  if (number == std::trunc(number) && std::abs(number) <= most_exact)
    return py::int_(static_cast<long long>(number));
  return py::float_(number);
}

} // namespace

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
toDict(const Message& message)
{
  py::dict values;
  for (const MessageValue& value : message.values)
    if (const auto* const word = std::get_if<std::string>(&value.value))
      values[toText(value.name)] = toText(*word);
    else
      values[toText(value.name)] = toNumber(std::get<double>(value.value));
  py::dict dict;
  dict["code"] = toText(message.code);
  dict["text"] = toText(message.text());
  dict["values"] = values;
  return dict;
}

py::list
toDicts(const std::vector<Message>& messages)
{
  py::list dicts;
  for (const Message& message : messages)
    dicts.append(toDict(message));
  return dicts;
}

Message
toMessage(const std::string& code, const py::dict& values)
{
  Message message(code, {});
  for (const auto& [name, value] : values)
    if (py::isinstance<py::str>(value))
      message.values.emplace_back(name.cast<std::string>(), value.cast<std::string>());
    else
      message.values.emplace_back(name.cast<std::string>(), value.cast<double>());
  return message;
}

py::dict
toDict(const Report& report)
{
  py::dict counts, milliseconds;
  for (const auto& [name, count] : report.counts)
    counts[toText(name)] = count;
  for (const auto& [step, spent] : report.milliseconds)
    milliseconds[toText(step)] = spent;
  py::dict dict;
  dict["counts"] = counts;
  dict["milliseconds"] = milliseconds;
  dict["warnings"] = toDicts(report.warnings);
  return dict;
}

std::vector<Triangle>
toTriangles(const py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>&
                indices)
{
  if (indices.ndim() != 2 || indices.shape(1) != 3)
    throw InvalidArgument("bad_triangle_array", {});
  std::vector<Triangle> triangles(static_cast<std::size_t>(indices.shape(0)));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    std::copy_n(indices.data() + 3 * i, 3, triangles[i].begin());
  return triangles;
}

} // namespace pcl_uvol::python
