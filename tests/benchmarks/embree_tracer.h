// SPDX-License-Identifier: BSD-3-Clause
// Splats ray traced by Embree, the peer of our ray tracer.
#pragma once

#include "peer_tracer.h"

#include <embree3/rtcore.h>

namespace uvol_bench {

/** How hits are collected. */
enum class EmbreeWay {
  UserGeometry, ///< one pass; every hit shortens the ray to a bit behind it
  OrientedDiscs ///< first hit, then a second pass whose filter collects
};

class EmbreeTracer : public PeerTracer {
public:
  EmbreeTracer(const pcl::PointCloud<pcl_uvol::PointSplat>& splats, EmbreeWay way);
  ~EmbreeTracer() override;

private:
  struct Query;

  static void
  findBounds(const RTCBoundsFunctionArguments* arguments);

  static void
  meet(const RTCIntersectFunctionNArguments* arguments);

  static void
  block(const RTCOccludedFunctionNArguments* arguments);

  static void
  keep(const RTCFilterFunctionNArguments* arguments);

  /** Refuses what meetDisc does. */
  static void
  refuse(const RTCFilterFunctionNArguments* arguments);

  void
  collect(const PeerRay& ray, Hits& hits) const override;

  bool
  isBlocked(const PeerRay& ray) const override;

  EmbreeWay way_;
  RTCDevice device_;
  RTCScene scene_;
};

} // namespace uvol_bench
