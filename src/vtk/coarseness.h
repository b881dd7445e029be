// SPDX-License-Identifier: BSD-3-Clause
// How coarse frames are while a mouse drags, so that they come in time.
#pragma once

namespace pcl_uvol {

/** \brief Chooses by how much coarser than the window the next frame is, by the times
 * that the last ones took. */
class Coarseness {
public:
  /** Coarser ones hardly show what is dragged. */
  static constexpr int largest = 4;

  /** \param milliseconds what dragged frames may take */
  explicit Coarseness(double milliseconds)
      : goal_(milliseconds)
  {
  }

  /** \brief Choose anew what dragged frames may take.
   * \param milliseconds infinite: they are as fine as others */
  void
  setGoal(double milliseconds)
  {
    goal_ = milliseconds;
    was_dragged_ = false; // one is chosen as at first
  }

  /** \brief Choose for the next frame: pixels of the window beside one another that are
   * one of the frame. */
  int
  choose(bool is_dragged)
  {
    const int before = factor_;
    if (!is_dragged)
      factor_ = 1;
    else if (!was_dragged_)
      factor_ = chooseFirst();
    else
      factor_ = chooseNext();
    if (factor_ != before)
      late_ = 0;
    was_dragged_ = is_dragged;
    return factor_;
  }

  /** \brief Take what the frame took that was chosen for. */
  void
  addTime(double milliseconds)
  {
    last_ = milliseconds;
    late_ = last_ > goal_ ? late_ + 1 : 0;
  }

private:
  /** Times fall about as sides do: points take as long as pixels. */
  int
  chooseFirst() const
  {
    int factor = 1;
    while (factor < largest && last_ > factor * goal_)
      ++factor;
    return factor;
  }

  /** A single late one may have waited for something else. */
  int
  chooseNext() const
  {
    if (late_ > 1 && factor_ < largest)
      return factor_ + 1;
    const double finer = factor_ - 1.0;
    return factor_ > 1 && last_ * factor_ * factor_ <= goal_ * finer * finer
               ? factor_ - 1
               : factor_;
  }

  double goal_, last_ = 0.0;  ///< milliseconds
  int factor_ = 1, late_ = 0; ///< frames one after another
  bool was_dragged_ = false;
};

} // namespace pcl_uvol
