// SPDX-License-Identifier: BSD-3-Clause
#include "shared/memory_guard.h"

#include "common/memory.h"
#include "expressions/formula.h"
#include "interpolation/memory_need.h"
#include "io/memory_need.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace uvol_tools {

namespace {

/** Pages that are touched after the start, code and tables of libraries most of all
 * (measured on runs with a thousand points). */
constexpr double later_bytes = 4e6;

/** Memory that was given back, and is in use for the system all the same, since it lies
 * between blocks that are not: over what is held (measured: 0 to 6 %), and at most, as
 * large blocks go back at once. */
constexpr double scattered_share = 0.05, most_scattered_bytes = 8e6;

double
addScattered(double bytes)
{
  return bytes + std::min(scattered_share * bytes, most_scattered_bytes);
}

} // namespace

MemoryGuard::MemoryGuard(std::string task)
    : task_(std::move(task))
    , base_(static_cast<double>(pcl_uvol::residentMemory()) + later_bytes)
{
}

void
MemoryGuard::checkFile(const std::string& path,
                       const Bytes& bytes,
                       const pcl_uvol::LoadOptions& options)
{
  const auto cloud = pcl_uvol::peekHeader(path, options);
  if (!cloud)
    return;
  const auto points = static_cast<double>(cloud->points);
  const auto step = static_cast<double>(cloud->point_step);
  const double working = bytes ? points * step + bytes(points, step) : 0.0;
  forecast_ = base_ + addScattered(std::max(cloud->reading_bytes, working));
  check(points);
}

void
MemoryGuard::checkCloud(const pcl_uvol::Dataset& dataset, const Bytes& bytes)
{
  const auto points = static_cast<double>(dataset.cloud.width) *
                      static_cast<double>(dataset.cloud.height);
  const auto step = static_cast<double>(dataset.cloud.point_step);
  // Rows that were left out leave their room.
  const auto held = static_cast<double>(dataset.cloud.data.capacity());
  // What reading took is known by now.
  forecast_ = std::max(base_ + addScattered(held + bytes(points, step)),
                       static_cast<double>(pcl_uvol::peakMemory()));
  check(points);
}

Fact
MemoryGuard::describe() const
{
  const auto peak = static_cast<double>(pcl_uvol::peakMemory());
  return {"memory",
          "forecast " + pcl_uvol::formatBytes(forecast_) + ", peak " +
              pcl_uvol::formatBytes(peak),
          Fact::Members{{"forecast", {std::round(forecast_)}}, {"peak", {peak}}}};
}

void
MemoryGuard::check(double points) const
{
  std::ostringstream subject;
  subject << task_ << " of " << static_cast<std::uint64_t>(points) << " points";
  pcl_uvol::checkMemory(
      subject.str(), forecast_, static_cast<double>(pcl_uvol::residentMemory()));
}

double
derivativeBytes(const std::string& expression, double points)
{
  return pcl_uvol::mayHaveDerivative(expression) ? pcl_uvol::derivativeBytes(points)
                                                 : 0.0;
}

} // namespace uvol_tools
