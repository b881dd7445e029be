// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/color_map.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

constexpr std::size_t colors_per_map = 33;

/** Every eighth colour of matplotlib's maps of these names (CC0; viridis and inferno by
 * S. van der Walt and N. Smith, coolwarm by Moreland 2009): what lies between is within
 * 2 of 255. */
constexpr std::uint32_t viridis[colors_per_map] = {
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453781, 0x424086,
    0x3e4989, 0x3b528b, 0x375b8d, 0x33638d, 0x2f6b8e, 0x2c728e, 0x297a8e,
    0x26828e, 0x23898e, 0x21918c, 0x1f988b, 0x1fa088, 0x22a785, 0x28ae80,
    0x32b67a, 0x3fbc73, 0x4ec36b, 0x5ec962, 0x70cf57, 0x84d44b, 0x98d83e,
    0xaddc30, 0xc2df23, 0xd8e219, 0xece51b, 0xfde725};
constexpr std::uint32_t inferno[colors_per_map] = {
    0x000004, 0x040312, 0x0b0724, 0x150b37, 0x210c4a, 0x2f0a5b, 0x3d0965,
    0x4a0c6b, 0x57106e, 0x64156e, 0x71196e, 0x7d1e6d, 0x8a226a, 0x972766,
    0xa32c61, 0xb0315b, 0xbc3754, 0xc73e4c, 0xd24644, 0xdb503b, 0xe45a31,
    0xeb6628, 0xf1731d, 0xf68013, 0xf98e09, 0xfb9d07, 0xfcac11, 0xfbbc21,
    0xf9cb35, 0xf5db4c, 0xf2ea69, 0xf3f68a, 0xfcffa4};
constexpr std::uint32_t coolwarm[colors_per_map] = {
    0x3b4cc0, 0x445acc, 0x4e68d8, 0x5875e1, 0x6282ea, 0x6c8ff1, 0x779af7,
    0x82a6fb, 0x8db0fe, 0x98b9ff, 0xa3c2fe, 0xaec9fc, 0xb9d0f9, 0xc3d5f4,
    0xccd9ed, 0xd5dbe5, 0xdddcdc, 0xe5d8d1, 0xecd3c5, 0xf1ccb8, 0xf5c4ac,
    0xf7ba9f, 0xf7b093, 0xf6a586, 0xf4987a, 0xf08b6e, 0xeb7d62, 0xe46e56,
    0xdd5f4b, 0xd44e41, 0xca3b37, 0xbe242e, 0xb40426};
constexpr std::uint32_t gray[colors_per_map] = {
    0x000000, 0x080808, 0x101010, 0x181818, 0x202020, 0x282828, 0x303030,
    0x383838, 0x404040, 0x484848, 0x505050, 0x585858, 0x606060, 0x686868,
    0x707070, 0x787878, 0x808080, 0x878787, 0x8f8f8f, 0x979797, 0x9f9f9f,
    0xa7a7a7, 0xafafaf, 0xb7b7b7, 0xbfbfbf, 0xc7c7c7, 0xcfcfcf, 0xd7d7d7,
    0xdfdfdf, 0xe7e7e7, 0xefefef, 0xf7f7f7, 0xffffff};

constexpr const std::uint32_t* maps[] = {viridis, inferno, coolwarm, gray};

/** The colour of values without a number. */
constexpr Color no_value{0.5f, 0.5f, 0.5f};

Color
fromHex(std::uint32_t rgb)
{
  const auto channel = [&](int shift) {
    return static_cast<float>((rgb >> shift) & 0xff) / 255.0f;
  };
  return {channel(16), channel(8), channel(0)};
}

} // namespace

std::uint8_t
toByte(float value)
{
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

Rgba
toRgba(const Color& color)
{
  return toByte(color.r) | Rgba{toByte(color.g)} << 8 | Rgba{toByte(color.b)} << 16 |
         0xff000000u;
}

const std::vector<std::string>&
ColorMap::names()
{
  static const std::vector<std::string> names = {
      "viridis", "inferno", "coolwarm", "gray"};
  return names;
}

ColorMap::ColorMap(const std::string& name)
{
  const auto found = std::find(names().begin(), names().end(), name);
  if (found == names().end())
    throw InvalidArgument("There is no colour map '" + name +
                          "': choose viridis, inferno, coolwarm or gray.");
  colors_ = maps[found - names().begin()];
}

Color
ColorMap::at(double position) const
{
  if (std::isnan(position))
    return no_value;
  const double place = std::clamp(position, 0.0, 1.0) * (colors_per_map - 1);
  const auto index = std::min(static_cast<std::size_t>(place), colors_per_map - 2);
  const auto part = static_cast<float>(place - static_cast<double>(index));
  const Color a = fromHex(colors_[index]), b = fromHex(colors_[index + 1]);
  return {a.r + part * (b.r - a.r), a.g + part * (b.g - a.g), a.b + part * (b.b - a.b)};
}

std::vector<Rgba>
ColorMap::apply(const std::vector<float>& values, double low, double high) const
{
  if (!std::isfinite(low) || !std::isfinite(high) || low > high)
    throw InvalidArgument("A colour range is two finite numbers, the lower one first.");
  // A table in between: as fine as 8 bits per channel can tell.
  constexpr std::size_t entries = 1024;
  std::vector<Rgba> table(entries);
  for (std::size_t i = 0; i < entries; ++i)
    table[i] = toRgba(at(static_cast<double>(i) / (entries - 1)));
  const double scale = high > low ? (entries - 1) / (high - low) : 0.0;
  const double offset = high > low ? 0.5 : 0.5 * entries;
  std::vector<Rgba> colors(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    colors[i] = std::isnan(values[i])
                    ? toRgba(no_value)
                    : table[static_cast<std::size_t>(std::clamp(
                          (values[i] - low) * scale + offset, 0.0, entries - 1.0))];
  return colors;
}

} // namespace pcl_uvol
