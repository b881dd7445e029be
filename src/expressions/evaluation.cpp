// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/evaluation.h"

#include "common/parallel.h"
#include "expressions/derivative_columns.h"
#include "expressions/program.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

namespace pcl_uvol {

namespace {

/** Points that a program, which has to be parsed again by every thread, is made for. */
constexpr std::size_t block_points = 1u << 12;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/** Derivatives first, which see all points, then everything else block by block. */
class Evaluation {
public:
  Evaluation(const FormulaPoints& points, unsigned threads, Report& report)
      : points_(points)
      , threads_(threads)
      , report_(report)
  {
  }

  Columns
  compute(const Formula& formula, Missing missing)
  {
    return compute(formula, points_.own, missing);
  }

  std::uint64_t
  countUndefined() const
  {
    return undefined_;
  }

private:
  Columns
  compute(const Formula& formula, const CloudView& cloud, Missing missing)
  {
    for (const Operand& operand : formula.operands)
      prepare(operand);
    Columns columns(formula.width(), std::vector<double>(cloud.count));
    std::atomic<std::uint64_t> undefined{0};
    const auto fill_rows = [&](std::size_t begin, std::size_t end) {
      std::vector<double*> targets;
      for (auto& column : columns)
        targets.push_back(column.data() + begin);
      return fill(formula, cloud, missing, begin, end - begin, targets);
    };
    parallelBlocks(cloud.count, block_points, threads_, [&](auto begin, auto end) {
      const std::size_t images = std::clamp<std::size_t>(points_.own.count, begin, end);
      undefined += fill_rows(begin, images);
      fill_rows(images, end);
    });
    undefined_ += undefined;
    return columns;
  }

  void
  prepare(const Operand& operand)
  {
    if (operand.kind == Operand::Kind::Field)
      return;
    if (operand.kind == Operand::Kind::Norm) {
      for (const Formula& argument : operand.arguments)
        for (const Operand& inner : argument.operands)
          prepare(inner);
      return;
    }
    Columns fields;
    for (const Formula& argument : operand.arguments)
      for (auto& column : compute(argument, points_.with_images, Missing::Everything))
        fields.push_back(std::move(column));
    derived_[&operand] = deriveColumns(
        operand.derivative, fields, points_, threads_, undefined_, report_);
  }

  /** The components of a formula at consecutive points.
   * \return how many numbers are undefined */
  std::uint64_t
  fill(const Formula& formula,
       const CloudView& cloud,
       Missing missing,
       std::size_t begin,
       std::size_t count,
       const std::vector<double*>& targets) const
  {
    if (formula.program.empty())
      return fill(formula.operands.front(), cloud, begin, count, targets);
    std::uint64_t undefined = 0;
    Columns operands;
    for (const Operand& operand : formula.operands) {
      operands.emplace_back(count);
      undefined += fill(operand, cloud, begin, count, {operands.back().data()});
    }
    Program program(formula.program, operands.size());
    for (std::size_t i = 0; i < count; ++i) {
      bool are_finite = true, are_there = true;
      for (std::size_t j = 0; j < operands.size(); ++j) {
        program.variables()[j] = operands[j][i];
        are_finite = are_finite && std::isfinite(operands[j][i]);
        are_there = are_there && !std::isnan(operands[j][i]);
      }
      const double value = program.compute();
      const bool has_value =
          std::isfinite(value) && (are_there || missing == Missing::Comparisons);
      targets[0][i] = has_value ? value : no_value;
      undefined += are_finite && !std::isfinite(value);
    }
    return undefined;
  }

  std::uint64_t
  fill(const Operand& operand,
       const CloudView& cloud,
       std::size_t begin,
       std::size_t count,
       const std::vector<double*>& targets) const
  {
    if (operand.kind == Operand::Kind::Norm)
      return fillNorm(operand, cloud, begin, count, targets[0]);
    const std::size_t first = operand.component.value_or(0);
    for (std::size_t c = 0; c < targets.size(); ++c)
      if (operand.kind == Operand::Kind::Derivative) {
        const auto& column = derived_.at(&operand)[first + c];
        std::copy_n(&column[begin], count, targets[c]);
      }
      else
        for (std::size_t i = 0; i < count; ++i)
          targets[c][i] = operand.components[first + c].read(cloud.point(begin + i)) +
                          operand.addends[first + c];
    return 0;
  }

  std::uint64_t
  fillNorm(const Operand& norm,
           const CloudView& cloud,
           std::size_t begin,
           std::size_t count,
           double* target) const
  {
    std::uint64_t undefined = 0;
    std::fill_n(target, count, 0.0);
    for (const Formula& argument : norm.arguments) {
      Columns columns(argument.width(), std::vector<double>(count));
      std::vector<double*> targets;
      for (auto& column : columns)
        targets.push_back(column.data());
      undefined += fill(argument, cloud, Missing::Everything, begin, count, targets);
      for (const auto& column : columns)
        for (std::size_t i = 0; i < count; ++i)
          target[i] += column[i] * column[i];
    }
    for (std::size_t i = 0; i < count; ++i)
      target[i] = std::sqrt(target[i]);
    return undefined;
  }

  const FormulaPoints& points_;
  unsigned threads_;
  Report& report_;
  std::uint64_t undefined_ = 0;
  std::map<const Operand*, Columns> derived_;
};

} // namespace

Columns
evaluateFormula(const Formula& formula,
                const FormulaPoints& points,
                Missing missing,
                unsigned threads,
                std::uint64_t& undefined,
                Report& report)
{
  Evaluation evaluation(points, threads, report);
  Columns columns = evaluation.compute(formula, missing);
  undefined += evaluation.countUndefined();
  return columns;
}

} // namespace pcl_uvol
