// SPDX-License-Identifier: BSD-3-Clause
// From what users ask of a picture to cameras, colours and lights.
#pragma once

#include "render/point_colors.h"
#include "shared/picture_parameters.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/render/camera.h>
#include <pcl_uvol/render/image.h>
#include <pcl_uvol/render/lighting.h>

#include <array>
#include <string>
#include <vector>

namespace pcl_uvol::python {

/** \brief The parameters in a text of JSON.
 * \throws InvalidArgument for what cannot be drawn, before a renderer looks at it */
PictureParameters
readPictureParameters(const std::string& json);

/** \throws InvalidArgument unless all numbers lie in [0, 1] */
Color
toColor(const Eigen::Array3d& numbers);

Background
makeBackground(const PictureParameters& parameters);

Material
makeMaterial(const PictureParameters& parameters);

std::vector<Light>
makeLights(const PictureParameters& parameters);

/** \brief The camera of what is left of the picture without its margin.
 * \param origin what was subtracted from the coordinates
 * \param cloud that fills the picture where only a view is chosen; null: the bounds do
 */
Camera
makeCamera(const PictureParameters& parameters,
           const BoundingSphere& bounds,
           const std::array<double, 3>& origin,
           const CloudView* cloud);

/** \brief The field that colours a cloud; "" for the colour of the surface. */
std::string
findColorField(const PictureParameters& parameters, const CloudView& cloud);

/** \brief How that field becomes colours. */
ColorMapping
makeColorMapping(const PictureParameters& parameters,
                 const CloudView& cloud,
                 const std::string& field);

/** \brief Put columns of the background on the right of a picture. */
void
addMargin(Image& image, const Background& background, int columns);

} // namespace pcl_uvol::python
