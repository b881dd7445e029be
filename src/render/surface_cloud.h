// SPDX-License-Identifier: BSD-3-Clause
// A surface given as points, prepared for drawing: packed, in spatial order, with the
// footprints of the points where they are asked for.
#pragma once

#include "surface/footprints.h"
#include "surface/oriented_points.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Consecutive points: a subtree of the kd-tree over them. */
struct SurfaceBlock {
  std::uint32_t begin, end;
  Position center;
  float radius;       ///< of a ball around the points
  Position axis;      ///< mean normal
  float spread;       ///< sine of the largest angle to it; 1 for more than a half-space
  float mean_spacing; ///< estimated from the extent of the block
  /** Footprints of its points; 0 before computeFootprints(). @{ */
  float largest_footprint, mean_footprint;
  /** @} */
};

/** \brief Points with normals and colours, in the leaf order of a kd-tree.
 *
 * Coordinates and footprints are relative to the centre of getBounds() and in a unit
 * that chooseLengthUnit() gives for them, as those of a View are. Memory: 44 bytes per
 * point. */
class PCL_UVOL_EXPORTS SurfaceCloud {
public:
  /** \brief What is drawn for a pixel, fetched at once. The colour has the number of
   * the point's isovalue in the place of its opacity. */
  struct Look {
    PackedNormal normal;
    Rgba color;
  };

  /** \brief Prepare a cloud. Points with a non-finite coordinate or without a usable
   * normal are left out and counted as "non_finite" and "without_normal", exact
   * duplicates merged. A cloud that has no normals at all gets estimated ones and is
   * drawn from both sides, with a warning.
   * \param use indices of the points to draw
   * \throws InvalidArgument if no point is left */
  SurfaceCloud(const CloudView& cloud,
               const std::vector<std::uint32_t>& use,
               unsigned threads,
               Report& report);

  std::size_t
  size() const
  {
    return points_.normals.size();
  }

  /** \brief One coordinate of every point, relative to the centre. */
  const std::vector<float>&
  getCoordinates(int axis) const
  {
    return coordinates_[axis];
  }

  const std::vector<PackedNormal>&
  getNormals() const
  {
    return points_.normals;
  }

  const std::vector<Look>&
  getLooks() const
  {
    return looks_;
  }

  /** \brief Index in the input cloud of every point. */
  const std::vector<std::uint32_t>&
  getInputIndices() const
  {
    return input_indices_;
  }

  const std::vector<SurfaceBlock>&
  getBlocks() const
  {
    return blocks_;
  }

  /** \brief A ball around all points, in the coordinates of the input. */
  const BoundingSphere&
  getBounds() const
  {
    return bounds_;
  }

  /** \brief Normals have no meaningful sign: back faces are as good as front faces. */
  bool
  isTwoSided() const
  {
    return points_.two_sided;
  }

  /** \brief Normals look to the middle of the cloud, as those of a ball do whose field
   * grows outwards: what is seen of it from outside are backs. */
  bool
  isInsideOut() const
  {
    return is_inside_out_;
  }

  /** \brief There are points of several isovalues. */
  bool
  hasSurfaces() const
  {
    return !points_.surfaces.empty();
  }

  /** \brief Give every point a colour.
   * \param colors by input index */
  void
  setColors(const std::vector<Rgba>& colors);

  /** \brief Give all points one colour. */
  void
  setColor(Rgba color);

  /** \brief Make the colours of isopoints in gaps of the sampling paler, once after
   * each change of the colours.
   * \param background what they are mixed with */
  void
  fadeBridged(const Color& background);

  /** \brief Find how large the discs of the points must be to leave no hole between
   * them. The radius of a point's disc is the distance to the farthest corner of its
   * Voronoi cell in its tangent plane. Colours may change meanwhile. */
  Footprints
  findFootprints(unsigned threads, Report& report) const;

  /** \brief What cameras are fitted to: discs by input index, in the unit of the input;
   * of radius NaN for what is not drawn, and for what is a dot because it is isolated
   * or lies in a gap of the sampling. Where most points are dots these are the picture,
   * and count, with radius 0. */
  std::vector<FittedDisc>
  listFittedDiscs(const Footprints& footprints, std::size_t input_count) const;

  /** \brief Take what findFootprints() has found. */
  void
  setFootprints(Footprints footprints);

  /** \brief Both, once; further calls return at once. */
  void
  computeFootprints(unsigned threads, Report& report);

  /** \brief Radius of the disc of every point; empty before computeFootprints(). */
  const std::vector<float>&
  getFootprints() const
  {
    return footprints_;
  }

  /** \brief Radius of the disc by which every point fills a small hole among dense
   * points: each hole has one such disc, which leaves less of it than the masks close.
   * Empty before computeFootprints(). */
  const std::vector<float>&
  getFillers() const
  {
    return fillers_;
  }

  /** \brief How the surface bends over the footprint of every point; empty before
   * computeFootprints(). */
  const std::vector<PackedBend>&
  getBends() const
  {
    return bends_;
  }

  /** \brief The lines at which the disc of every point ends at the rim of the surface;
   * empty before computeFootprints(). */
  const std::vector<PackedRim>&
  getRims() const
  {
    return rims_;
  }

  /** \brief Median of the radii, 0 before computeFootprints(). */
  float
  getTypicalFootprint() const
  {
    return typical_footprint_;
  }

  /** \brief Another number for every cloud and after every change: what a cache of it
   * is checked against. */
  std::uint64_t
  getRevision() const
  {
    return revision_;
  }

private:
  /** Its colour, and the number of its surface. */
  void
  setColorOf(std::size_t point, Rgba color);

  /** Coordinates and what else is as long. */
  void
  place(unsigned threads);

  void
  addBlocks(const KdNode& node);

  SurfaceBlock
  makeBlock(std::uint32_t begin, std::uint32_t end) const;

  bool
  looksInwards() const;

  OrientedPoints points_;
  bool is_inside_out_ = false;
  std::vector<float> coordinates_[3];
  std::vector<Look> looks_;
  std::vector<std::uint32_t> input_indices_;
  std::vector<SurfaceBlock> blocks_;
  std::vector<float> footprints_, fillers_;
  std::vector<PackedBend> bends_;
  std::vector<PackedRim> rims_;
  float typical_footprint_ = 0.0f;
  BoundingSphere bounds_;
  float length_factor_ = 1.0f; ///< from the samples' unit to that of drawing
  std::uint64_t revision_ = 0;
};

} // namespace pcl_uvol
