// SPDX-License-Identifier: BSD-3-Clause
// Conic sections in GLSL 3.30: one instance per site.
#pragma once

namespace pcl_uvol::shaders {

extern const char* const cone_vertex;
extern const char* const cone_fragment;

} // namespace pcl_uvol::shaders
