// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/mouse_style.h"

#include <vtkObjectFactory.h>

namespace uvol_tools {

vtkStandardNewMacro(MouseStyle);

} // namespace uvol_tools
