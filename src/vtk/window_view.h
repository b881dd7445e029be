// SPDX-License-Identifier: BSD-3-Clause
// VTK's camera as that of image-space rendering.
#pragma once

#include "gl/gl_backend.h"
#include "render/image_space/frame.h"

class vtkMatrix4x4;
class vtkRenderer;

namespace pcl_uvol {

/** \brief What a renderer of a window looks at, and where in the window. */
struct WindowView {
  View view;
  GlFramebuffer target; ///< without its name
};

/** \brief The view of a renderer, a tile of a larger picture included, on a cloud that
 * lies in the world by a rotation, a translation and one scale.
 * \param model from the cloud's to the world's coordinates
 * \param bounds of the cloud
 * \throws InvalidArgument for a projection that is neither perspective nor parallel,
 * any other matrix, pixels that are not square, a size of the window that cannot be
 * drawn */
WindowView
makeWindowView(vtkRenderer& renderer,
               vtkMatrix4x4& model,
               const BoundingSphere& bounds);

} // namespace pcl_uvol
