// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/lattice_band.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

using Key = std::uint64_t;

constexpr int key_bits = 21;
constexpr std::int32_t key_offset = 1 << (key_bits - 1);
constexpr Key key_mask = (Key{1} << key_bits) - 1;

Key
toKey(const LatticeNode& node)
{
  Key key = 0;
  for (const std::int32_t coordinate : node)
    key = (key << key_bits) | (static_cast<Key>(coordinate + key_offset) & key_mask);
  return key;
}

LatticeNode
toNode(Key key)
{
  LatticeNode node;
  for (int axis = 2; axis >= 0; --axis) {
    node[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(key & key_mask) - key_offset;
    key >>= key_bits;
  }
  return node;
}

/** A key so many steps along the axes from another one. */
Key
shifted(Key key, int x, int y, int z)
{
  const LatticeNode node = toNode(key);
  return toKey({node[0] + x, node[1] + y, node[2] + z});
}

Key
cornerOf(Key cell, int corner)
{
  return shifted(cell, corner & 1, (corner >> 1) & 1, corner >> 2);
}

/** Cells with a corner in common with one, and it itself. */
std::vector<Key>
around(Key cell)
{
  std::vector<Key> cells;
  for (int i = 0; i < 27; ++i)
    cells.push_back(shifted(cell, i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
  return cells;
}

void
sortUnique(std::vector<Key>& keys)
{
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

} // namespace

bool
LatticeBand::evaluateCorners(const std::vector<Key>& cells)
{
  std::vector<Key> missing;
  for (const Key cell : cells)
    for (int corner = 0; corner < 8; ++corner)
      if (const Key key = cornerOf(cell, corner); nodes_.count(key) == 0)
        missing.push_back(key);
  sortUnique(missing);
  if (nodes_.size() + missing.size() > most_)
    return false;
  std::vector<LatticeNode> places(missing.size());
  std::transform(missing.begin(), missing.end(), places.begin(), toNode);
  const std::vector<NodeValue> values = evaluate_(places);
  for (std::size_t i = 0; i < missing.size(); ++i)
    nodes_.emplace(missing[i], values[i]);
  return true;
}

bool
LatticeBand::isCrossed(Key cell, double isovalue) const
{
  std::size_t above = 0, asked = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const NodeValue& node = nodes_.at(cornerOf(cell, corner));
    if (std::isnan(node.value))
      return false;
    above += node.value >= isovalue;
    asked += node.is_asked;
  }
  return above > 0 && above < 8 && asked > 0;
}

bool
LatticeBand::follow(const std::vector<LatticeNode>& seeds, double isovalue)
{
  std::vector<Key> front;
  for (const LatticeNode& seed : seeds)
    for (const Key cell : around(toKey(seed)))
      front.push_back(cell);
  sortUnique(front);
  std::unordered_set<Key> visited(front.begin(), front.end());
  while (!front.empty()) {
    if (!evaluateCorners(front))
      return false;
    std::vector<Key> crossed, next;
    for (const Key cell : front)
      if (isCrossed(cell, isovalue))
        for (const Key other : around(cell)) {
          crossed.push_back(other);
          if (visited.insert(other).second)
            next.push_back(other);
        }
    sortUnique(crossed);
    if (!evaluateCorners(crossed))
      return false;
    for (const Key cell : crossed)
      for (int corner = 0; corner < 8; ++corner)
        collected_.insert(cornerOf(cell, corner));
    sortUnique(next);
    front.swap(next);
  }
  return true;
}

std::vector<std::pair<LatticeNode, double>>
LatticeBand::listNodes() const
{
  std::vector<Key> keys;
  for (const Key key : collected_)
    if (const NodeValue& node = nodes_.at(key);
        node.is_asked && !std::isnan(node.value))
      keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  std::vector<std::pair<LatticeNode, double>> nodes;
  for (const Key key : keys)
    nodes.emplace_back(toNode(key), nodes_.at(key).value);
  return nodes;
}

} // namespace pcl_uvol::detail
