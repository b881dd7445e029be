// SPDX-License-Identifier: BSD-3-Clause
// What tools from one file of points to another have in common.
#pragma once

#include "shared/memory_guard.h"
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
  /** \brief Declares the files "in" and "out".
   * \param task that takes memory, as in "Estimating normals" */
  PointJob(Options& options, std::string task);
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

  /** \brief Check the name of the output and the memory that the points take, before
   * they are read and after.
   * \param bytes that the tool takes, see MemoryGuard
   * \throws IOError, NotEnoughMemory, InvalidArgument for a file without points */
  pcl_uvol::Dataset
  read(const MemoryGuard::Bytes& bytes);

  /** \brief The same once more, if the points have more fields now. */
  void
  check(const pcl_uvol::Dataset& points);

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
  MemoryGuard memory_;
  MemoryGuard::Bytes bytes_;
  ProgressBar bar_;
  std::optional<pcl_uvol::StepTimer> total_;
  std::string input_, output_;
  bool ascii_ = false;
  std::size_t points_ = 0; ///< in the file
};

} // namespace uvol_tools
