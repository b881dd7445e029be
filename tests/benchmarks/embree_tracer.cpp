// SPDX-License-Identifier: BSD-3-Clause
#include "embree_tracer.h"

#include <algorithm>
#include <cmath>

namespace uvol_bench {

struct EmbreeTracer::Query {
  RTCIntersectContext context; // first: Embree hands it back
  PeerRay ray;
  Hits* hits;

  explicit Query(const PeerRay& from, Hits* found = nullptr)
      : ray(from)
      , hits(found)
  {
    rtcInitIntersectContext(&context);
  }

  static Query&
  of(RTCIntersectContext* context)
  {
    return *reinterpret_cast<Query*>(context);
  }
};

EmbreeTracer::EmbreeTracer(const pcl::PointCloud<pcl_uvol::PointSplat>& splats,
                           EmbreeWay way)
    : PeerTracer(splats)
    , way_(way)
    , device_(rtcNewDevice(nullptr))
    , scene_(rtcNewScene(device_))
{
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  const bool is_user = way == EmbreeWay::UserGeometry;
  const RTCGeometry geometry = rtcNewGeometry(
      device_,
      is_user ? RTC_GEOMETRY_TYPE_USER : RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
  if (is_user) {
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(splats.size()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, findBounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet);
    rtcSetGeometryOccludedFunction(geometry, block);
  }
  else {
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, splats.size()));
    auto* const normals = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 12, splats.size()));
    for (std::size_t i = 0; i < splats.size(); ++i) {
      std::copy(splats[i].data, splats[i].data + 3, vertices + 4 * i);
      vertices[4 * i + 3] = splats[i].radius;
      std::copy(splats[i].data_n, splats[i].data_n + 3, normals + 3 * i);
    }
    rtcSetGeometryUserData(geometry, this);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

EmbreeTracer::~EmbreeTracer()
{
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void
EmbreeTracer::findBounds(const RTCBoundsFunctionArguments* arguments)
{
  const auto& tracer = *static_cast<const EmbreeTracer*>(arguments->geometryUserPtr);
  const pcl_uvol::PointSplat& splat = tracer.splats_[arguments->primID];
  float low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    const float n = splat.data_n[axis];
    const float half = splat.radius * std::sqrt(std::max(0.0f, 1.0f - n * n)) + 1e-6f;
    low[axis] = splat.data[axis] - half;
    high[axis] = splat.data[axis] + half;
  }
  *arguments->bounds_o = {
      low[0], low[1], low[2], 0.0f, high[0], high[1], high[2], 0.0f};
}

namespace {

RTCRay
makeRay(const PeerRay& ray)
{
  return {ray.origin[0],
          ray.origin[1],
          ray.origin[2],
          0.0f,
          ray.direction[0],
          ray.direction[1],
          ray.direction[2],
          0.0f,
          infinity,
          0xffffffffu,
          0,
          0};
}

} // namespace

void
EmbreeTracer::meet(const RTCIntersectFunctionNArguments* arguments)
{
  const auto& tracer = *static_cast<const EmbreeTracer*>(arguments->geometryUserPtr);
  const Query& query = Query::of(arguments->context);
  Hits& hits = *query.hits;
  auto& rayhit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  RTCRay& ray = rayhit.ray;
  const pcl_uvol::PointSplat& splat = tracer.splats_[arguments->primID];
  float distance, sq_offset;
  if (!meetDisc(splat, query.ray, ray.tfar, distance, sq_offset))
    return;
  hits.add({distance, sq_offset, arguments->primID}, splat.radius);
  ray.tfar = std::min(ray.tfar, hits.limit);
  rayhit.hit.geomID = arguments->geomID;
}

void
EmbreeTracer::block(const RTCOccludedFunctionNArguments* arguments)
{
  const auto& tracer = *static_cast<const EmbreeTracer*>(arguments->geometryUserPtr);
  RTCRay& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  float distance, sq_offset;
  if (meetDisc(tracer.splats_[arguments->primID],
               Query::of(arguments->context).ray,
               ray.tfar,
               distance,
               sq_offset))
    ray.tfar = -infinity;
}

void
EmbreeTracer::keep(const RTCFilterFunctionNArguments* arguments)
{
  const Query& query = Query::of(arguments->context);
  const auto& tracer = *static_cast<const EmbreeTracer*>(arguments->geometryUserPtr);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  const pcl_uvol::PointSplat& splat = tracer.splats_[hit.primID];
  float distance, sq_offset;
  // Not up to ray.tfar: that is Embree's distance of this very hit, and ours may be
  // rounded to just behind it.
  if (meetDisc(splat, query.ray, infinity, distance, sq_offset))
    query.hits->add({distance, sq_offset, hit.primID}, splat.radius);
  arguments->valid[0] = 0;
}

void
EmbreeTracer::refuse(const RTCFilterFunctionNArguments* arguments)
{
  const auto& tracer = *static_cast<const EmbreeTracer*>(arguments->geometryUserPtr);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  float distance, sq_offset;
  if (!meetDisc(tracer.splats_[hit.primID],
                Query::of(arguments->context).ray,
                infinity,
                distance,
                sq_offset))
    arguments->valid[0] = 0;
}

void
EmbreeTracer::collect(const PeerRay& ray, Hits& hits) const
{
  Query query(ray, &hits);
  if (way_ == EmbreeWay::OrientedDiscs)
    query.context.filter = refuse;
  RTCRayHit rayhit{};
  rayhit.ray = makeRay(ray);
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &query.context, &rayhit);
  if (way_ == EmbreeWay::UserGeometry || rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
    return;
  hits.limit = rayhit.ray.tfar + part_of_radius * splats_[rayhit.hit.primID].radius;
  query.context.filter = keep;
  rayhit.ray.tfar = hits.limit;
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &query.context, &rayhit);
}

bool
EmbreeTracer::isBlocked(const PeerRay& ray) const
{
  Query query(ray);
  if (way_ == EmbreeWay::OrientedDiscs)
    query.context.filter = refuse;
  RTCRay sent = makeRay(ray);
  rtcOccluded1(scene_, &query.context, &sent);
  return sent.tfar < 0.0f;
}

} // namespace uvol_bench
