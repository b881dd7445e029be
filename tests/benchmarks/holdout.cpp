// SPDX-License-Identifier: BSD-3-Clause
// The hold-out test of isosurfaces: which samples that were left out lie on the right
// side, beside what the nearest sample and a Delaunay tetrahedralisation say.
#include "common/scalar_field.h"
#include "data_cases.h"
#include "pipeline/dataset_info.h"
#include "pipeline/hold_out.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace {

using pcl_uvol::Dataset;
using pcl_uvol::HeldOutSample;
using pcl_uvol::Interpolation;
using pcl_uvol::IsosurfacePipelineParameters;
using pcl_uvol::NormalMethod;
using pcl_uvol::ValidateBy;

using uvol_benchmark::DataCase;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<double, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<Vertex>,
                                   CGAL::Fast_location>;

/** Linear interpolation in the Delaunay tetrahedralisation of the samples that were not
 * left out; beyond their hull the nearest sample's class. */
class DelaunayClass {
public:
  DelaunayClass(const Dataset& samples,
                const IsosurfacePipelineParameters& parameters,
                const pcl_uvol::Folds& folds)
      : cloud_(pcl_uvol::viewOf(samples.cloud))
      , values_(pcl_uvol::readFieldValues(
            samples, pcl_uvol::ScalarField(cloud_.fields, parameters.isosurface.field)))
      , scale_(parameters.isosurface.scale)
      , folds_(folds)
      , isovalue_(parameters.isosurface.isovalues[0])
  {
  }

  bool
  isAbove(const HeldOutSample& sample)
  {
    leaveOut(folds_[sample.point]);
    const Kernel::Point_3 place = placeOf(sample.point);
    cell_ = delaunay_.locate(place, cell_);
    if (delaunay_.dimension() < 3 || delaunay_.is_infinite(cell_))
      return sample.is_nearest_above;
    const auto at = [&](int i) { return cell_->vertex(i)->point(); };
    double value = 0.0;
    const double whole = CGAL::volume(at(0), at(1), at(2), at(3));
    for (int i = 0; i < 4; ++i) {
      Kernel::Point_3 corner[4] = {at(0), at(1), at(2), at(3)};
      corner[i] = place;
      value += CGAL::volume(corner[0], corner[1], corner[2], corner[3]) / whole *
               cell_->vertex(i)->info();
    }
    return value >= isovalue_;
  }

private:
  Kernel::Point_3
  placeOf(std::size_t point) const
  {
    const float* const xyz = cloud_.xyz(point);
    return {xyz[0] * scale_[0], xyz[1] * scale_[1], xyz[2] * scale_[2]};
  }

  void
  leaveOut(std::size_t fold)
  {
    if (fold == fold_)
      return;
    fold_ = fold;
    std::vector<std::pair<Kernel::Point_3, double>> rest;
    for (std::size_t i = 0; i < cloud_.count; ++i) {
      const float* const xyz = cloud_.xyz(i);
      if (folds_[i] != fold && std::isfinite(values_[i]) && std::isfinite(xyz[0]) &&
          std::isfinite(xyz[1]) && std::isfinite(xyz[2]))
        rest.emplace_back(placeOf(i), values_[i]);
    }
    delaunay_.clear();
    delaunay_.insert(rest.begin(), rest.end());
    cell_ = Delaunay::Cell_handle();
  }

  pcl_uvol::CloudView cloud_;
  std::vector<double> values_;
  Eigen::Array3f scale_;
  const pcl_uvol::Folds& folds_;
  double isovalue_;
  std::size_t fold_ = ~std::size_t(0);
  Delaunay delaunay_;
  Delaunay::Cell_handle cell_;
};

/** A way to extract the surface. */
struct Method {
  const char* name;
  Interpolation interpolation;
  NormalMethod normals;
  bool fill_gaps = false;
};

const Method methods[] = {
    {"auto, filled", Interpolation::Auto, NormalMethod::Auto, true},
    {"auto", Interpolation::Auto, NormalMethod::Auto},
    {"fit", Interpolation::Fit, NormalMethod::Fit},
    {"linear, edge", Interpolation::Linear, NormalMethod::Edge},
    {"linear, pca", Interpolation::Linear, NormalMethod::Pca}};

void
printCase(const DataCase& data, std::size_t folds_at_most)
{
  const auto samples = uvol_benchmark::load(data);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(samples->cloud);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = data.field.empty() ? "intensity" : data.field;
  parameters.isosurface.isovalues = {data.isovalue};
  parameters.isosurface.scale = uvol_benchmark::findScale(data, cloud);
  parameters.validation.folds = folds_at_most;
  parameters.validation.by =
      data.by == "random" ? ValidateBy::Random : ValidateBy::Field;
  parameters.validation.field = data.by;
  const auto folds = pcl_uvol::makeFolds(cloud, parameters.validation, 0);
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  const auto extract = [&](const pcl_uvol::IsosurfacePipelineParameters& of_part,
                           const pcl::IndicesPtr& use,
                           const pcl_uvol::ProgressCallback&) {
    pipeline.setParameters(of_part);
    pipeline.setIndices(use);
    return pipeline.run();
  };
  DelaunayClass delaunay(*samples, parameters, folds);
  std::vector<bool> by_delaunay;
  const Eigen::Array3f& scale = parameters.isosurface.scale;
  std::printf("%s %s %g, by %s, scale %.3g,%.3g,%.3g\n",
              data.file.c_str(),
              data.field.c_str(),
              data.isovalue,
              data.by.c_str(),
              static_cast<double>(scale[0]),
              static_cast<double>(scale[1]),
              static_cast<double>(scale[2]));
  for (const Method& method : methods) {
    if (method.fill_gaps && data.field[0] == '|')
      continue; // gaps of vectors' lengths are not filled
    parameters.isosurface.interpolation = method.interpolation;
    parameters.normals = method.normals;
    parameters.fill_gaps = method.fill_gaps;
    pcl_uvol::Report report;
    const auto told =
        pcl_uvol::holdOut({samples, nullptr, parameters}, folds, extract, 0, report)
            .front();
    const auto score = pcl_uvol::scoreHeldOut(told);
    const bool is_first = by_delaunay.empty();
    if (is_first)
      for (const HeldOutSample& sample : told)
        by_delaunay.push_back(delaunay.isAbove(sample) == sample.is_above);
    double near = 0.0, everywhere = 0.0;
    for (std::size_t i = 0; i < told.size(); ++i) {
      near += told[i].is_covered && by_delaunay[i];
      everywhere += by_delaunay[i];
    }
    if (is_first)
      std::printf("  class          all %7zu          field %.3f nearest %.3f delaunay "
                  "%.3f base %.3f\n",
                  score.tested,
                  score.field.predicted,
                  score.field.nearest,
                  everywhere / static_cast<double>(told.size()),
                  score.field.base);
    std::printf(
        "  %-14s near %6zu side %.3f field %.3f nearest %.3f delaunay %.3f base "
        "%.3f everywhere %.3f beyond error %.3f of %zu\n",
        method.name,
        score.covered,
        score.side.predicted,
        score.side_of_field,
        score.side.nearest,
        near / static_cast<double>(score.covered),
        score.side.base,
        score.side_everywhere,
        score.side_beyond_error,
        score.beyond_error);
    std::fflush(stdout);
  }
}

} // namespace

/** holdout [FOLDS [PART OF A FILE'S NAME [found]]]; found: those cases only whose scale
 * is found from the field. */
int
main(int argc, char** argv)
{
  const std::size_t folds = argc > 1 ? std::stoul(argv[1]) : 10;
  const std::string part = argc > 2 ? argv[2] : "";
  const bool only_found = argc > 3 && std::string(argv[3]) == "found";
  for (const DataCase& data : uvol_benchmark::listCases())
    if (data.file.find(part) != std::string::npos &&
        (!only_found || (data.scale == 0.0f).all()))
      printCase(data, folds);
  return 0;
}
