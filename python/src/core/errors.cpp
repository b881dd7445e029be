// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"
#include "common/similar_words.h"
#include "core/bindings.h"
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

/** Core and expressions begin so where a name is not that of a field. */
bool
isOfMissingField(const std::string& message)
{
  return message.rfind("There is no field ", 0) == 0;
}

void
raise(const py::handle& type, const std::string& message)
{
  PyErr_SetObject(type.ptr(),
                  py::bytes(message).attr("decode")("utf-8", "replace").ptr());
}

} // namespace

void
bindErrors(py::module_& module)
{
  // Exceptions of the module itself are Python's classes: pcl_uvol/_errors.py.
  module.attr("_errors") = py::module_::import("pcl_uvol._errors");
  static const py::handle errors = py::object(module.attr("_errors")).release();
  module.def("find_similar", &findSimilar);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown)
        std::rethrow_exception(thrown);
    }
    catch (const IOError& error) {
      raise(PyExc_OSError, error.message());
    }
    catch (const Diverged& error) {
      raise(errors.attr("DivergedError"), error.message());
    }
    catch (const NotEnoughMemory& error) {
      raise(PyExc_MemoryError, error.message());
    }
    catch (const Exception& error) {
      raise(isOfMissingField(error.message()) ? errors.attr("FieldError")
                                              : py::handle(PyExc_ValueError),
            error.message());
    }
    catch (const std::bad_alloc&) {
      raise(PyExc_MemoryError, "There is not enough memory.");
    }
    catch (const std::length_error&) { // of a vector longer than any memory
      raise(PyExc_MemoryError, "There is not enough memory.");
    }
    catch (const std::system_error&) { // of threads that the system does not give
      raise(PyExc_MemoryError, "There are not enough memory or threads for it.");
    }
  });
}

} // namespace pcl_uvol::python
