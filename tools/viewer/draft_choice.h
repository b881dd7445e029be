// SPDX-License-Identifier: BSD-3-Clause
// How coarse an isosurface is that is shown at once while a slider is dragged.
#pragma once

#include <cmath>

namespace uvol_tools {

/** \brief Chooses of how few samples a draft of the next isosurface is made, by the
 * times that the last surfaces took. */
class DraftChoice {
public:
  /** \brief Fewer samples hardly show what the surface is like. */
  static constexpr unsigned largest = 64;

  /** \param milliseconds what a surface may take */
  explicit DraftChoice(double milliseconds)
      : goal_(milliseconds)
  {
  }

  /** \brief Choose for the next surface: one of so many samples is taken; 1 where all
   * of them take no longer than what is aimed at, or where nothing is known yet. */
  unsigned
  choose()
  {
    if (isFar(thinning_)) {
      thinning_ = 1;
      while (thinning_ < largest && expect(thinning_) > goal_)
        thinning_ *= 2;
    }
    return thinning_;
  }

  /** \brief Take what a surface took of one of so many samples. The first one of as
   * many does not count: a tree was built for it. */
  void
  addTime(unsigned thinning, double milliseconds)
  {
    const bool is_first = thinning > 1 && thinning != reported_;
    if (thinning > 1)
      reported_ = thinning;
    if (!is_first)
      whole_ = milliseconds * shareOfWhole(thinning);
  }

private:
  /** Samples of all points over those of a surface, as a volume and its surface go. */
  static double
  shareOfWhole(unsigned thinning)
  {
    return std::pow(thinning, 2.0 / 3.0);
  }

  double
  expect(unsigned thinning) const
  {
    return whole_ / shareOfWhole(thinning);
  }

  /** Whether as many samples take too long, or so little that twice as many would not:
   * another choice costs a tree, so that it is not made for small differences. */
  bool
  isFar(unsigned thinning) const
  {
    constexpr double most = 1.3, least = 0.5;
    const double expected = expect(thinning);
    return expected > (thinning > 1 ? most : 1.0) * goal_ ||
           (thinning > 1 && expected < least * goal_);
  }

  double goal_, whole_ = 0.0; ///< milliseconds; of all samples
  unsigned thinning_ = 1;
  unsigned reported_ = 0; ///< of the last draft
};

} // namespace uvol_tools
