// SPDX-License-Identifier: BSD-3-Clause
// The field between scattered samples: values, gradients and standard errors anywhere,
// of any number of fields in one pass.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief What an interpolated value rests on. The first three are those of IsoSupport,
 * no other number is: 4 is IsoSupport::Predicted. */
enum class FieldSupport : std::uint8_t {
  Measured = 1, ///< samples all around
  Bridged = 2,  ///< in a gap of the sampling: samples around, but far
  Rim = 3,      ///< beside a wide cone without samples: border of a gap or of the cloud
  Reduced = 5,  ///< samples all around that do not determine the model, as on few
                ///< planes: a simpler one
  Invalid = 6,  ///< no place: the coordinates are not finite, or too far out
  Outside = 7   ///< beside such a cone and far from the samples, or beyond their convex
                ///< hull where the model ends there: no value unless extrapolated
};

/** \brief Fields at queries. */
struct PCL_UVOL_EXPORTS InterpolatedFields {
  std::vector<std::string> names; ///< of the fields
  std::size_t size = 0;           ///< queries
  std::vector<double> values;     ///< [field][query], in units of the field; NaN: none
  std::vector<double> errors;     ///< [field][query], standard errors of the values;
                                  ///< NaN if not available; empty if not
                                  ///< asked for
  std::vector<double> gradients;  ///< [field][query][axis], field / length; empty if
                                  ///< not asked for
  std::vector<FieldSupport> support; ///< [query]

  /** \brief A value, in units of the field; NaN: none.
   * \param field index into names
   * \param query below size */
  double
  getValue(std::size_t field, std::size_t query) const
  {
    return values[field * size + query];
  }

  /** \brief A standard error, in units of the field; NaN where the model does not
   * estimate them. Errors must have been requested.
   * \param field index into names
   * \param query below size */
  double
  getError(std::size_t field, std::size_t query) const
  {
    return errors[field * size + query];
  }

  /** \brief A gradient, in units of the field per length. Gradients must
   * have been asked for.
   * \param field index into names
   * \param query below size */
  std::array<double, 3>
  getGradient(std::size_t field, std::size_t query) const
  {
    const double* const gradient = &gradients[3 * (field * size + query)];
    return {gradient[0], gradient[1], gradient[2]};
  }
};

/** \brief Append interpolated fields to the points they were asked for: `rho`
 * (float64), `rho_error` (float64), `rho_gradient` (3 x float64), as far as there are,
 * and `support` (uint8, a FieldSupport). Where the points have a field of such a name
 * already, `rho_2`, `rho_2_error` and so on are appended.
 * \param fields as interpolate() gives them
 * \param points those that were asked for, in their order
 * \return the names of the appended fields
 * \throws InvalidArgument unless there is a value per point */
PCL_UVOL_EXPORTS std::vector<std::string>
appendFields(const InterpolatedFields& fields, pcl::PCLPointCloud2& points);

namespace detail {

class SampleCells;
struct FittedVariogram;

/** \brief Queries of a lattice that are answered at a time. */
constexpr std::size_t lattice_block = std::size_t{1} << 18;

/** \brief How many samples matter to queries: all of them, those about a plane or those
 * about a line. */
enum class QueryShape { Space, Plane, Line };

/** \brief Queries that will be answered at a time, as far as they are known before. */
struct ExpectedQueries {
  QueryShape shape = QueryShape::Line;
  double count = 0.0;
};

/** \brief Models of the fields of a cloud, ready for queries: trees and fits are kept.
 */
class PCL_UVOL_EXPORTS FieldInterpolator {
public:
  /** \param indices points to take part: a field is interpolated from those of them
   * that have a finite value of it
   * \param report gets the counts "non_finite", "duplicates" and
   * "conflicting_duplicates" of fields with different samples one after another
   * \param expected queries that memory is checked for, with the models
   * \throws InvalidArgument as FieldInterpolation::interpolate */
  FieldInterpolator(const CloudView& cloud,
                    const pcl::Indices& indices,
                    const InterpolationParameters& parameters,
                    unsigned threads,
                    Report& report,
                    const ExpectedQueries& expected = {});
  FieldInterpolator(const FieldInterpolator&) = delete;
  FieldInterpolator&
  operator=(const FieldInterpolator&) = delete;
  ~FieldInterpolator();

  /** \brief Let cells decide where the data are instead of the samples. Positions
   * inside of a cell have a value, with FieldSupport::Bridged if they are outside by
   * the samples alone. Positions outside of all cells have no value unless
   * extrapolated.
   * \param cells of the same samples; null: the samples decide */
  void
  setCells(std::shared_ptr<const SampleCells> cells)
  {
    cells_ = std::move(cells);
  }

  /** \brief Answer queries.
   * \param queries coordinates like those of the cloud
   * \param report gets the counts of FieldInterpolation */
  InterpolatedFields
  interpolate(const std::vector<std::array<double, 3>>& queries,
              unsigned threads,
              Report& report) const;

  /** \brief The place of a query, in coordinates like those of the cloud. */
  using PlaceOf = std::function<std::array<double, 3>(std::size_t query)>;

  /** \brief Gets the answers to some consecutive queries.
   * \param first index of the first of them */
  using TakeAnswers =
      std::function<void(std::size_t first, const InterpolatedFields& answers)>;

  /** \brief Answer queries whose positions are requested in blocks, in their order, for
   * example those of a lattice. So memory does not grow with their number. */
  void
  interpolate(std::size_t queries,
              const PlaceOf& place_of,
              unsigned threads,
              Report& report,
              const TakeAnswers& take) const;

  /** \brief The variogram of a field, and the experimental variogram, in units of the
   * field and of the stretched space. Empty if the model has no variogram. */
  std::optional<FittedVariogram>
  findVariogram(std::size_t field) const;

  /** \brief The fields, in the order of the answers. */
  const std::vector<std::string>&
  getNames() const
  {
    return names_;
  }

private:
  struct Group;

  InterpolatedFields
  answer(const std::vector<std::array<double, 3>>& queries,
         unsigned threads,
         StepTimer& step) const;

  InterpolationParameters parameters_;
  std::vector<std::string> names_;
  std::vector<Group> groups_;
  std::shared_ptr<const SampleCells> cells_;
};

/** \brief Places of the points of a cloud. */
PCL_UVOL_EXPORTS std::vector<std::array<double, 3>>
readPlaces(const CloudView& cloud);

} // namespace detail

/** \brief Interpolates fields given at scattered points, at any other places.
 *
 * \code
 * pcl_uvol::FieldInterpolation<pcl::PointXYZI> interpolation;
 * interpolation.setInputCloud(samples);
 * interpolation.setFields({"intensity"});
 * pcl_uvol::InterpolatedFields result;
 * interpolation.interpolate(queries, result);
 * \endcode
 * Samples at exactly the same position count as one, with the median of their
 * values. Of two values this is the mean, which may be no class. The tree and what the
 * model keeps serve further queries until samples, indices or parameters change; a
 * cloud that changes in place has to be set again. An answer depends on its query
 * alone.
 *
 * Memory: about 50 bytes per sample and 8 per sample and field; the model's own; 40
 * bytes per query and field with gradients and errors. */
template <typename PointT>
class FieldInterpolation : public CloudStage<PointT>,
                           public ParameterStage<InterpolationParameters> {
public:
  using Ptr = std::shared_ptr<FieldInterpolation<PointT>>;
  using ConstPtr = std::shared_ptr<const FieldInterpolation<PointT>>;

  /** \brief Any fields of the cloud, see ScalarField; default: no names, which means
   * the field of ScalarField::defaultName. */
  void
  setFields(const std::vector<std::string>& fields)
  {
    parameters_.fields = fields;
  }

  /** \return The fields that are interpolated; none: ScalarField::defaultName. */
  const std::vector<std::string>&
  getFields() const
  {
    return parameters_.fields;
  }

  /** \brief Default: InterpolationModel::Fit. */
  void
  setModel(InterpolationModel model)
  {
    parameters_.model = model;
  }

  /** \return The model that values come from. */
  InterpolationModel
  getModel() const
  {
    return parameters_.model;
  }

  /** \brief Give values outside of the data as well. Default: NaN there. */
  void
  setExtrapolate(bool extrapolate)
  {
    parameters_.extrapolate = extrapolate;
  }

  /** \return Whether there are values outside of the data. */
  bool
  getExtrapolate() const
  {
    return parameters_.extrapolate;
  }

  /** \brief Interpolate at the points of a cloud. A query without a place gets NaN, and
   * so does one outside of the data, unless extrapolation was asked for.
   * \param queries places to interpolate at, in the coordinates of the samples
   * \param result values, standard errors, gradients and support of each query
   * \throws InvalidArgument without an input cloud, for an unknown field, a field
   * without a finite value, a parameter out of range; the result is then untouched
   *
   * Counts of the report: non_finite, duplicates, conflicting_duplicates (of samples),
   * queries, measured, bridged, rim, outside, reduced, invalid. @{ */
  template <typename QueryT>
  void
  interpolate(const pcl::PointCloud<QueryT>& queries, InterpolatedFields& result)
  {
    interpolateAt(detail::readPlaces(viewOf(queries)), result);
  }

  void
  interpolate(const pcl::PCLPointCloud2& queries, InterpolatedFields& result)
  {
    interpolateAt(detail::readPlaces(viewOf(queries)), result);
  }
  /** @} */

  /** \brief The same at places in double, in the coordinates of the samples.
   * \param queries places, x, y, z each
   * \param result as of interpolate() */
  void
  interpolateAt(const std::vector<std::array<double, 3>>& queries,
                InterpolatedFields& result);

private:
  void
  forgetInput() override
  {
    interpolator_.reset();
  }

  // What the interpolator was made of.
  typename CloudStage<PointT>::Cloud::ConstPtr cloud_;
  pcl::Indices used_;
  Parameters made_for_;
  std::unique_ptr<detail::FieldInterpolator> interpolator_;
  Report made_; ///< counts and warnings of making it
};

template <typename PointT>
void
FieldInterpolation<PointT>::interpolateAt(
    const std::vector<std::array<double, 3>>& queries, InterpolatedFields& result)
{
  this->withInput("FieldInterpolation",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    startReport();
                    if (!interpolator_ || cloud_ != this->input_ || used_ != indices ||
                        made_for_ != parameters_) {
                      interpolator_.reset();
                      Report made;
                      made.progress = report_.progress;
                      interpolator_ = std::make_unique<detail::FieldInterpolator>(
                          cloud, indices, parameters_, threads_, made);
                      cloud_ = this->input_;
                      used_ = indices;
                      made_for_ = parameters_;
                      report_.merge(made);
                      made_ = made;
                      made_.milliseconds.clear();
                    }
                    else
                      report_.merge(made_);
                    result = interpolator_->interpolate(queries, threads_, report_);
                  });
}

} // namespace pcl_uvol
