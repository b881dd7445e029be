// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/layer_blend.h"

#include "common/parallel.h"
#include "render/lighting.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

/** A colour with opacity, not premultiplied, in [0, 255] and [0, 1]. */
struct Paint {
  std::array<double, 3> color;
  double opacity;
};

void
layOver(const std::uint8_t* pixel, double opacity, Paint& below)
{
  const double above = opacity * pixel[3] / 255.0;
  const double left = below.opacity * (1.0 - above), sum = above + left;
  if (!(above > 0.0))
    return;
  for (std::size_t k = 0; k < 3; ++k)
    below.color[k] = (pixel[k] * above + below.color[k] * left) / sum;
  below.opacity = sum;
}

/** \param below see backgroundAt() */
Paint
groundOf(const Background& background, float below)
{
  if (background.kind == Background::Kind::Transparent)
    return {{0.0, 0.0, 0.0}, 0.0};
  const Color color = backgroundAt(background, below);
  return {{255.0 * color.r, 255.0 * color.g, 255.0 * color.b}, 1.0};
}

} // namespace

void
blendLayers(const std::vector<SurfaceLayer>& layers,
            const Background& background,
            bool with_depth,
            unsigned threads,
            Image& image)
{
  const Image& first = layers.front().image;
  const std::size_t width = first.width, height = first.height;
  image = Image();
  image.width = first.width;
  image.height = first.height;
  image.color.resize(4 * image.pixels());
  image.depth.resize(with_depth ? image.pixels() : 0, 1.0f);
  parallelBlocks(height, 1, threads, [&](std::size_t row, std::size_t) {
    const Paint ground = groundOf(
        background, (static_cast<float>(row) + 0.5f) / static_cast<float>(height));
    std::vector<const SurfaceLayer*> order;
    for (std::size_t pixel = row * width; pixel < (row + 1) * width; ++pixel) {
      order.clear();
      for (const SurfaceLayer& layer : layers)
        if (layer.image.color[4 * pixel + 3] > 0)
          order.push_back(&layer);
      const auto distance = [&](const SurfaceLayer* layer) {
        return layer->image.depth[pixel] * layer->depth_unit;
      };
      std::stable_sort(order.begin(), order.end(), [&](const auto* a, const auto* b) {
        return distance(a) > distance(b);
      });
      Paint paint = ground;
      for (const SurfaceLayer* const layer : order) {
        layOver(&layer->image.color[4 * pixel], layer->opacity, paint);
        if (with_depth && layer->opacity > 0.0)
          image.depth[pixel] =
              static_cast<float>(distance(layer) / layers.front().depth_unit);
      }
      for (std::size_t k = 0; k < 3; ++k)
        image.color[4 * pixel + k] =
            static_cast<std::uint8_t>(std::lround(paint.color[k]));
      image.color[4 * pixel + 3] =
          static_cast<std::uint8_t>(std::lround(255.0 * paint.opacity));
    }
  });
}

} // namespace pcl_uvol::detail
