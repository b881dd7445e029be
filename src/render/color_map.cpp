// SPDX-License-Identifier: BSD-3-Clause
#include "common/printable.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/color_map.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pcl_uvol {

namespace {

/** Every eighth colour of matplotlib's maps of these names, or every fourth one: what
 * lies between is within 3 of 255. Viridis, inferno, magma and plasma are by S. van der
 * Walt and N. Smith, cividis by Nunez, Anderton and Renslow 2018, turbo by Mikhailov
 * 2019, coolwarm by Moreland 2009, RdBu and PuOr by C. Brewer, twilight by B. Bechtold,
 * tab10 by Tableau. OkabeIto is the palette of Okabe and Ito 2008, which people of all
 * kinds of colour vision tell apart, with its black last: light does not show on it. */
constexpr std::uint32_t viridis[] = {
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453781, 0x424086,
    0x3e4989, 0x3b528b, 0x375b8d, 0x33638d, 0x2f6b8e, 0x2c728e, 0x297a8e,
    0x26828e, 0x23898e, 0x21918c, 0x1f988b, 0x1fa088, 0x22a785, 0x28ae80,
    0x32b67a, 0x3fbc73, 0x4ec36b, 0x5ec962, 0x70cf57, 0x84d44b, 0x98d83e,
    0xaddc30, 0xc2df23, 0xd8e219, 0xece51b, 0xfde725};
constexpr std::uint32_t inferno[] = {
    0x000004, 0x040312, 0x0b0724, 0x150b37, 0x210c4a, 0x2f0a5b, 0x3d0965,
    0x4a0c6b, 0x57106e, 0x64156e, 0x71196e, 0x7d1e6d, 0x8a226a, 0x972766,
    0xa32c61, 0xb0315b, 0xbc3754, 0xc73e4c, 0xd24644, 0xdb503b, 0xe45a31,
    0xeb6628, 0xf1731d, 0xf68013, 0xf98e09, 0xfb9d07, 0xfcac11, 0xfbbc21,
    0xf9cb35, 0xf5db4c, 0xf2ea69, 0xf3f68a, 0xfcffa4};
constexpr std::uint32_t coolwarm[] = {
    0x3b4cc0, 0x445acc, 0x4e68d8, 0x5875e1, 0x6282ea, 0x6c8ff1, 0x779af7,
    0x82a6fb, 0x8db0fe, 0x98b9ff, 0xa3c2fe, 0xaec9fc, 0xb9d0f9, 0xc3d5f4,
    0xccd9ed, 0xd5dbe5, 0xdddcdc, 0xe5d8d1, 0xecd3c5, 0xf1ccb8, 0xf5c4ac,
    0xf7ba9f, 0xf7b093, 0xf6a586, 0xf4987a, 0xf08b6e, 0xeb7d62, 0xe46e56,
    0xdd5f4b, 0xd44e41, 0xca3b37, 0xbe242e, 0xb40426};
constexpr std::uint32_t gray[] = {
    0x000000, 0x080808, 0x101010, 0x181818, 0x202020, 0x282828, 0x303030,
    0x383838, 0x404040, 0x484848, 0x505050, 0x585858, 0x606060, 0x686868,
    0x707070, 0x787878, 0x808080, 0x878787, 0x8f8f8f, 0x979797, 0x9f9f9f,
    0xa7a7a7, 0xafafaf, 0xb7b7b7, 0xbfbfbf, 0xc7c7c7, 0xcfcfcf, 0xd7d7d7,
    0xdfdfdf, 0xe7e7e7, 0xefefef, 0xf7f7f7, 0xffffff};

constexpr std::uint32_t cividis[] = {
    0x00224e, 0x002554, 0x00285b, 0x002b62, 0x002e6a, 0x003070, 0x053371, 0x123570,
    0x1a386f, 0x213b6e, 0x273e6e, 0x2d416d, 0x32436d, 0x36466c, 0x3b496c, 0x3f4c6c,
    0x434e6c, 0x47516c, 0x4b546c, 0x4f576c, 0x535a6d, 0x565c6d, 0x5a5f6e, 0x5e626e,
    0x61656f, 0x656870, 0x686a71, 0x6c6d72, 0x6f7073, 0x727374, 0x767676, 0x797977,
    0x7d7c78, 0x807f78, 0x848279, 0x888578, 0x8c8878, 0x908b78, 0x938e78, 0x979177,
    0x9b9476, 0x9f9775, 0xa39a74, 0xa79d73, 0xaba072, 0xafa471, 0xb4a76f, 0xb8aa6e,
    0xbcae6c, 0xc0b16a, 0xc4b468, 0xc8b866, 0xcdbb63, 0xd1bf61, 0xd5c25e, 0xdac65b,
    0xdec958, 0xe2cd54, 0xe7d150, 0xebd44b, 0xf0d846, 0xf5dc41, 0xf9e03a, 0xfee434,
    0xfee838};
constexpr std::uint32_t magma[] = {
    0x000004, 0x030312, 0x0a0822, 0x130d34, 0x1d1147, 0x29115a, 0x36106b,
    0x440f76, 0x51127c, 0x5d177f, 0x6a1c81, 0x762181, 0x832681, 0x902a81,
    0x9c2e7f, 0xaa337d, 0xb73779, 0xc43c75, 0xd0416f, 0xdc4869, 0xe75263,
    0xef5d5e, 0xf56b5c, 0xf9795d, 0xfc8961, 0xfd9869, 0xfea772, 0xfeb67c,
    0xfec488, 0xfed395, 0xfde2a3, 0xfcf0b2, 0xfcfdbf};
constexpr std::uint32_t plasma[] = {
    0x0d0887, 0x19068c, 0x220690, 0x2a0593, 0x310597, 0x38049a, 0x3f049c, 0x46039f,
    0x4c02a1, 0x5302a3, 0x5901a5, 0x6001a6, 0x6600a7, 0x6c00a8, 0x7201a8, 0x7801a8,
    0x7e03a8, 0x8405a7, 0x8a09a5, 0x8f0da4, 0x9511a1, 0x9a169f, 0xa01a9c, 0xa51f99,
    0xaa2395, 0xae2892, 0xb32c8e, 0xb7318a, 0xbc3587, 0xc03a83, 0xc43e7f, 0xc8437b,
    0xcc4778, 0xcf4c74, 0xd35171, 0xd6556d, 0xda5a6a, 0xdd5e66, 0xe06363, 0xe3685f,
    0xe66c5c, 0xe97158, 0xeb7655, 0xee7b51, 0xf0804e, 0xf3854b, 0xf58b47, 0xf79044,
    0xf89540, 0xfa9b3d, 0xfba139, 0xfca636, 0xfdac33, 0xfdb22f, 0xfeb82c, 0xfebe2a,
    0xfdc527, 0xfdcb26, 0xfcd225, 0xfad824, 0xf8df25, 0xf6e626, 0xf4ed27, 0xf1f426,
    0xf0f921};
constexpr std::uint32_t turbo[] = {
    0x30123b, 0x392a73, 0x4040a2, 0x4456c7, 0x466be3, 0x4680f6, 0x4294ff,
    0x37a8fa, 0x28bceb, 0x1ccdd8, 0x18ddc2, 0x1fe9af, 0x32f298, 0x4ef97d,
    0x6dfe62, 0x8bff4b, 0xa4fc3c, 0xb9f635, 0xcdec34, 0xdfdf37, 0xeecf3a,
    0xf8be39, 0xfdac34, 0xfe962b, 0xfb7e21, 0xf46617, 0xeb500e, 0xdf3f08,
    0xd02f05, 0xbe2102, 0xa91601, 0x920b01, 0x7a0403};
constexpr std::uint32_t rdbu[] = {
    0x67001f, 0x730421, 0x7f0823, 0x8a0b25, 0x960f27, 0xa21328, 0xae172a, 0xb61f2e,
    0xbb2a34, 0xc13639, 0xc6413e, 0xcc4c44, 0xd25849, 0xd7634f, 0xdc6e57, 0xe17860,
    0xe58368, 0xea8e70, 0xef9979, 0xf3a481, 0xf5ac8b, 0xf7b596, 0xf8bda1, 0xf9c6ac,
    0xfbceb7, 0xfcd7c2, 0xfdddcb, 0xfce2d2, 0xfbe6da, 0xfaeae1, 0xf9efe9, 0xf8f3f0,
    0xf6f7f7, 0xf0f4f6, 0xeaf1f5, 0xe4eef4, 0xdeebf2, 0xd8e9f1, 0xd2e6f0, 0xcae1ee,
    0xc0dceb, 0xb6d7e8, 0xacd2e5, 0xa2cde3, 0x98c8e0, 0x8dc2dc, 0x81bad8, 0x75b2d4,
    0x68abd0, 0x5ca3cb, 0x4f9bc7, 0x4393c3, 0x3e8cbf, 0x3885bc, 0x337eb8, 0x2e77b5,
    0x2870b1, 0x2369ad, 0x1e61a5, 0x1a5899, 0x15508d, 0x114781, 0x0d3f76, 0x08366a,
    0x053061};
constexpr std::uint32_t puor[] = {
    0x7f3b08, 0x874008, 0x8f4407, 0x974907, 0xa04d07, 0xa85206, 0xb05606, 0xb75c07,
    0xbe630a, 0xc6690c, 0xcd700e, 0xd47610, 0xdb7d12, 0xe18417, 0xe68d23, 0xea9530,
    0xef9e3c, 0xf3a649, 0xf8ae55, 0xfcb761, 0xfdbd6e, 0xfdc47b, 0xfdca88, 0xfed095,
    0xfed7a2, 0xfeddaf, 0xfde2bb, 0xfce5c5, 0xfbe9cf, 0xfaedda, 0xf9f0e4, 0xf8f4ee,
    0xf6f6f7, 0xf2f2f5, 0xededf3, 0xe8e9f1, 0xe3e4ef, 0xdee0ed, 0xd9dbeb, 0xd4d4e8,
    0xcecde4, 0xc8c6e0, 0xc2bedc, 0xbcb7d8, 0xb6b0d4, 0xafa8d0, 0xa79fca, 0x9f96c4,
    0x988dbe, 0x9085b8, 0x887cb2, 0x8073ac, 0x7967a6, 0x725ba1, 0x6b4f9b, 0x644395,
    0x5d3790, 0x572b8a, 0x502382, 0x4a1d78, 0x44176f, 0x3e1165, 0x380b5c, 0x320552,
    0x2d004b};
constexpr std::uint32_t twilight[] = {
    0xe2d9e2, 0xddd9e0, 0xd6d7dd, 0xcdd3d8, 0xc2ced4, 0xb6c8cf, 0xaac2cc,
    0x9ebbc9, 0x93b4c6, 0x89adc5, 0x80a5c3, 0x789ec2, 0x7196c1, 0x6c8ebf,
    0x6786be, 0x647dbc, 0x6275ba, 0x606cb8, 0x5f62b4, 0x5f59b1, 0x5e4fac,
    0x5e46a6, 0x5d3ca0, 0x5b3298, 0x59298e, 0x562182, 0x511a75, 0x4b1668,
    0x44135a, 0x3d114e, 0x371144, 0x33113c, 0x2f1436};
constexpr std::uint32_t okabe_ito[] = {
    0xe69f00, 0x56b4e9, 0x009e73, 0xf0e442, 0x0072b2, 0xd55e00, 0xcc79a7, 0x000000};
constexpr std::uint32_t tab10[] = {0x1f77b4,
                                   0xff7f0e,
                                   0x2ca02c,
                                   0xd62728,
                                   0x9467bd,
                                   0x8c564b,
                                   0xe377c2,
                                   0x7f7f7f,
                                   0xbcbd22,
                                   0x17becf};

struct NamedMap {
  const char* name;
  const std::uint32_t* colors;
  std::size_t count;
  bool is_categorical;
};

template <std::size_t N>
constexpr NamedMap
shades(const char* name, const std::uint32_t (&colors)[N])
{
  return {name, colors, N, false};
}

constexpr NamedMap maps[] = {
    shades("viridis", viridis),
    shades("cividis", cividis),
    shades("inferno", inferno),
    shades("magma", magma),
    shades("plasma", plasma),
    shades("turbo", turbo),
    shades("gray", gray),
    shades("coolwarm", coolwarm),
    shades("RdBu", rdbu),
    shades("PuOr", puor),
    shades("twilight", twilight),
    {"OkabeIto", okabe_ito, std::size(okabe_ito), true},
    {"tab10", tab10, std::size(tab10), true},
};

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
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const NamedMap& map : maps)
      list.emplace_back(map.name);
    return list;
  }();
  return names;
}

ColorMap::ColorMap(const std::string& name)
{
  const std::string reversed = "_r";
  const std::size_t stem =
      name.size() > reversed.size() ? name.size() - reversed.size() : name.size();
  is_reversed_ = name.substr(stem) == reversed;
  const std::string plain = is_reversed_ ? name.substr(0, stem) : name;
  for (const NamedMap& map : maps)
    if (plain == map.name) {
      colors_ = map.colors;
      count_ = map.count;
      is_categorical_ = map.is_categorical;
      return;
    }
  std::string list;
  for (const NamedMap& map : maps)
    list += (list.empty() ? "" : ", ") + std::string(map.name);
  throw InvalidArgument("unknown_color_map",
                        {{"map", shortenText(name)}, {"maps", list}});
}

Color
ColorMap::colorAt(std::size_t index) const
{
  return fromHex(colors_[is_reversed_ ? count_ - 1 - index : index]);
}

Color
ColorMap::at(double position) const
{
  if (std::isnan(position))
    return no_value;
  const double inside = std::clamp(position, 0.0, 1.0);
  if (is_categorical_)
    return colorAt(std::min(
        static_cast<std::size_t>(inside * static_cast<double>(count_)), count_ - 1));
  const double place = inside * static_cast<double>(count_ - 1);
  const auto index = std::min(static_cast<std::size_t>(place), count_ - 2);
  const auto part = static_cast<float>(place - static_cast<double>(index));
  const Color a = colorAt(index), b = colorAt(index + 1);
  return {a.r + part * (b.r - a.r), a.g + part * (b.g - a.g), a.b + part * (b.b - a.b)};
}

Color
ColorMap::ofCategory(double category) const
{
  if (!std::isfinite(category) || category < 0.0)
    return no_value;
  return colorAt(static_cast<std::size_t>(
      std::fmod(std::floor(category), static_cast<double>(count_))));
}

std::vector<Rgba>
ColorMap::apply(const std::vector<float>& values, double low, double high) const
{
  if (!std::isfinite(low) || !std::isfinite(high) || low > high)
    throw InvalidArgument("bad_color_range", {});
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
