// SPDX-License-Identifier: BSD-3-Clause
// The size of a picture on the command line, in pixels or as it is printed.
#pragma once

#include "charts/paper.h"
#include "shared/options.h"

#include <string>
#include <utility>

namespace uvol_tools {

/** \brief -size, or an option of another name, and -dpi. */
class SizeOption {
public:
  /** \param usual size; "": as large as is usual for what is drawn
   * \param name of the option */
  explicit SizeOption(std::string usual = "", std::string name = "size")
      : name_(std::move(name))
      , text_(std::move(usual))
  {
  }

  /** \brief The size of what is shown, and not printed. */
  void
  declarePixels(Options& options);

  /** \brief The size in pixels or as lengths, for tools that call declareDpi(). */
  Options&
  declareSize(Options& options);

  void
  declareDpi(Options& options);

  /** \brief Both, of a chart. */
  void
  declareChart(Options& options);

  /** \brief What must parse: to be called before work whose result would be lost.
   * \throws UsageError */
  void
  parse();

  /** \brief The same of a chart, which has room for letters.
   * \param asked_by the option that asks for a chart
   * \param is_asked_for without it there is nothing that has a size
   * \throws UsageError */
  void
  checkChart(const Options& options, const std::string& asked_by, bool is_asked_for);

  /** \brief After parse(); 0 x 0 where what is drawn says its size. */
  const Paper&
  get() const
  {
    return paper_;
  }

private:
  /** Into pixels; false for what is no size. */
  bool
  read();

  std::string name_, text_;
  bool takes_lengths_ = false;
  Paper paper_;
};

} // namespace uvol_tools
