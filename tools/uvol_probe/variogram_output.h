// SPDX-License-Identifier: BSD-3-Clause
// The variograms of kriging: told, as a table, and as a picture.
#pragma once

#include "charts/paper.h"
#include "interpolation/variogram.h"
#include "shared/facts.h"
#include "shared/options.h"
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <string>

namespace uvol_tools {

/** \brief -variogram-csv and -variogram-png. */
class VariogramOutput {
public:
  void
  declare(Options& options);

  /** \brief To be called before any file is read.
   * \param paper of the picture
   * \throws UsageError without kriging, and IOError for a path that cannot be written
   */
  void
  finish(const Options& options,
         pcl_uvol::InterpolationModel model,
         const Paper& paper);

  bool
  isDrawn() const
  {
    return !picture_.empty();
  }

  bool
  isAskedFor() const
  {
    return !table_.empty() || !picture_.empty();
  }

  /** \brief Write table and picture of the first field, as far as they are asked for.
   * \param is_stretched whether distances are those of a stretched space
   * \throws InvalidArgument if one is asked for of a field that is constant
   * \return kind, nugget, partial sill and range of every field; none of other models
   */
  Facts
  write(const pcl_uvol::detail::FieldInterpolator& interpolator,
        bool is_stretched) const;

private:
  std::string table_, picture_;
  Paper paper_;
};

} // namespace uvol_tools
