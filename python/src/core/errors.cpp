// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/similar_words.h"
#include "core/bindings.h"
#include "shared/convert.h"
#include <pcl_uvol/common/exceptions.h>

#include <exception>
#include <new>
#include <pybind11/stl.h>
#include <stdexcept>
#include <string>
#include <system_error>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

bool
isOfMissingField(const Message& message)
{
  const std::string& code = message.code;
  return code == "unknown_field" || code == "unknown_lone_field" ||
         code == "unknown_operand";
}

/** \param message its code and values become attributes; None and no values where it
 * is but a text */
void
raise(const py::handle& type, const Message& message)
{
  const py::object error = type(toText(message.text()));
  const bool is_text = message.code == "text";
  error.attr("code") = is_text ? py::object(py::none()) : toText(message.code);
  error.attr("values") = is_text ? py::dict() : toDict(message)["values"];
  PyErr_SetObject(type.ptr(), error.ptr());
}

} // namespace

void
bindErrors(py::module_& module)
{
  // Exceptions of the module itself are Python's classes: pcl_uvol/_errors.py.
  module.attr("_errors") = py::module_::import("pcl_uvol._errors");
  static const py::handle errors = py::object(module.attr("_errors")).release();
  module.def("find_similar", &findSimilar);
  module.def("make_message", [](const std::string& code, const py::dict& values) {
    return toDict(toMessage(code, values));
  });
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown)
        std::rethrow_exception(thrown);
    }
    catch (const IOError& error) {
      raise(PyExc_OSError, error.asMessage());
    }
    catch (const Diverged& error) {
      raise(errors.attr("DivergedError"), error.asMessage());
    }
    catch (const NotEnoughMemory& error) {
      raise(PyExc_MemoryError, error.asMessage());
    }
    catch (const Exception& error) {
      raise(isOfMissingField(error.asMessage()) ? errors.attr("FieldError")
                                                : py::handle(PyExc_ValueError),
            error.asMessage());
    }
    catch (const std::bad_alloc&) {
      raise(PyExc_MemoryError, {"out_of_memory", {}});
    }
    catch (const std::length_error&) { // of a vector longer than any memory
      raise(PyExc_MemoryError, {"out_of_memory", {}});
    }
    catch (const std::system_error&) { // of threads that the system does not give
      raise(PyExc_MemoryError, {"out_of_threads", {}});
    }
  });
}

} // namespace pcl_uvol::python
