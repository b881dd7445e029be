// SPDX-License-Identifier: BSD-3-Clause
#include "shared/picture_series.h"

#include "charts/picture_file.h"
#include "io/unpacked_file.h"

#include <cstring>
#include <utility>

namespace uvol_tools {

void
PictureSeries::add(const Options& options,
                   ViewOptions& look,
                   pcl_uvol::Dataset&& surface,
                   const std::function<void(const pcl_uvol::Dataset& surface)>& draw)
{
  look.addTo(shared_, surface);
  const Bytes points = std::exchange(surface.cloud.data, {});
  wait(points,
       [this, &options, &look, waiting = std::move(surface), draw](Bytes&& bytes) {
         pcl_uvol::Dataset drawn = waiting;
         drawn.cloud.data = std::move(bytes);
         options.nameFiles();
         look.share(shared_);
         draw(drawn);
       });
}

void
PictureSeries::add(SlicePlot&& slice, bool has_own_scale, const std::string& path)
{
  if (!has_own_scale)
    shared_.extendRange(slice.scale);
  Bytes bytes(slice.values.size() * sizeof(float));
  std::memcpy(bytes.data(), slice.values.data(), bytes.size());
  slice.values = {};
  wait(bytes, [this, waiting = std::move(slice), has_own_scale, path](Bytes&& values) {
    SlicePlot drawn = waiting;
    drawn.values.resize(values.size() / sizeof(float));
    std::memcpy(drawn.values.data(), values.data(), values.size());
    if (!has_own_scale) {
      drawn.scale.low = (*shared_.range)[0];
      drawn.scale.high = (*shared_.range)[1];
    }
    const PictureFile file(path, drawn.paper.dots_per_inch);
    file.save(drawSlicePlot(drawn));
  });
}

void
PictureSeries::wait(const Bytes& bytes, std::function<void(Bytes&& bytes)> draw)
{
  if (!file_)
    file_.emplace(pcl_uvol::io::temporaryFolder());
  pictures_.push_back({file_->size(), bytes.size(), std::move(draw)});
  file_->append(bytes.data(), bytes.size());
}

void
PictureSeries::draw(std::size_t index)
{
  const Picture picture = std::move(pictures_[index]);
  Bytes bytes(picture.size);
  file_->read(picture.offset, bytes.data(), bytes.size());
  picture.draw(std::move(bytes));
}

} // namespace uvol_tools
