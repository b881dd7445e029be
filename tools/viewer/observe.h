// SPDX-License-Identifier: BSD-3-Clause
// Events of VTK.
#pragma once

#include <vtkObject.h>

#include <functional>

namespace uvol_tools {

/** \brief Call a function with an event's data, if it has some. */
void
observe(vtkObject& object,
        unsigned long event,
        std::function<void(const void* data)> function);

} // namespace uvol_tools
