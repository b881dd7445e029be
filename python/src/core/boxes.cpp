// SPDX-License-Identifier: BSD-3-Clause
// Samples in boxes that repeat.
#include "core/bindings.h"
#include "neighbors/samples_in_box.h"
#include "shared/convert.h"
#include "shared/interruptible.h"

#include <array>
#include <memory>
#include <pybind11/stl.h>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

/** Samples with images. */
class ImagedSamples {
public:
  ImagedSamples(const DatasetPtr& samples,
                const std::array<double, 3>& sides,
                const std::array<float, 3>& scale,
                unsigned threads,
                const py::object& progress)
      : samples_(std::make_shared<Dataset>(*samples))
  {
    runInterruptibly(progress, [&](const ProgressCallback& callback) {
      report_.progress = callback;
      box_ = std::make_unique<SamplesInBox>(
          *samples_, sides, Eigen::Array3f(scale.data()), threads, report_);
      report_.progress = nullptr;
    });
  }

  DatasetPtr
  getSamples() const
  {
    return samples_;
  }

  std::size_t
  countOwn() const
  {
    return box_->countOwn();
  }

  std::array<double, 3>
  getSides() const
  {
    return box_->getSides();
  }

  py::dict
  getReport() const
  {
    return toDict(report_);
  }

private:
  DatasetPtr samples_;
  std::unique_ptr<SamplesInBox> box_;
  Report report_;
};

} // namespace

void
bindBoxes(py::module_& module)
{
  py::class_<ImagedSamples>(module, "ImagedSamples")
      .def(py::init<const DatasetPtr&,
                    const std::array<double, 3>&,
                    const std::array<float, 3>&,
                    unsigned,
                    const py::object&>())
      .def_property_readonly("samples", &ImagedSamples::getSamples)
      .def_property_readonly("own", &ImagedSamples::countOwn)
      .def_property_readonly("sides", &ImagedSamples::getSides)
      .def_property_readonly("report", &ImagedSamples::getReport);
}

} // namespace pcl_uvol::python
