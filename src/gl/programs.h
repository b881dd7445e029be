// SPDX-License-Identifier: BSD-3-Clause
// The programs of all passes, compiled when they are first used.
#pragma once

#include "gl/objects.h"
#include "gl/shaders.h"

#include <map>
#include <string>
#include <utility>

namespace pcl_uvol {

class Programs {
public:
  explicit Programs(const GlFunctions& gl)
      : gl_(gl)
  {
  }

  /** \brief The program of a pass, in use.
   * \param defines "#define A\n#define B\n" */
  const Program&
  use(const shaders::Pass& pass, const std::string& defines = "");

private:
  const GlFunctions& gl_;
  std::map<std::pair<const shaders::Pass*, std::string>, Program> programs_;
};

/** \brief A line of defines, or none. */
inline std::string
defineIf(bool condition, const std::string& name)
{
  return condition ? "#define " + name + "\n" : std::string();
}

} // namespace pcl_uvol
