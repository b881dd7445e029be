// SPDX-License-Identifier: BSD-3-Clause
// Derived fields of points that come block by block.
#pragma once

#include "common/point_source.h"
#include "expressions/formula.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/expressions/derived_fields.h>

#include <optional>

namespace pcl_uvol {

/** \brief The formula of an expression; none where it is a field that is there, or
 * empty.
 * \throws as addDerivedField */
std::optional<Formula>
findFormula(const Dataset& header,
            const std::string& expression,
            const DerivedFieldOptions& options);

/** \brief Warn of numbers that are not finite, if there are any. */
void
warnOfUndefined(const std::string& expression,
                std::uint64_t undefined,
                std::uint64_t points,
                Report& report);

/** \brief Points of another source with one more field, see addDerivedField. */
class PCL_UVOL_EXPORTS DerivedSource : public PointSource {
public:
  /** \param source must outlive this one
   * \throws as addDerivedField, and for derivatives, which need all points at once */
  DerivedSource(PointSource& source, const std::string& expression, unsigned threads);

  /** \brief What stages call the field. */
  const std::string&
  getField() const
  {
    return field_;
  }

  /** \brief Add the warnings for the points that were read from the front. */
  void
  addTo(Report& report) const;

  const Dataset&
  getHeader() const override
  {
    return header_;
  }

  std::uint64_t
  size() const override
  {
    return source_.size();
  }

  std::uint64_t
  tell() const override
  {
    return source_.tell();
  }

  void
  seek(std::uint64_t point) override
  {
    source_.seek(point);
  }

  std::size_t
  read(std::size_t count, pcl::PCLPointCloud2& block) override;

  void
  readRows(const std::vector<std::uint64_t>& points,
           pcl::PCLPointCloud2& rows) override;

private:
  std::uint64_t
  addField(pcl::PCLPointCloud2& block) const;

  PointSource& source_;
  Dataset header_;
  std::string field_;
  std::optional<Formula> formula_;
  unsigned threads_;
  std::uint64_t seen_ = 0, undefined_ = 0; ///< points behind which none were counted
};

} // namespace pcl_uvol
