// SPDX-License-Identifier: BSD-3-Clause
// What the viewer shows: points of a surface, or an isosurface of samples.
#pragma once

#include "viewer/surface_worker.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Geometry>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A cloud whose isovalue, if it has one, can be changed: tree and values are
 * kept. Isosurfaces are extracted in another thread; what was shown is shown until
 * update() or finish(). */
class ShownSurface {
public:
  using Cloud = pcl::PCLPointCloud2;

  /** \brief Adds to each isosurface what it is coloured by; called in another thread.
   */
  using AddColor = std::function<void(pcl_uvol::Dataset&, pcl_uvol::Report&)>;

  /** \param field "": the points are the surface; else isosurfaces of that field
   * \param factors along the axes by which the surface is stretched
   * \param add_color empty: isosurfaces have the fields of the samples only
   * \throws InvalidArgument for a cloud without points, an unknown field or one without
   * two finite values, and for splats that are to be stretched */
  ShownSurface(pcl_uvol::Dataset dataset,
               const std::string& field,
               unsigned threads,
               const Eigen::Vector3d& factors = Eigen::Vector3d::Ones(),
               const AddColor& add_color = nullptr);

  /** \brief "" for a surface given as points. */
  const std::string&
  getField() const
  {
    return field_;
  }

  /** \brief Least and largest value of the field. */
  const std::array<double, 2>&
  getRange() const
  {
    return range_;
  }

  /** \brief Values of the samples' field. */
  std::vector<double>
  readValues() const;

  /** \brief A value with samples on both sides: the first that uvol_info proposes, else
   * the middle of the range. */
  double
  proposeIsoValue() const;

  /** \brief The one that moves, as it was asked for last. */
  double
  getIsoValue() const
  {
    return asked_.isovalues.back();
  }

  /** \brief All that were asked for: those that are kept in the order in which they
   * came, then the one that moves. */
  const std::vector<double>&
  getIsoValues() const
  {
    return asked_.isovalues;
  }

  /** \brief Ask for another isovalue in the place of the one that moves; surfaces have
   * all fields of the samples.
   * \throws InvalidArgument if it lies outside of the range */
  void
  setIsoValue(double isovalue);

  /** \brief Ask for several isovalues, of which the last one moves.
   * \throws InvalidArgument as setIsoValue() */
  void
  setIsoValues(const std::vector<double>& isovalues);

  /** \brief Keep the isovalue that moves: another one moves from there. */
  void
  keepIsoValue();

  /** \brief Ask for meshes of isosurfaces from now on, or points again.
   * \throws InvalidArgument for a surface given as points */
  void
  setMeshed(bool is_meshed);

  bool
  isMeshed() const
  {
    return asked_.is_meshed;
  }

  /** \brief Whether something that was asked for is not shown yet, or only a draft of
   * it. */
  bool
  isBusy() const
  {
    return worker_ && worker_->isBusy();
  }

  /** \brief Show what was extracted since the last call: drafts of large surfaces come
   * before these.
   * \return false if that is nothing
   * \throws what the extraction has thrown; what was shown is then what is asked for */
  bool
  update();

  /** \brief The same once all that was asked for is extracted. */
  bool
  finish();

  /** \brief What is drawn of getCloud(), ready for the first frame; null for a mesh. */
  const std::shared_ptr<pcl_uvol::PreparedSurface>&
  getPrepared() const
  {
    return prepared_;
  }

  /** \brief The triangles of a mesh, whose vertices are the points of the cloud. */
  const std::vector<pcl_uvol::Triangle>&
  getTriangles() const
  {
    return triangles_;
  }

  /** \brief Leave out the points in front of a plane from now on; none: show all again.
   * A mesh stays whole. */
  void
  setCut(const std::optional<Eigen::Hyperplane<double, 3>>& plane);

  bool
  isCut() const
  {
    return asked_.cut.has_value();
  }

  /** \brief What is drawn; null where an isosurface has no points. */
  const Cloud::ConstPtr&
  getCloud() const
  {
    return cloud_;
  }

  /** \brief The same points before they are stretched. */
  const Cloud::ConstPtr&
  getData() const
  {
    return data_;
  }

  /** \brief A ball around the surface; around the samples where it has no points. */
  pcl_uvol::BoundingSphere
  getBounds() const;

  /** \brief What was subtracted from the coordinates: from those of getData(), and of
   * getCloud(). @{ */
  const std::array<double, 3>&
  getOrigin() const
  {
    return origin_;
  }

  std::array<double, 3>
  getDrawnOrigin() const;
  /** @} */

  /** \brief Along the axes, by which the surface is stretched. */
  const Eigen::Vector3d&
  getFactors() const
  {
    return factors_;
  }

  /** \brief The report of the last extraction; empty for a surface given as points. */
  const pcl_uvol::Report&
  getReport() const
  {
    return report_;
  }

private:
  void
  ask(const SurfaceRequest& request);

  /** Stretch what is shown of the data, and prepare it unless it is a mesh. */
  void
  prepare();

  /** Show what the worker gives, if it gives something. */
  bool takeFrom(std::optional<SurfaceWorker::Result> (SurfaceWorker::*give)());

  Cloud::ConstPtr samples_;
  Cloud::ConstPtr whole_, data_; // the surface, and what is shown of it
  Cloud::ConstPtr cloud_;        // the same, stretched
  std::shared_ptr<pcl_uvol::PreparedSurface> prepared_;
  std::array<double, 3> origin_;
  Eigen::Vector3d factors_;
  std::string field_;
  unsigned threads_;
  std::array<double, 2> range_{{0.0, 0.0}};
  SurfaceRequest asked_, shown_;
  std::vector<pcl_uvol::Triangle> triangles_;
  pcl_uvol::Report report_;
  std::unique_ptr<SurfaceWorker> worker_; // null for a surface given as points
};

/** \brief Least and largest finite value of a field.
 * \throws InvalidArgument for an unknown field or one without a finite value */
std::array<double, 2>
findRange(const pcl::PCLPointCloud2& cloud, const std::string& field);

} // namespace uvol_tools
