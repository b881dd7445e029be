// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/observe.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>

#include <utility>

namespace uvol_tools {

void
observe(vtkObject& object,
        unsigned long event,
        std::function<void(const void* data)> function)
{
  using Function = std::function<void(const void* data)>;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new Function(std::move(function)));
  command->SetClientDataDeleteCallback(
      [](void* function_data) { delete static_cast<Function*>(function_data); });
  command->SetCallback([](vtkObject*, unsigned long, void* function_data, void* data) {
    (*static_cast<Function*>(function_data))(data);
  });
  object.AddObserver(event, command);
}

} // namespace uvol_tools
