// SPDX-License-Identifier: BSD-3-Clause
// Fields that are computed from those of a data set: expressions such as `log10(rho)`
// and derivatives such as `Q(vel)`.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief An expression that cannot be understood, and the place where. message() and
 * what() end with two more lines: the expression, and a caret under the place. */
class PCL_UVOL_EXPORTS ExpressionError : public InvalidArgument {
public:
  /** \param code row of the table of messages, whose text ends with the line
   * {marked_lines}
   * \param values all others that the text holds
   * \param expression as it was given
   * \param place byte of the expression, at most its length */
  ExpressionError(std::string code,
                  std::vector<MessageValue> values,
                  const std::string& expression,
                  std::size_t place);

  /** \return What is wrong and what helps, without the marked lines. */
  const std::string&
  getSentence() const
  {
    return sentence_;
  }

  /** \brief The expression, as much of it as fits on a line, and under it the caret. */
  const std::string&
  getMarkedLines() const
  {
    return marked_;
  }

private:
  std::string marked_, sentence_;
};

/** \brief How derived fields are computed. */
struct PCL_UVOL_EXPORTS DerivedFieldOptions {
  unsigned threads = 0; ///< 0: all cores
  /** Why points have no derivatives, as a subordinate clause without its end:
   * "because these points are a surface"; empty (default): they have. */
  std::string no_derivatives;
  /** Sides of the box that points repeat in, 0 along an axis for none: derivatives see
   * neighbours across its faces. Coordinates outside of derivatives stay those of the
   * points, in derivatives they go on beyond the faces. */
  std::array<double, 3> periodic{};
};

/** \brief Make sure that a data set has a field.
 *
 * A name that ScalarField knows is that field. Any other text is an expression of
 * muParser: numbers, + - * / ^, comparisons, && || !, ?:, and functions such as log10,
 * ln, exp, sqrt, abs, sin, atan2, min, max and sum. In an expression
 * - fields have their names, or their names between double quotes;
 * - `vel[1]` is a component, `|vel|` and `|a,b,c|` are lengths;
 * - `x`, `y`, `z` are coordinates with the origin added, `pi` and `inf` constants;
 * - grad(f), curl(v), div(v) and laplacian(f) are derivatives;
 * - curvature(f) is the mean curvature of the level sets of f, half the divergence of
 * the normalised gradient (thesis 3.6);
 * - Q(v) is minus half the trace of the squared gradient (Hunt et al. 1988);
 * - lambda2(v) is the middle eigenvalue of S^2 + W^2, of the symmetric and the
 * antisymmetric part of the gradient (Jeong and Hussain 1995).
 *
 * Here f is an expression. v is a field of three components, three components
 * (`Q(vx,vy,vz)`), or a grad or curl. Derivatives are per unit of length, of the fits
 * of detail::computeDerivatives.
 *
 * The result is added as a float64 field whose name is the text of the expression,
 * without blanks around it, and without double quotes that are not needed. It is NaN
 * where a field that it needs is missing, and where the result is not finite. A field's
 * name between double quotes is that field.
 * \param dataset gets the field
 * \param expression name of a field, or what to compute
 * \param options threads, the box, and why there are no derivatives
 * \return the name of the field
 * \param report gets the time "derived_fields", and warnings that say where an
 * expression has no value
 * \throws ExpressionError, and InvalidArgument where there are fewer than four samples
 * for derivatives, if derivatives are not available, or for an invalid side of the box
 */
PCL_UVOL_EXPORTS std::string
addDerivedField(Dataset& dataset,
                const std::string& expression,
                const DerivedFieldOptions& options,
                Report& report);

/** \brief Keep the points for which an expression holds, e.g. "experiment=1 && T>=4",
 * see addDerivedField; = and == mean the same. NaN satisfies nothing but !=. A field
 * that is compared with a number is compared with the float nearest to it where the
 * field is float32. A field of names, see Dataset::labels, is compared by = and != with
 * a name, `hole="A-117"`, whose quotes may be left out; `hole=""` means no name.
 * \param dataset loses the other points
 * \param where the expression
 * \param options as of addDerivedField()
 * \param report gets the progress of derivatives
 * \return the number of points removed
 * \throws as addDerivedField, and for an expression without a comparison */
PCL_UVOL_EXPORTS std::size_t
selectRows(Dataset& dataset,
           const std::string& where,
           const DerivedFieldOptions& options,
           Report& report);

} // namespace pcl_uvol
