// SPDX-License-Identifier: BSD-3-Clause
#include "gl/programs.h"

namespace pcl_uvol {

namespace {

std::string
join(const std::string& defines, const shaders::Source& parts)
{
  std::string source = "#version 330 core\n" + defines + shaders::prelude;
  for (const char* part : parts)
    source += part != nullptr ? part : "";
  return source;
}

} // namespace

const Program&
Programs::use(const shaders::Pass& pass, const std::string& defines)
{
  const auto key = std::make_pair(&pass, defines);
  auto found = programs_.find(key);
  if (found == programs_.end())
    found =
        programs_
            .emplace(
                key,
                Program(gl_, join(defines, pass.vertex), join(defines, pass.fragment)))
            .first;
  found->second.use();
  return found->second;
}

} // namespace pcl_uvol
