// SPDX-License-Identifier: BSD-3-Clause
// A sample of a stream that depends neither on its order nor on how it was divided.
#pragma once

#include "common/random.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace pcl_uvol {

/** \brief The distinct items of lowest hash among all that were added (bottom-k
 * sketch): random ones, and the same for any order and division of them. Items that
 * come many times, as (0, 0, 0) for what was not measured, count once.
 * \tparam dimensions numbers of an item, which are finite */
template <std::size_t dimensions>
class Sketch {
public:
  using Item = std::array<double, dimensions>;

  /** \brief Items that are kept: quantiles of them are off by 2 % of all items. */
  static constexpr std::size_t most_items = 1024;

  void
  add(Item item)
  {
    std::uint64_t hash = 0;
    for (double& number : item) {
      number += 0.0; // -0 is 0
      std::uint64_t bits;
      std::memcpy(&bits, &number, sizeof(bits));
      hash = mixBits(hash ^ bits);
    }
    if (hash > limit_)
      return;
    entries_[count_++] = {hash, item};
    if (count_ == entries_.size())
      prune();
  }

  /** \brief Add what another sketch was given. */
  void
  add(const Sketch& other)
  {
    for (std::size_t i = 0; i < other.count_; ++i)
      add(other.entries_[i].item);
  }

  /** \brief The items in the order of their hashes: the first of
   * them are a sketch as well. */
  std::vector<Item>
  getItems() const
  {
    Sketch copy = *this;
    copy.prune();
    std::vector<Item> items;
    for (std::size_t i = 0; i < copy.count_; ++i)
      items.push_back(copy.entries_[i].item);
    return items;
  }

private:
  struct Entry {
    std::uint64_t hash;
    Item item;

    bool
    operator<(const Entry& other) const
    {
      return hash != other.hash ? hash < other.hash : item < other.item;
    }
    bool
    operator==(const Entry& other) const
    {
      return hash == other.hash && item == other.item;
    }
  };

  void
  prune()
  {
    const auto begin = entries_.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(count_);
    std::sort(begin, end);
    count_ = static_cast<std::size_t>(std::unique(begin, end) - begin);
    if (count_ < most_items)
      return;
    count_ = most_items;
    limit_ = entries_[count_ - 1].hash;
  }

  std::array<Entry, 2 * most_items> entries_;
  std::size_t count_ = 0;
  std::uint64_t limit_ = std::numeric_limits<std::uint64_t>::max();
};

} // namespace pcl_uvol
