// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/iso_edges.h"

#include "common/memory.h"
#include "common/parallel.h"
#include "common/records.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <algorithm>
#include <cstring>
#include <unordered_set>

namespace pcl_uvol {

namespace {

constexpr std::size_t edge_block = 1u << 13;

/** Bytes that go from one point layout to another. */
struct FieldCopy {
  std::size_t from, to, size;
  std::uint8_t datatype;
  std::size_t count;
  bool interpolated;
};

std::size_t
countOf(const pcl::PCLPointField& field)
{
  return std::max<std::size_t>(field.count, 1);
}

/** Append a field to a packed layout and tell how to fill it. */
FieldCopy
append(const pcl::PCLPointField& field, pcl::PCLPointCloud2& layout)
{
  const bool floating = field.datatype == pcl::PCLPointField::FLOAT32 ||
                        field.datatype == pcl::PCLPointField::FLOAT64;
  // PCL packs colours into a float's bits.
  const bool nominal =
      field.name == "rgb" || field.name == "rgba" || field.name == "label";
  const std::size_t size = fieldBytes(field);
  const FieldCopy copy{field.offset,
                       layout.point_step,
                       size,
                       field.datatype,
                       countOf(field),
                       floating && !nominal};
  layout.fields.push_back(field);
  layout.fields.back().offset = layout.point_step;
  layout.fields.back().count = static_cast<pcl::uindex_t>(copy.count);
  layout.point_step += static_cast<pcl::uindex_t>(size);
  return copy;
}

template <typename T>
void
interpolate(const std::uint8_t* a,
            const std::uint8_t* b,
            double t,
            std::size_t count,
            std::uint8_t* out)
{
  for (std::size_t k = 0; k < count; ++k) {
    T first, second;
    std::memcpy(&first, a + k * sizeof(T), sizeof(T));
    std::memcpy(&second, b + k * sizeof(T), sizeof(T));
    // A foot on a sample takes its value even if the other one has none.
    const double value = t == 0.0   ? static_cast<double>(first)
                         : t == 1.0 ? static_cast<double>(second)
                                    : (1.0 - t) * static_cast<double>(first) +
                                          t * static_cast<double>(second);
    const T converted = static_cast<T>(value);
    std::memcpy(out + k * sizeof(T), &converted, sizeof(T));
  }
}

void
fill(const FieldCopy& copy,
     const std::uint8_t* first,
     const std::uint8_t* second,
     double t,
     std::uint8_t* out)
{
  first += copy.from;
  second += copy.from;
  out += copy.to;
  if (!copy.interpolated)
    std::memcpy(out, t <= 0.5 ? first : second, copy.size);
  else if (copy.datatype == pcl::PCLPointField::FLOAT32)
    interpolate<float>(first, second, t, copy.count, out);
  else
    interpolate<double>(first, second, t, copy.count, out);
}

} // namespace

std::size_t
filterIsopoints(pcl::PointCloud<PointIso>& isopoints,
                IsoEdges& edges,
                const std::function<bool(const PointIso&)>& keep)
{
  if (isopoints.size() != edges.size())
    throw InvalidArgument("isopoints_of_other_edges",
                          {{"isopoints", isopoints.size()}, {"edges", edges.size()}});
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (keep(isopoints[i])) {
      isopoints[kept] = isopoints[i];
      edges[kept++] = edges[i];
    }
  const std::size_t gone = edges.size() - kept;
  isopoints.resize(kept);
  edges.resize(kept);
  return gone;
}

void
interpolateFields(const CloudView& samples,
                  const IsoEdges& edges,
                  pcl::PCLPointCloud2& isopoints,
                  unsigned threads)
{
  if (static_cast<std::size_t>(isopoints.width) * isopoints.height != edges.size())
    throw InvalidArgument("edges_of_other_isopoints", {{"edges", edges.size()}});
  for (const IsoEdge& edge : edges)
    if (edge.first >= samples.count || edge.second >= samples.count)
      throw InvalidArgument("edge_outside_samples", {});

  pcl::PCLPointCloud2 result;
  result.header = isopoints.header;
  result.height = 1;
  result.width = static_cast<pcl::uindex_t>(edges.size());
  result.is_dense = isopoints.is_dense;
  result.point_step = 0;
  std::vector<FieldCopy> own, carried;
  std::unordered_set<std::string> taken;
  for (const auto& field : isopoints.fields)
    if (!isPadding(field)) {
      own.push_back(append(field, result));
      taken.insert(field.name);
    }
  for (const auto& field : samples.fields)
    if (!isPadding(field) && taken.insert(field.name).second)
      carried.push_back(append(field, result));
  constexpr pcl::uindex_t alignment = sizeof(float); // so that viewOf() takes it
  result.point_step = (result.point_step + alignment - 1) / alignment * alignment;
  result.row_step = result.point_step * result.width;
  result.data.resize(static_cast<std::size_t>(result.point_step) * edges.size());
  parallelBlocks(
      edges.size(), edge_block, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          std::uint8_t* const out = &result.data[i * result.point_step];
          for (const FieldCopy& copy : own)
            std::memcpy(out + copy.to,
                        &isopoints.data[i * isopoints.point_step + copy.from],
                        copy.size);
          for (const FieldCopy& copy : carried)
            fill(copy,
                 samples.point(edges[i].first),
                 samples.point(edges[i].second),
                 edges[i].t,
                 out);
        }
      });
  isopoints = std::move(result);
}

void
interpolateFields(const pcl::PCLPointCloud2& samples,
                  const IsoEdges& edges,
                  pcl::PCLPointCloud2& isopoints,
                  unsigned threads)
{
  CloudView view;
  view.data = samples.data.data();
  view.count = static_cast<std::size_t>(samples.width) * samples.height;
  view.point_step = samples.point_step;
  view.fields = samples.fields;
  interpolateFields(view, edges, isopoints, threads);
}

void
copyFields(const pcl::PCLPointCloud2& cloud,
           const std::vector<std::uint32_t>& sources,
           pcl::PCLPointCloud2& points,
           unsigned threads)
{
  const double row = sizeof(IsoEdge) + static_cast<double>(points.point_step) +
                     static_cast<double>(cloud.point_step);
  checkMemoryOf(
      "Copying the fields", sources.size(), row * static_cast<double>(sources.size()));
  IsoEdges same;
  same.reserve(sources.size());
  for (const std::uint32_t source : sources)
    same.push_back({source, source, 0.0f});
  interpolateFields(cloud, same, points, threads);
}

void
warnOfReplacedFields(const std::vector<pcl::PCLPointField>& samples,
                     const std::vector<pcl::PCLPointField>& isopoints,
                     Report& report)
{
  for (const auto& field : isopoints)
    if (!isPadding(field) && axisOf(field.name) < 0 &&
        field.name.rfind("normal_", 0) != 0 &&
        findField(samples, field.name) != nullptr)
      report.warn("replaced_field", {{"field", field.name}});
}

} // namespace pcl_uvol
