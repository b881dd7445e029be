// SPDX-License-Identifier: BSD-3-Clause
// One command line for many files, whose names differ in a number.
#pragma once

#include "shared/options.h"
#include "shared/picture_series.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A name with one place for a number, as snap_{:04d}.h5 or step{}.csv. */
class NumberedName {
public:
  /** \brief True if there is such a place: {}, {:d}, {:4d} or {:04d}. */
  static bool
  isOne(const std::string& text);

  explicit NumberedName(const std::string& text);

  std::string
  insert(std::size_t number) const;

  /** \brief Numbers of the files that are there, ascending. */
  std::vector<std::size_t>
  findNumbers() const;

private:
  std::string before_, after_;
  std::size_t digits_ = 0; ///< at least, filled up with fill_
  char fill_ = ' ';
};

/** \brief A file of a series. */
struct SeriesStep {
  std::size_t number;         ///< in its name
  std::optional<double> time; ///< that its header names
  PictureSeries& pictures;    ///< that are drawn when all files have been read
};

/** \brief As runTool(), and once per number where names on the command line have a
 * place for one; {t}, in any argument, is the time that the header of the input names.
 * -snapshots chooses the numbers, the files that are there by default; -keep-going
 * passes over failures. Points in .vtp are listed in a .pvd for ParaView, with the
 * times if all inputs name one, else the numbers.
 *
 * \param run gets the file of the series; null without one
 *
 * \return that of the first failure */
int
runSeries(const char* tool,
          int argc,
          char** argv,
          const std::function<int(int argc, char** argv, SeriesStep*)>& run);

/** \brief The options of runSeries(), for -h. */
void
declareSeries(Options& options);

} // namespace uvol_tools
