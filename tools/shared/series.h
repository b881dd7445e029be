// SPDX-License-Identifier: BSD-3-Clause
// One command line for many files, whose names differ in a number.
#pragma once

#include "shared/options.h"

#include <cstddef>
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

/** \brief As runTool(), and once per number where names on the command line have a
 * place for one. -snapshots chooses the numbers, the files that are there by default;
 * -keep-going passes over failures. Points in .vtp are listed in a .pvd for ParaView.
 * \return that of the first failure */
int
runSeries(const char* tool, int argc, char** argv, int (*run)(int argc, char** argv));

/** \brief The options of runSeries(), for -h. */
void
declareSeries(Options& options);

} // namespace uvol_tools
