// SPDX-License-Identifier: BSD-3-Clause
// From what users ask of a picture to cameras, colours and lights.
#pragma once

#include "charts/figure.h"
#include "charts/picture_parameters.h"
#include "render/camera_choice.h"
#include "render/point_colors.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

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

/** \brief What explains a picture. */
uvol_tools::Figure
makeFigure(const PictureParameters& parameters);

/** \brief The camera of a view.
 * \param seen what fills the view where only a side is chosen
 * \param origin what was subtracted from the coordinates
 * \param angle degrees that it is turned by */
Camera
makeCamera(const PictureParameters& parameters,
           const SeenSurface& seen,
           const std::array<double, 3>& origin,
           const uvol_tools::PictureCell& cell,
           double angle = 0.0);

/** \brief The field that colours a cloud; "" for the colour of the surface. */
std::string
findColorField(const PictureParameters& parameters, const CloudView& cloud);

/** \brief How that field becomes colours.
 * \param labels names that its numbers stand for */
ColorMapping
makeColorMapping(const PictureParameters& parameters,
                 const CloudView& cloud,
                 const LabelNames& labels,
                 const std::string& field);

} // namespace pcl_uvol::python
