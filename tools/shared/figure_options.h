// SPDX-License-Identifier: BSD-3-Clause
// What explains a picture on the command line: axes, box, directions, lengths, a title,
// and several views side by side.
#pragma once

#include "charts/figure.h"
#include "charts/paper.h"
#include "shared/options.h"

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief -ticks, -box, -triad, -scale-bar, -unit, -title and -views. */
class FigureOptions {
public:
  void
  declare(Options& options);

  /** \brief The names of these options. */
  static const std::vector<std::string>&
  names();

  /** \brief What must parse, and fit together and into a picture of that size.
   * \throws UsageError */
  void
  check(const Options& options, const Paper& paper);

  /** \brief After check(). */
  const Figure&
  get() const
  {
    return figure_;
  }

private:
  Figure figure_;
  std::string views_text_;
};

} // namespace uvol_tools
