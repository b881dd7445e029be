// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/derived_source.h"

#include "common/printable.h"
#include "expressions/evaluation.h"
#include "expressions/operand_names.h"

namespace pcl_uvol {

DerivedSource::DerivedSource(PointSource& source,
                             const std::string& expression,
                             unsigned threads)
    : source_(source)
    , header_(source.getHeader())
    , field_(withoutQuotes(header_.cloud.fields, expression))
    , formula_(findFormula(header_, field_, {threads, {}, {}}))
    , threads_(threads)
{
  if (!formula_)
    return;
  field_ = formula_->text;
  if (formula_->hasDerivative())
    throw InvalidArgument("derivatives_of_blocks", {{"field", shortenText(field_)}});
  addField(header_.cloud);
}

std::uint64_t
DerivedSource::addField(pcl::PCLPointCloud2& block) const
{
  if (!formula_)
    return 0;
  Dataset dataset;
  dataset.cloud = std::move(block);
  std::uint64_t undefined = 0;
  Report report;
  const CloudView cloud = viewOf(dataset.cloud);
  setField(dataset,
           field_,
           evaluateFormula(*formula_,
                           {cloud, cloud, {}},
                           Missing::Everything,
                           threads_,
                           undefined,
                           report)
               .front());
  block = std::move(dataset.cloud);
  return undefined;
}

std::size_t
DerivedSource::read(std::size_t count, pcl::PCLPointCloud2& block)
{
  const std::uint64_t begin = source_.tell();
  const std::size_t taken = source_.read(count, block);
  const std::uint64_t undefined = addField(block);
  if (begin >= seen_) { // points may be read again
    seen_ = begin + taken;
    undefined_ += undefined;
  }
  return taken;
}

void
DerivedSource::readRows(const std::vector<std::uint64_t>& points,
                        pcl::PCLPointCloud2& rows)
{
  source_.readRows(points, rows);
  addField(rows);
}

void
DerivedSource::addTo(Report& report) const
{
  warnOfUndefined(field_, undefined_, size(), report);
}

} // namespace pcl_uvol
