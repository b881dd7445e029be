// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a dataset as writers put them into files.
#pragma once

#include "common/records.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/io/dataset.h>

namespace pcl_uvol {
namespace io {

class OutputFile;

/** \brief One number per point of a file to be written. */
struct Column {
  std::string name;
  std::uint8_t datatype; ///< in the file
  std::size_t offset;    ///< in the point
  std::uint8_t stored;   ///< datatype in the point; another one becomes a float64
  double addend;         ///< of a number that becomes a float64
  const std::vector<std::string>* labels =
      nullptr; ///< names that the numbers stand for
};

/** \brief Tells of points that are written, one after another. */
class WriteProgress {
public:
  WriteProgress(std::size_t count, const SaveOptions& options)
      : report_([&] {
        Report report;
        report.progress = options.progress;
        return report;
      }())
      , step_(report_, "write", count)
  {
  }

  void
  advance()
  {
    constexpr std::size_t together = 1u << 14;
    if (++written_ % together == 0)
      step_.advance(together);
  }

private:
  Report report_;
  StepTimer step_;
  std::size_t written_ = 0;
};

/** \brief The numbers of savedFields() or heldFields(); components are called name_0,
 * name_1, ... */
std::vector<Column>
findColumns(const Dataset& dataset, const Fields& fields);

/** \brief Replace blanks and control characters by `_`, keep the names different.
 * \param[out] comments gets a line per name that changed */
void
makeWords(std::vector<std::string>& names, std::vector<std::string>& comments);

/** \brief Append the number of a column, as it is in the file, as text. */
void
appendNumber(std::string& text, const Column& column, const std::uint8_t* point);

/** \brief The bytes of the columns of some points, one behind the other. */
std::string
packRecords(const Dataset& dataset,
            const std::vector<Column>& columns,
            std::size_t first,
            std::size_t count);

/** \brief Write the columns of every point: as text a line of numbers between blanks,
 * else their bytes one behind the other. */
void
writeRecords(OutputFile& file,
             const Dataset& dataset,
             const std::vector<Column>& columns,
             const SaveOptions& options);

} // namespace io
} // namespace pcl_uvol
