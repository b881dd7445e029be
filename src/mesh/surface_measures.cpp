// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/records.h"
#include "mesh/inner_samples.h"
#include "mesh/measured_mesh.h"
#include "mesh/measured_points.h"
#include "mesh/self_intersections.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace pcl_uvol {

std::string
SurfaceMeasuresParameters::toJson() const
{
  return writeJson(*this);
}

SurfaceMeasuresParameters
SurfaceMeasuresParameters::fromJson(const std::string& text)
{
  return readJson<SurfaceMeasuresParameters>(text);
}

namespace {

using detail::findScalar;
using detail::MeasuredSurface;
using detail::SurfaceIntegrals;

/** Share of a figure: one that is known no better is hardly one. */
constexpr double large_error = 1.0 / 3.0;

/** Share of the area: less without an estimated error changes figures by less than they
 * say.
 */
constexpr double much_without_error = 0.05;

/** What the vertices' estimated distances to the surface make of area and volume. */
class VertexErrors {
public:
  explicit VertexErrors(const CloudView& vertices)
      : vertices_(vertices)
      , error_(findScalar(vertices, "error"))
      , curvature_(findScalar(vertices, "mean_curvature"))
  {
  }

  /** False without an estimate, where the vertices have a field of them. */
  bool
  add(std::uint32_t vertex,
      double share,
      double rim_length,
      SurfaceIntegrals& integrals) const
  {
    const double error = error_ ? error_->read(vertices_.point(vertex)) : 0.0;
    if (!std::isfinite(error))
      return false;
    integrals.volume_error += share * error;
    integrals.area_error += rim_length * error;
    const double curvature =
        curvature_ ? std::abs(curvature_->read(vertices_.point(vertex))) : 0.0;
    if (!std::isfinite(curvature))
      return true;
    // First variation of the area, and the area of ripples as long as the edges.
    integrals.area_error += share * 2.0 * curvature * error + error * error;
    return true;
  }

private:
  const CloudView& vertices_;
  std::optional<ScalarField> error_, curvature_;
};

/** Centroid and axes from the integrals over the enclosed space, or the area. */
void
describeShape(const SurfaceIntegrals& integrals,
              const Eigen::Vector3d& center,
              PieceMeasures& piece)
{
  const bool is_solid = std::isfinite(piece.volume.value) && integrals.volume != 0.0;
  const double whole = is_solid ? integrals.volume : integrals.area;
  // Second moments of a ball are a fifth of its squared radius, of a shell a third.
  const double per_moment = is_solid ? 5.0 : 3.0;
  const Eigen::Vector3d mean =
      (is_solid ? integrals.moment : integrals.area_moment) / whole;
  const Eigen::Matrix3d products =
      (is_solid ? integrals.products : integrals.area_products) / whole;
  piece.centroid = center + mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      Eigen::Matrix3d(products - mean * mean.transpose()));
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d axis = solver.eigenvectors().col(2 - i);
    int largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    piece.axes.col(i) = axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
    piece.half_axes[i] =
        std::sqrt(std::max(0.0, per_moment * solver.eigenvalues()[2 - i]));
  }
  piece.axes.col(2) = piece.axes.col(0).cross(piece.axes.col(1));
}

/** The figures of area and volume. */
void
describeSize(const SurfaceIntegrals& integrals, PieceMeasures& piece)
{
  piece.area = {integrals.area, integrals.area_error};
  if (piece.rims == 0)
    piece.volume = {integrals.volume, integrals.volume_error};
}

/** Measures one mesh. */
class Measurement {
public:
  Measurement(MeasuredSurface surface,
              const CloudView& vertices,
              const std::array<double, 3>& origin)
      : surface_(std::move(surface))
      , vertices_(vertices)
      , origin_(origin[0], origin[1], origin[2])
  {
    const VertexErrors errors(vertices);
    forVertices([&](std::size_t piece, std::size_t vertex) {
      const double share = surface_.shares[vertex];
      area_ += share;
      const double rim =
          surface_.rim_lengths.empty() ? 0.0 : surface_.rim_lengths[vertex];
      if (!errors.add(
              surface_.sources[vertex], share, rim, surface_.integrals[piece]) &&
          !surface_.corners[vertex].is_on_cap)
        without_error_ += share;
    });
    for (std::size_t i = 0; i < surface_.integrals.size(); ++i)
      figures.pieces.push_back(describePiece(i));
    describeFields();
    nameIsovalues();
  }

  /** The pieces of an isovalue together, once they are all measured. */
  void
  joinPieces()
  {
    for (const PieceMeasures& piece : figures.pieces)
      if (figures.isovalues.empty() || !isOf(figures.isovalues.back(), piece)) {
        figures.isovalues.emplace_back();
        figures.isovalues.back().isovalue = piece.isovalue;
      }
    std::size_t i = 0;
    for (PieceMeasures& all : figures.isovalues) {
      const std::size_t begin = i;
      while (i < figures.pieces.size() && isOf(all, figures.pieces[i]))
        ++i;
      join(begin, i, all);
    }
    // Copies of a vertex are one again, whose piece is that of the first.
    figures.piece_of.resize(vertices_.count);
    figures.vertex_areas.assign(vertices_.count, 0.0);
    for (std::size_t k = 0; k < surface_.shares.size(); ++k)
      figures.vertex_areas[surface_.sources[k]] += surface_.shares[k];
  }

  /** Find the samples within the pieces.
   * \param origin of theirs */
  void
  lookInside(const CloudView& samples,
             const std::array<double, 3>& origin,
             unsigned threads,
             Report& report)
  {
    const Eigen::Vector3d offset =
        origin_ - Eigen::Vector3d(origin[0], origin[1], origin[2]);
    detail::ClosedMesh closed{{}, surface_.triangles, figures.piece_of};
    for (const detail::SurfaceCorner& corner : surface_.corners)
      closed.places.push_back(corner.place + offset);
    detail::measureInside(closed, samples, threads, figures.pieces, report);
  }

  void
  warn(Report& report) const
  {
    const auto open = static_cast<std::size_t>(std::count_if(
        figures.pieces.begin(), figures.pieces.end(), [](const PieceMeasures& piece) {
          return piece.rims > 0;
        }));
    if (open > 0)
      report.warnings.push_back(
          "Of " + std::to_string(figures.pieces.size()) + " pieces " +
          std::to_string(open) +
          " are open, or disagree with others about the outside: they enclose no "
          "volume, and only their area is measured.");
    if (without_error_ > much_without_error * area_)
      report.warnings.push_back(
          std::to_string(std::lround(100.0 * without_error_ / area_)) +
          " % of the area has vertices without an estimated error: the errors of the "
          "figures are those of the rest.");
    const auto vague = std::count_if(
        figures.isovalues.begin(),
        figures.isovalues.end(),
        [](const PieceMeasures& all) {
          return all.volume.error > large_error * std::abs(all.volume.value) ||
                 all.area.error > large_error * all.area.value;
        });
    if (vague > 0)
      report.warnings.push_back(
          "Area or volume of " + std::to_string(vague) + " of " +
          std::to_string(figures.isovalues.size()) +
          " surfaces are not known to better than a third: vertices lie that far from "
          "where the surface may be.");
    for (const PieceMeasures& all : figures.isovalues)
      if (all.volume.value < -all.volume.error) {
        report.warnings.push_back(
            "The surface looks to the side that it encloses: volumes are "
            "negative.");
        break;
      }
  }

  SurfaceFigures figures;

private:
  static bool
  isOf(const PieceMeasures& all, const PieceMeasures& piece)
  {
    return detail::areEqual(all.isovalue, piece.isovalue);
  }

  PieceMeasures
  describePiece(std::size_t i) const
  {
    PieceMeasures piece;
    const SurfacePiece& counted = surface_.list.pieces[i];
    piece.isovalue = std::numeric_limits<double>::quiet_NaN();
    piece.vertices = counted.vertices;
    piece.triangles = counted.triangles;
    piece.rims = counted.rims;
    if (counted.triangles > 0)
      piece.genus = counted.genus;
    const Eigen::AlignedBox3d& bounds = surface_.bounds[i];
    for (int axis = 0; axis < 3; ++axis) {
      piece.low[static_cast<std::size_t>(axis)] = bounds.min()[axis] + origin_[axis];
      piece.high[static_cast<std::size_t>(axis)] = bounds.max()[axis] + origin_[axis];
    }
    describeSize(surface_.integrals[i], piece);
    if (!surface_.cap_areas.empty() && surface_.cap_areas[i] > 0.0) {
      piece.cap_area = surface_.cap_areas[i];
      piece.capped_volume = piece.rims == 0 ? piece.volume.value : 0.0;
    }
    describeShape(surface_.integrals[i], bounds.center() + origin_, piece);
    return piece;
  }

  /** Means and integrals of the fields of the vertices. */
  void
  describeFields()
  {
    for (const NamedScalar& scalar : detail::listMeasuredFields(vertices_.fields)) {
      std::vector<double> areas(figures.pieces.size()), sums(figures.pieces.size());
      forVertices([&](std::size_t piece, std::size_t vertex) {
        const double value =
            scalar.number.read(vertices_.point(surface_.sources[vertex]));
        if (!std::isfinite(value))
          return;
        areas[piece] += surface_.shares[vertex];
        sums[piece] += surface_.shares[vertex] * value;
      });
      for (std::size_t i = 0; i < figures.pieces.size(); ++i) {
        PieceMeasures& piece = figures.pieces[i];
        const double mean = sums[i] / areas[i]; // not a number without any
        piece.on_surface.push_back(
            {scalar.name, mean, {mean * areas[i], std::abs(mean) * piece.area.error}});
      }
    }
  }

  /** Put the pieces in the order of their isovalues' first vertices. */
  void
  nameIsovalues()
  {
    const std::optional<ScalarField> field = findScalar(vertices_, "isovalue");
    std::vector<std::size_t> rank(figures.pieces.size());
    if (field) {
      std::map<double, std::size_t> order;
      forVertices([&](std::size_t piece, std::size_t vertex) {
        const double isovalue = field->read(vertices_.point(surface_.sources[vertex]));
        if (!std::isfinite(isovalue))
          return;
        rank[piece] = order.emplace(isovalue, order.size()).first->second;
        figures.pieces[piece].isovalue = isovalue;
      });
    }
    std::vector<std::size_t> places(figures.pieces.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] = i;
    std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
      return rank[a] < rank[b];
    });
    std::vector<PieceMeasures> sorted;
    std::vector<SurfaceIntegrals> integrals;
    std::vector<std::int32_t> number(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      sorted.push_back(figures.pieces[places[i]]);
      integrals.push_back(surface_.integrals[places[i]]);
      centers_.push_back(surface_.bounds[places[i]].center());
      number[places[i]] = static_cast<std::int32_t>(i);
    }
    figures.pieces = std::move(sorted);
    surface_.integrals = std::move(integrals);
    for (const std::int32_t piece : surface_.list.of_vertex)
      figures.piece_of.push_back(piece < 0 ? -1
                                           : number[static_cast<std::size_t>(piece)]);
  }

  void
  join(std::size_t begin, std::size_t end, PieceMeasures& all) const
  {
    SurfaceIntegrals integrals;
    Eigen::AlignedBox3d bounds;
    for (std::size_t i = begin; i < end; ++i)
      for (const auto& corner : {figures.pieces[i].low, figures.pieces[i].high})
        bounds.extend(Eigen::Vector3d(corner[0], corner[1], corner[2]));
    const Eigen::Vector3d center = bounds.center();
    for (std::size_t i = begin; i < end; ++i) {
      const PieceMeasures& piece = figures.pieces[i];
      all.vertices += piece.vertices;
      all.triangles += piece.triangles;
      all.rims += piece.rims;
      all.cap_area += piece.cap_area;
      all.capped_volume += piece.capped_volume;
      if (piece.genus)
        all.genus = all.genus.value_or(0) + *piece.genus;
      integrals.add(surface_.integrals[i].shifted(centers_[i] + origin_ - center));
      if (piece.rims == 0)
        detail::addInside(piece, all);
    }
    std::copy_n(bounds.min().data(), 3, all.low.begin());
    std::copy_n(bounds.max().data(), 3, all.high.begin());
    describeSize(integrals, all);
    describeShape(integrals, center, all);
    joinFields(begin, end, all);
    for (InnerFieldMeasures& field : all.inside)
      field.mean = field.integral.value / all.volume.value;
  }

  /** Field by field the sums over some pieces, of those that have a value. */
  void
  joinFields(std::size_t begin, std::size_t end, PieceMeasures& all) const
  {
    all.on_surface = figures.pieces[begin].on_surface;
    for (std::size_t k = 0; k < all.on_surface.size(); ++k) {
      SurfaceFieldMeasures& field = all.on_surface[k];
      double area = 0.0;
      Measure sum{0.0, 0.0};
      for (std::size_t i = begin; i < end; ++i) {
        const SurfaceFieldMeasures& own = figures.pieces[i].on_surface[k];
        if (!std::isfinite(own.mean))
          continue;
        area += own.mean != 0.0 ? own.integral.value / own.mean
                                : figures.pieces[i].area.value;
        sum.value += own.integral.value;
        sum.error += own.integral.error;
      }
      field.mean = sum.value / area;
      field.integral = area > 0.0 ? sum : Measure();
    }
  }

  /** Call visit(piece, vertex) for all vertices of triangles. */
  template <typename Visit>
  void
  forVertices(const Visit& visit) const
  {
    for (std::size_t i = 0; i < surface_.shares.size(); ++i)
      if (surface_.list.of_vertex[i] >= 0)
        visit(static_cast<std::size_t>(surface_.list.of_vertex[i]), i);
  }

  MeasuredSurface surface_;
  const CloudView& vertices_;
  Eigen::Vector3d origin_;
  double area_ = 0.0, without_error_ = 0.0; // of it, where no vertex tells its error
  std::vector<Eigen::Vector3d> centers_;    // by piece, that integrals are relative to
};

} // namespace

SurfaceFigures
SurfaceMeasures::compute()
{
  if (!vertices_)
    throw InvalidArgument("SurfaceMeasures has no surface: call setInputSurface.");
  startReport();
  const StepTimer timer(report_, "measures");
  if (triangles_.empty() && samples_)
    throw InvalidArgument(
        "Samples inside are found by triangles, and the surface has none.");
  CloudView vertices = viewOf(vertices_->cloud);
  vertices.fields = listNumberFields(*vertices_); // names have no mean
  Measurement measurement(
      triangles_.empty()
          ? detail::measurePoints(vertices, threads_, report_)
          : detail::measureMesh(vertices, triangles_, parameters_.curved),
      vertices,
      vertices_->origin);
  if (samples_) {
    CloudView samples = viewOf(samples_->cloud);
    samples.fields = listNumberFields(*samples_);
    measurement.lookInside(samples, samples_->origin, threads_, report_);
  }
  measurement.joinPieces();
  measurement.warn(report_);
  if (parameters_.find_intersections)
    measurement.figures.intersections = detail::describeIntersections(
        vertices, triangles_, vertices_->origin, threads_, report_);
  return std::move(measurement.figures);
}

} // namespace pcl_uvol
