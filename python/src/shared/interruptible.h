// SPDX-License-Identifier: BSD-3-Clause
// Long work for Python: without the lock of the interpreter, with progress and Ctrl-C.
#pragma once

#include <pcl_uvol/common/stage.h>

#include <functional>
#include <pybind11/pybind11.h>

namespace pcl_uvol::python {

/** \brief Call work(progress) on a thread of its own, and wait for it without the lock
 * of the interpreter.
 *
 * Only the waiting thread, the caller's, runs Python: it tells progress, and it looks
 * for signals, which Python hands to its main thread alone. An exception of either
 * ends the work at its next report of progress and is what the caller gets.
 *
 * \param progress called as progress(step, done); None: nobody is told */
void
runInterruptibly(const pybind11::object& progress,
                 const std::function<void(const ProgressCallback&)>& work);

} // namespace pcl_uvol::python
