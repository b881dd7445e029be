// SPDX-License-Identifier: BSD-3-Clause
// Gradients of a scattered scalar field, and the mean curvature of its level sets, at
// the samples themselves (thesis 3.2, 3.3).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>

#include <pcl/search/search.h>
#include <pcl/type_traits.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief Which polynomial is fitted to the neighbours. */
enum class FitScheme {
  Linear,   ///< thesis 3.2: a plane through the sample and its neighbours, unweighted;
            ///< first order, little noise
  Quadratic ///< nine terms that pass through the sample's own value, weight
            ///< exp(-2 d^2 / h^2), h a little more than the farthest neighbour; second
            ///< order, with second derivatives (default)
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<FitScheme>, 2>
listWords(FitScheme)
{
  return {{{FitScheme::Linear, "linear"}, {FitScheme::Quadratic, "quadratic"}}};
}

/** \brief Parameters of GradientEstimation. */
struct PCL_UVOL_EXPORTS GradientParameters {
  std::string field = "intensity"; ///< see ScalarField
  FitScheme scheme = FitScheme::Quadratic;
  /** Nearest neighbours besides the sample, all others where there are fewer: at least
   * 3, with the quadratic scheme 9; 26 as in the thesis. */
  std::size_t k = 26;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = GradientParameters;
    return std::make_tuple(Member{"field", &Own::field},
                           Member{"scheme", &Own::scheme},
                           Member{"k", &Own::k});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static GradientParameters
  fromJson(const std::string& text);
};

namespace detail {

/** \brief The kernel of GradientEstimation for any cloud.
 * \param indices points to take part, as neighbours and in the result
 * \param search null: FLANN
 * \return one gradient per index
 * \throws InvalidArgument as GradientEstimation::compute */
PCL_UVOL_EXPORTS std::vector<PointGradient>
estimateGradients(const CloudView& cloud,
                  const pcl::Indices& indices,
                  const GradientParameters& parameters,
                  const pcl::search::Search<pcl::PointXYZ>::Ptr& search,
                  unsigned threads,
                  Report& report);

} // namespace detail

/** \brief Gradient of a scalar field given at scattered points, in the manner of
 * pcl::IntensityGradientEstimation, but for a field of the volume.
 *
 * The gradient of a least-squares polynomial through the nearest samples; see FitScheme
 * for the two there are. Mean curvature is half the divergence of the normalised
 * gradient (thesis 3.6): with the quadratic scheme from the polynomial's second
 * derivatives, with the linear one from the gradients of the neighbours' normalised
 * gradients (thesis 3.3). Where samples lie on a plane or a line, the derivatives
 * across it are 0. Exact duplicates count as one sample, with the median of their
 * values.
 * \tparam PointInT with x, y, z
 * \tparam PointOutT with gradient_x/y/z; with mean_curvature it gets that too */
template <typename PointInT, typename PointOutT = PointGradient>
class GradientEstimation : public CloudStage<PointInT>,
                           public ParameterStage<GradientParameters> {
public:
  using Ptr = std::shared_ptr<GradientEstimation<PointInT, PointOutT>>;
  using ConstPtr = std::shared_ptr<const GradientEstimation<PointInT, PointOutT>>;

  /** \brief Any field of the cloud, see ScalarField. Default `intensity`. */
  void
  setScalarField(const std::string& field)
  {
    parameters_.field = field;
  }

  /** \return The field whose derivatives are estimated. */
  const std::string&
  getScalarField() const
  {
    return parameters_.field;
  }

  /** \brief Nearest neighbours besides the sample, all others where there are fewer: at
   * least 3, with the quadratic scheme 9. Default 26, as in the thesis. */
  void
  setKSearch(std::size_t k)
  {
    parameters_.k = k;
  }

  /** \return The number of nearest neighbours of a fit. */
  std::size_t
  getKSearch() const
  {
    return parameters_.k;
  }

  /** \brief Default FitScheme::Quadratic. */
  void
  setScheme(FitScheme scheme)
  {
    parameters_.scheme = scheme;
  }

  /** \return The degree of the fits. */
  FitScheme
  getScheme() const
  {
    return parameters_.scheme;
  }

  /** \brief How neighbours are found. The search gets the distinct samples as its input
   * cloud and is called from several threads. Default: null, which is FLANN's exact
   * search. */
  void
  setSearchMethod(const pcl::search::Search<pcl::PointXYZ>::Ptr& search)
  {
    search_ = search;
  }

  /** \return What finds neighbours; null: FLANN's exact search. */
  const pcl::search::Search<pcl::PointXYZ>::Ptr&
  getSearchMethod() const
  {
    return search_;
  }

  /** \brief One output point per input point or index. A point without finite
   * coordinates or value gets NaN, as does an only sample, and the output is then not
   * dense. With the quadratic scheme neighbours on a plane give a quadratic in it,
   * where nothing changes across the plane; where there are too few neighbours for a
   * quadratic the curvature is NaN.
   * \param output a gradient for each point; its width is that of the indices
   * \throws InvalidArgument without an input cloud, for an unknown field, no usable
   * sample, or k out of range; the output is then untouched
   *
   * Counts of the report: samples, no_value, non_finite, duplicates,
   * conflicting_duplicates, reduced_fits, singular_fits. */
  void
  compute(pcl::PointCloud<PointOutT>& output);

private:
  pcl::search::Search<pcl::PointXYZ>::Ptr search_;
};

template <typename PointInT, typename PointOutT>
void
GradientEstimation<PointInT, PointOutT>::compute(pcl::PointCloud<PointOutT>& output)
{
  std::vector<PointGradient> gradients;
  this->withInput("GradientEstimation",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    startReport();
                    gradients = detail::estimateGradients(
                        cloud, indices, parameters_, search_, threads_, report_);
                  });
  output.resize(gradients.size());
  const bool organized = gradients.size() == this->input_->size();
  output.width =
      organized ? this->input_->width : static_cast<std::uint32_t>(gradients.size());
  output.height = organized ? this->input_->height : 1;
  output.header = this->input_->header;
  output.is_dense = true;
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    output[i].gradient_x = gradients[i].gradient_x;
    output[i].gradient_y = gradients[i].gradient_y;
    output[i].gradient_z = gradients[i].gradient_z;
    output.is_dense = output.is_dense && std::isfinite(gradients[i].gradient_x);
    if constexpr (pcl::traits::has_field<PointOutT, pcl::fields::mean_curvature>::value)
      output[i].mean_curvature = gradients[i].mean_curvature;
  }
}

} // namespace pcl_uvol
