// SPDX-License-Identifier: BSD-3-Clause
// What tools from one file of points to another have in common.
#pragma once

#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/io/dataset.h>

#include <cstddef>
#include <optional>
#include <string>

namespace uvol_tools {

/** \brief Points are checked, read, written and reported. The steps are called in this
 * order. */
class PointJob {
public:
  /** \brief Declares the files "in" and "out". */
  explicit PointJob(Options& options);
  PointJob(const PointJob&) = delete;
  PointJob&
  operator=(const PointJob&) = delete;

  /** \brief Declares -where and the others of InputOptions, below the heading of
   * inputs: without it all points are read.
   * \param field gets -field before them, see declareField(); null: there is none */
  void
  declareInput(std::string* field = nullptr);

  /** \brief Declares -ascii, below the heading of outputs. */
  void
  declareOutput();

  /** \brief Check whether the output can hold the points, before and after they are
   * read.
   * \throws IOError, NotEnoughMemory, InvalidArgument for a file without points */
  pcl_uvol::Dataset
  read();

  /** \brief Write the result and print the report.
   * \return the exit code of the tool */
  int
  finish(const pcl_uvol::Dataset& result);

  const std::string&
  getInput() const
  {
    return input_;
  }
  const std::string&
  getOutput() const
  {
    return output_;
  }

  pcl_uvol::Report report; ///< tells a progress bar how far it is
  Facts facts;             ///< begin with the files, and end with the memory

private:
  Options& options_;
  std::optional<InputOptions> reading_;
  ProgressBar bar_;
  std::optional<pcl_uvol::StepTimer> total_;
  std::string input_, output_;
  bool ascii_ = false;
  std::size_t points_ = 0; ///< in the file
};

} // namespace uvol_tools
