// SPDX-License-Identifier: BSD-3-Clause
// Figures of surfaces as lines for people and as a table for programs.
#pragma once

#include "shared/facts.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace uvol_tools {

/** \brief Measure a mesh.
 * \param samples to look for inside; null: none
 * \param isovalues that the vertices hold in single precision; figures have them
 * exactly
 * \param report gets counts, times and warnings */
pcl_uvol::SurfaceFigures
measureSurface(const std::shared_ptr<const pcl_uvol::Dataset>& vertices,
               const std::vector<pcl_uvol::Triangle>& triangles,
               const std::shared_ptr<const pcl_uvol::Dataset>& samples,
               const std::vector<double>& isovalues,
               const pcl_uvol::SurfaceMeasuresParameters& parameters,
               unsigned threads,
               pcl_uvol::Report& report);

/** \brief A row per surface or piece, and named columns of equal length: isovalue,
 * piece
 * (-1 for all of an isovalue), counts, area, volume, centroid, bounds, half axes and
 * axes, samples inside, and for each field its mean and integrals on the surface and
 * inside, and its sum over the samples inside; of isovalues also the samples beyond the
 * isovalue and their sums. Errors are in columns named ..._error.
 */
class MeasureTable {
public:
  explicit MeasureTable(const std::vector<pcl_uvol::PieceMeasures>& isovalues);

  /** \param columns x, y and z among them */
  explicit MeasureTable(Fact::Members columns)
      : columns_(std::move(columns))
  {
  }

  /** \brief Add rows for pieces. */
  void
  append(const std::vector<pcl_uvol::PieceMeasures>& pieces);

  /** \brief Add the rows of another table; NaN where one has no such column. */
  void
  append(const MeasureTable& rows);

  /** \brief Put a column before the others, of one number in all rows. */
  void
  prepend(const std::string& name, double number);

  const Fact::Members&
  getColumns() const
  {
    return columns_;
  }

  /** \brief A column; null if there is none of that name. */
  const Fact::Numbers*
  find(const std::string& name) const;

  /** \brief The rows as points at the centroids, with the other columns as fields. */
  pcl_uvol::Dataset
  toDataset() const;

private:
  std::size_t
  countRows() const
  {
    return columns_.empty() ? 0 : columns_.front().second.size();
  }

  /** A column, which is made if there is none. */
  Fact::Numbers&
  column(const std::string& name);

  void
  addRow(const pcl_uvol::PieceMeasures& measures, double piece);

  Fact::Members columns_;
};

/** \brief A number and its standard error, with as many digits as this leaves. */
std::string
describe(const pcl_uvol::Measure& measure);

/** \brief Lines for people, with fields where there are few isovalues, and the table
 * for programs: "surfaces" and "pieces". */
Facts
describeMeasures(const pcl_uvol::SurfaceFigures& figures);

} // namespace uvol_tools
