// SPDX-License-Identifier: BSD-3-Clause
// The picture that a tool draws of the surface it has made.
#pragma once

#include "shared/ray_options.h"
#include "shared/render_options.h"
#include <pcl_uvol/io/dataset.h>

#include <array>
#include <string>

namespace uvol_tools {

/** \brief -png, and everything that it is drawn by. */
class SurfacePicture {
public:
  void
  declare(Options& options);

  /** \throws UsageError, and IOError for a path that is none */
  void
  check(const Options& options);

  bool
  isAskedFor() const
  {
    return !path_.empty();
  }

  /** \brief The field of -color, where it is an expression: of samples, before a
   * surface is made, if it has derivatives, and of the surface if it has none. @{ */
  void
  addColorOfSamples(const Options& options,
                    pcl_uvol::Dataset& samples,
                    pcl_uvol::Report& report,
                    const std::array<double, 3>& periodic);
  void
  addColor(const Options& options,
           pcl_uvol::Dataset& surface,
           pcl_uvol::Report& report);
  bool
  hasColorOfSamples() const;
  /** @} */

  /** \brief Draw it; a surface without points leaves no picture, with a warning.
   * \param surface stretched already by the factors of getLook()
   * \param report gets the times, named picture_...
   * \return what it was drawn on; "" for none */
  std::string
  draw(const Options& options,
       const pcl_uvol::Dataset& surface,
       pcl_uvol::Report& report) const;

  RenderOptions&
  getLook()
  {
    return look_;
  }

private:
  std::string path_;
  bool is_ray_traced_ = false;
  RenderOptions look_;
  RayOptions rays_;
};

} // namespace uvol_tools
