// SPDX-License-Identifier: BSD-3-Clause
#include "support/snapshots.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace uvol_test {
namespace {

class Writer {
public:
  explicit Writer(const GadgetLayout& layout)
      : layout_(layout)
  {
  }

  template <typename T>
  static void
  append(std::string& bytes, T value, bool turned)
  {
    std::string own(reinterpret_cast<const char*>(&value), sizeof(value));
    if (turned)
      std::reverse(own.begin(), own.end());
    bytes += own;
  }

  template <typename T>
  void
  add(std::string& bytes, T value) const
  {
    append(bytes, value, layout_.big_endian);
  }

  void
  addReal(std::string& bytes, double value) const
  {
    if (layout_.doubles)
      add(bytes, value);
    else
      add(bytes, static_cast<float>(value));
  }

  void
  addRecord(const std::string& content)
  {
    add(bytes_, static_cast<std::uint32_t>(content.size()));
    bytes_ += content;
    add(bytes_, static_cast<std::uint32_t>(content.size()));
  }

  void
  addBlock(const std::string& label, const std::string& content)
  {
    if (layout_.has_labels) {
      std::string name = label + std::string(4 - label.size(), ' ');
      add(name, static_cast<std::uint32_t>(content.size() + 8));
      addRecord(name);
    }
    addRecord(content);
  }

  std::string bytes_;

private:
  const GadgetLayout& layout_;
};

} // namespace

double
snapshotNumber(std::uint32_t particle, int field, int component)
{
  return 0.5 * particle + 100.0 * field + 0.125 * component;
}

std::string
makeGadget(const GadgetLayout& layout)
{
  Writer writer(layout);
  std::string header;
  for (const std::uint32_t count : layout.here)
    writer.add(header, count);
  for (const double mass : layout.masses)
    writer.add(header, mass);
  writer.add(header, layout.time);
  writer.add(header, layout.redshift);
  writer.add(header, std::int32_t(0));
  writer.add(header, std::int32_t(0));
  for (const std::uint32_t count : layout.total)
    writer.add(header, count);
  writer.add(header, std::int32_t(0));
  writer.add(header, layout.files);
  for (const double number : {layout.box, layout.omega, 0.7, layout.hubble})
    writer.add(header, number);
  header.resize(256);
  writer.addBlock("HEAD", header);

  const std::uint32_t all = std::accumulate(layout.here.begin(), layout.here.end(), 0u);
  const auto block = [&](const char* label,
                         int field,
                         int components,
                         const std::function<bool(std::size_t kind)>& has) {
    std::string content;
    std::uint32_t particle = layout.first;
    for (std::size_t kind = 0; kind < 6; ++kind)
      for (std::uint32_t i = 0; i < layout.here[kind]; ++i, ++particle)
        for (int k = 0; has(kind) && k < components; ++k)
          writer.addReal(content, snapshotNumber(particle, field, k));
    if (!content.empty())
      writer.addBlock(label, content);
  };
  const auto every = [](std::size_t) { return true; };
  const auto gas = [](std::size_t kind) { return kind == 0; };
  block("POS", 0, 3, every);
  block("VEL", 1, 3, every);
  std::string ids;
  for (std::uint32_t i = 0; i < all; ++i)
    writer.add(ids, layout.first + i);
  writer.addBlock("ID", ids);
  block("MASS", 2, 1, [&](std::size_t kind) { return layout.masses[kind] == 0.0; });
  block("U", 3, 1, gas);
  block("RHO", 4, 1, gas);
  block("HSML", 5, 1, gas);
  return writer.bytes_;
}

} // namespace uvol_test
