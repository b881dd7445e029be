// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/records.h"
#include "mesh/inner_samples.h"
#include "mesh/measure_warnings.h"
#include "mesh/measured_mesh.h"
#include "mesh/measured_points.h"
#include "mesh/self_intersections.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>
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

/** Share of the area: less without an estimated error, or with one as large as edges,
 * changes figures by less than they say. */
constexpr double much_without_error = 0.05;

/** What the vertices' estimated distances to the surface make of area and volume. */
class VertexErrors {
public:
  explicit VertexErrors(const CloudView& vertices)
      : vertices_(vertices)
      , error_(findScalar(vertices, "error"))
      , curvature_(findScalar(vertices, "mean_curvature"))
      , support_(findScalar(vertices, "support"))
      , length_(findScalar(vertices, "edge_length"))
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
    if (!std::isfinite(error) || error < 0.0)
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

  /** Whether a vertex is between lines of samples or next to a gap. */
  bool
  isWeak(std::uint32_t vertex) const
  {
    const double kind = support_ ? support_->read(vertices_.point(vertex)) : 0.0;
    return kind == static_cast<double>(IsoSupport::Bridged) ||
           kind == static_cast<double>(IsoSupport::Rim);
  }

  /** False for a vertex that may be anywhere between its two samples. */
  bool
  isLocated(std::uint32_t vertex) const
  {
    if (!error_ || !length_)
      return true;
    const std::uint8_t* const point = vertices_.point(vertex);
    return error_->read(point) <= 0.5 * length_->read(point);
  }

private:
  const CloudView& vertices_;
  std::optional<ScalarField> error_, curvature_, support_, length_;
};

/** Centroid and axes from the integrals over the enclosed space, or the area. */
void
describeShape(const SurfaceIntegrals& integrals,
              const Eigen::Vector3d& center,
              PieceMeasures& piece)
{
  const bool is_solid = integrals.is_solid && std::isfinite(piece.volume.value) &&
                        integrals.volume != 0.0;
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
  piece.area = {integrals.area, integrals.area_error + integrals.undetermined_area};
  if (piece.rims == 0)
    piece.volume = {integrals.volume,
                    integrals.volume_error + integrals.undetermined_volume};
}

/** Measures one mesh. */
class Measurement {
public:
  Measurement(MeasuredSurface surface,
              const CloudView& vertices,
              const std::array<double, 3>& origin,
              bool drop_uncertain)
      : surface_(std::move(surface))
      , vertices_(vertices)
      , origin_(origin[0], origin[1], origin[2])
  {
    addErrors();
    for (std::size_t i = 0; i < surface_.integrals.size(); ++i)
      figures.pieces.push_back(describePiece(i));
    describeFields();
    const std::vector<std::size_t> rank = nameIsovalues();
    findUncertain(rank, drop_uncertain);
    sortPieces(rank);
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
    figures.vertex_areas.assign(vertices_.count, 0.0);
    for (std::size_t k = 0; k < surface_.shares.size(); ++k)
      if (figures.piece_of[k] >= 0)
        figures.vertex_areas[surface_.sources[k]] += surface_.shares[k];
    // Copies of a vertex are one again, whose piece is that of the first.
    figures.piece_of.resize(vertices_.count);
  }

  /** Make volumes that are negative by less than their error, as those of a mesh in one
   * plane are, what they can be at least: 0, without samples. */
  void
  clearNegative()
  {
    for (std::size_t i = 0; i < figures.pieces.size(); ++i) {
      PieceMeasures& piece = figures.pieces[i];
      SurfaceIntegrals& all = surface_.integrals[i];
      const bool is_flat = detail::isFlat(all, piece);
      if (piece.rims > 0 || (!is_flat && std::abs(all.volume) > all.volume_error))
        continue;
      if (all.volume < 0.0 || is_flat)
        all.volume = piece.volume.value = 0.0;
      if (piece.samples < 0 || is_flat) {
        piece.samples = 0;
        for (InnerFieldMeasures& field : piece.inside)
          field.sum = 0.0;
      }
      if (all.volume == 0.0)
        for (InnerFieldMeasures& field : piece.inside) {
          field.integral = {};
          field.mean = std::numeric_limits<double>::quiet_NaN();
        }
    }
  }

  /** Find the samples within the pieces.
   * \param origin of theirs
   * \param box in the coordinates of the vertices */
  void
  lookInside(const CloudView& samples,
             const std::array<double, 3>& origin,
             const PeriodicBox& box,
             unsigned threads,
             Report& report)
  {
    const Eigen::Vector3d offset =
        origin_ - Eigen::Vector3d(origin[0], origin[1], origin[2]);
    detail::ClosedMesh closed{{}, surface_.triangles, figures.piece_of, nullptr, box};
    for (const detail::SurfaceCorner& corner : surface_.corners)
      closed.places.push_back(corner.place + offset);
    for (std::size_t axis = 0; axis < 3; ++axis)
      closed.box.low[axis] += offset[static_cast<int>(axis)];
    if (surface_.closure) {
      surface_.closure->prepare(closed.places);
      closed.closure = &*surface_.closure;
    }
    whole_box_ =
        detail::measureInside(closed, samples, threads, figures.pieces, report);
  }

  void
  warn(Report& report) const
  {
    const double part = area_ > 0.0 ? without_error_ / area_ : 0.0;
    if (part > much_without_error)
      report.warn("area_without_error", {{"percent", std::lround(100.0 * part)}});
    detail::warnOfWeak(weak_, report);
    detail::warnOfMeasures(figures, report);
    detail::warnOfUncertain(uncertain_, report);
  }

  SurfaceFigures figures;

private:
  /** Add what the errors of vertices make of area and volume. The whole piece counts as
   * its error if most vertices are weak and samples do not locate all of them: a mesh
   * of a shell that is two samples thick closes the hollow, too. */
  void
  addErrors()
  {
    const VertexErrors errors(vertices_);
    const std::size_t pieces = surface_.integrals.size();
    std::vector<detail::WeakVertices> weak(pieces);
    std::vector<double> areas(pieces), unlocated(pieces); // beside caps
    forVertices([&](std::size_t piece, std::size_t vertex) {
      const std::uint32_t source = surface_.sources[vertex];
      const double share = surface_.shares[vertex];
      area_ += share;
      const double rim =
          surface_.rim_lengths.empty() ? 0.0 : surface_.rim_lengths[vertex];
      const bool has_error = errors.add(source, share, rim, surface_.integrals[piece]);
      if (surface_.corners[vertex].is_on_cap)
        return;
      without_error_ += has_error ? 0.0 : share;
      areas[piece] += share;
      unlocated[piece] += errors.isLocated(source) ? 0.0 : share;
      weak[piece].add(errors.isWeak(source));
      weak_.add(errors.isWeak(source));
    });
    for (std::size_t i = 0; i < pieces; ++i) {
      if (!weak[i].areMost() || unlocated[i] <= much_without_error * areas[i])
        continue;
      SurfaceIntegrals& all = surface_.integrals[i];
      all.undetermined_area = all.area;
      all.undetermined_volume = std::abs(all.volume);
    }
  }

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

  /** Find the pieces that are known no better than to their own size, and leave them
   * out if that is asked for, unless nothing would be left of an isovalue. */
  void
  findUncertain(const std::vector<std::size_t>& rank, bool drop)
  {
    uncertain_.pieces = figures.pieces.size();
    uncertain_.are_left_out = drop;
    is_left_out_.assign(figures.pieces.size(), false);
    std::vector<bool> is_any_certain(figures.pieces.size() + 1); // by isovalue
    for (std::size_t i = 0; i < figures.pieces.size(); ++i)
      if (!detail::isUncertain(figures.pieces[i]))
        is_any_certain[rank[i]] = true;
    for (std::size_t i = 0; i < figures.pieces.size(); ++i) {
      const PieceMeasures& piece = figures.pieces[i];
      if (!detail::isUncertain(piece))
        continue;
      if (!is_any_certain[rank[i]]) {
        ++uncertain_.kept;
        continue;
      }
      is_left_out_[i] = drop;
      ++uncertain_.uncertain;
      uncertain_.area.value += piece.area.value;
      uncertain_.area.error += piece.area.error;
    }
  }

  /** \return the order of the pieces' isovalues, by their first vertices */
  std::vector<std::size_t>
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
    return rank;
  }

  /** Put the pieces that are not left out in order. */
  void
  sortPieces(const std::vector<std::size_t>& rank)
  {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < figures.pieces.size(); ++i)
      if (!is_left_out_[i])
        places.push_back(i);
    std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
      return rank[a] < rank[b];
    });
    std::vector<PieceMeasures> sorted;
    std::vector<SurfaceIntegrals> integrals;
    std::vector<std::int32_t> number(figures.pieces.size(), -1);
    for (std::size_t i = 0; i < places.size(); ++i) {
      sorted.push_back(figures.pieces[places[i]]);
      integrals.push_back(surface_.integrals[places[i]]);
      centers_.push_back(surface_.bounds[places[i]].center());
      number[places[i]] = static_cast<std::int32_t>(i);
    }
    figures.pieces = std::move(sorted);
    surface_.integrals = std::move(integrals);
    if (surface_.closure)
      surface_.closure->renumber(number);
    for (const std::int32_t piece : surface_.list.of_vertex)
      figures.piece_of.push_back(piece < 0 ? -1
                                           : number[static_cast<std::size_t>(piece)]);
    surface_.triangles.erase(std::remove_if(surface_.triangles.begin(),
                                            surface_.triangles.end(),
                                            [&](const Triangle& triangle) {
                                              return figures.piece_of[triangle[0]] < 0;
                                            }),
                             surface_.triangles.end());
  }

  void
  join(std::size_t begin, std::size_t end, PieceMeasures& all) const
  {
    SurfaceIntegrals integrals;
    std::vector<double> volumes; // that fields are integrated over
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
      if (piece.rims > 0)
        continue;
      detail::addInside(piece, all);
      volumes.resize(all.inside.size());
      for (std::size_t k = 0; k < piece.inside.size(); ++k)
        if (std::isfinite(piece.inside[k].integral.value))
          volumes[k] += piece.volume.value;
    }
    std::copy_n(bounds.min().data(), 3, all.low.begin());
    std::copy_n(bounds.max().data(), 3, all.high.begin());
    if (surface_.closure && all.rims == 0)
      fitIntoBox(integrals, all, volumes);
    describeSize(integrals, all);
    describeShape(integrals, center, all);
    joinFields(begin, end, all);
    for (std::size_t k = 0; k < all.inside.size(); ++k)
      all.inside[k].mean = volumes[k] != 0.0 ? all.inside[k].integral.value / volumes[k]
                                             : std::numeric_limits<double>::quiet_NaN();
  }

  /** Where pieces count what is outside of them, the box is added to what they enclose
   * together. */
  void
  fitIntoBox(SurfaceIntegrals& integrals,
             PieceMeasures& all,
             std::vector<double>& volumes) const
  {
    const double box = surface_.closure->getBoxVolume();
    if (!(box > 0.0) || (integrals.volume >= -integrals.volume_error &&
                         integrals.volume <= box + integrals.volume_error))
      return;
    const int times = -static_cast<int>(std::floor(integrals.volume / box));
    integrals.volume += times * box;
    integrals.is_solid = false;
    detail::addInside(whole_box_, all, times);
    for (double& volume : volumes)
      volume += times * box;
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
  PieceMeasures whole_box_; // what its samples are
  detail::UncertainPieces uncertain_;
  detail::WeakVertices weak_;
  std::vector<bool> is_left_out_;           // by piece, before they have an order
  double area_ = 0.0, without_error_ = 0.0; // of it, where no vertex tells its error
  std::vector<Eigen::Vector3d> centers_;    // by piece, that integrals are relative to
};

/** The periodic box that a mesh was cut at, in the coordinates of its vertices. */
PeriodicBox
findBox(const Dataset& vertices,
        const std::shared_ptr<const Dataset>& samples,
        const Eigen::Array3d& periodic)
{
  const std::array<double, 3> sides{{periodic[0], periodic[1], periodic[2]}};
  checkPeriodic(sides);
  if (!isPeriodic(sides))
    return {};
  const Dataset& extent = samples ? *samples : vertices;
  Report unused; // whoever extracted the surface has reported on the box
  PeriodicBox box = findPeriodicBox(extent, sides, unused);
  for (std::size_t axis = 0; axis < 3; ++axis)
    box.low[axis] += extent.origin[axis] - vertices.origin[axis];
  return box;
}

} // namespace

SurfaceFigures
SurfaceMeasures::compute()
{
  if (!vertices_)
    throw InvalidArgument("measures_without_surface", {});
  startReport();
  const StepTimer timer(report_, "measures");
  if (triangles_.empty() && samples_ && parameters_.field.empty())
    throw InvalidArgument("inside_without_triangles", {});
  CloudView vertices = viewOf(vertices_->cloud);
  vertices.fields = listNumberFields(*vertices_); // names have no mean
  const PeriodicBox box = findBox(*vertices_, samples_, parameters_.periodic);
  Measurement measurement(
      triangles_.empty()
          ? detail::measurePoints(vertices, threads_, report_)
          : detail::measureMesh(vertices, triangles_, box, parameters_.curved),
      vertices,
      vertices_->origin,
      parameters_.drop_uncertain);
  CloudView samples;
  if (samples_) {
    samples = viewOf(samples_->cloud);
    samples.fields = listNumberFields(*samples_);
    if (!triangles_.empty())
      measurement.lookInside(samples, samples_->origin, box, threads_, report_);
  }
  measurement.clearNegative();
  measurement.joinPieces();
  if (const auto field = findScalar(samples, parameters_.field.c_str()))
    detail::sumBeyond(
        samples, *field, parameters_.outside, measurement.figures.isovalues);
  measurement.warn(report_);
  if (parameters_.find_intersections)
    measurement.figures.intersections = detail::describeIntersections(
        vertices, triangles_, vertices_->origin, threads_, report_);
  return std::move(measurement.figures);
}

} // namespace pcl_uvol
