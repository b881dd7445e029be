// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/membership.h"

#include "common/parallel.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace pcl_uvol {

namespace {

/** Particles of a leaf at most, and of a subtree that is built without forking. */
constexpr std::size_t leaf_particles = 16, serial_particles = 1u << 12;
/** Leaves that are smoothed at a time. */
constexpr std::size_t block_leaves = 64;
/** Labels that a message lists. */
constexpr std::size_t most_listed = 20;

struct Particle {
  std::array<float, 3> x;
  float h;
  float value;
  std::uint32_t index; ///< of its value
};

struct Box {
  std::array<double, 3> low, high;

  static Box
  empty()
  {
    constexpr double far = std::numeric_limits<double>::infinity();
    return {{far, far, far}, {-far, -far, -far}};
  }

  void
  add(const Particle& particle, double reach)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], particle.x[axis] - reach);
      high[axis] = std::max(high[axis], particle.x[axis] + reach);
    }
  }

  void
  add(const Box& other)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }

  bool
  meets(const Box& other) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (other.low[axis] > high[axis] || other.high[axis] < low[axis])
        return false;
    return true;
  }
};

/** A balanced tree over particles whose nodes know how far these reach: it finds all
 * whose support holds a place, however much smoothing lengths vary. */
class SupportTree {
public:
  SupportTree(std::vector<Particle> particles, unsigned threads)
      : particles_(std::move(particles))
  {
    std::size_t nodes = 1;
    for (std::size_t size = particles_.size(); size > leaf_particles; size -= size / 2)
      nodes = 2 * nodes + 1;
    supports_.resize(nodes);
    TaskGroup::run(threads, [&] { build({0, 0, particles_.size()}); });
    listLeaves({0, 0, particles_.size()});
  }

  /** Children of node n are 2n + 1 and 2n + 2, with a half each. */
  struct Node {
    std::size_t number, begin, end;

    bool
    isLeaf() const
    {
      return end - begin <= leaf_particles;
    }
    Node
    left() const
    {
      return {2 * number + 1, begin, begin + (end - begin) / 2};
    }
    Node
    right() const
    {
      return {2 * number + 2, begin + (end - begin) / 2, end};
    }
  };

  const std::vector<Particle>&
  getParticles() const
  {
    return particles_;
  }

  const std::vector<Node>&
  getLeaves() const
  {
    return leaves_;
  }

  /** Leaves with particles that may reach into a box, in the order of the tree. */
  void
  findReaching(const Box& box, std::vector<Node>& reaching) const
  {
    reaching.clear();
    search({0, 0, particles_.size()}, box, reaching);
  }

private:
  /** Splits the longest side of the positions; ties are broken by index, so that there
   * is one tree. */
  void
  split(const Node& node)
  {
    Box places = Box::empty();
    for (std::size_t i = node.begin; i < node.end; ++i)
      places.add(particles_[i], 0.0);
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other)
      if (places.high[other] - places.low[other] > places.high[axis] - places.low[axis])
        axis = other;
    const auto at = [&](std::size_t i) {
      return particles_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(node.begin),
                     at(node.left().end),
                     at(node.end),
                     [axis](const Particle& a, const Particle& b) {
                       return a.x[axis] != b.x[axis] ? a.x[axis] < b.x[axis]
                                                     : a.index < b.index;
                     });
  }

  void
  build(const Node& node)
  {
    Box& support = supports_[node.number] = Box::empty();
    if (node.isLeaf()) {
      // The order that nth_element leaves within a half is not laid down.
      std::sort(particles_.begin() + static_cast<std::ptrdiff_t>(node.begin),
                particles_.begin() + static_cast<std::ptrdiff_t>(node.end),
                [](const Particle& a, const Particle& b) { return a.index < b.index; });
      for (std::size_t i = node.begin; i < node.end; ++i)
        support.add(particles_[i], 2.0 * particles_[i].h);
      return;
    }
    split(node);
    if (node.end - node.begin > serial_particles) {
      TaskGroup::fork([&] { build(node.left()); }, [&] { build(node.right()); });
    }
    else {
      build(node.left());
      build(node.right());
    }
    support.add(supports_[node.left().number]);
    support.add(supports_[node.right().number]);
  }

  void
  listLeaves(const Node& node)
  {
    if (node.isLeaf()) {
      leaves_.push_back(node);
      return;
    }
    listLeaves(node.left());
    listLeaves(node.right());
  }

  void
  search(const Node& node, const Box& box, std::vector<Node>& reaching) const
  {
    if (!supports_[node.number].meets(box))
      return;
    if (node.isLeaf()) {
      reaching.push_back(node);
      return;
    }
    search(node.left(), box, reaching);
    search(node.right(), box, reaching);
  }

  std::vector<Particle> particles_;
  std::vector<Box> supports_; ///< by node number
  std::vector<Node> leaves_;
};

/** V W of a particle, times pi: h^3 cancels against the kernel's. */
double
weightOf(const Particle& source, const std::array<float, 3>& place)
{
  double sq_dist = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double offset = static_cast<double>(place[axis]) - source.x[axis];
    sq_dist += offset * offset;
  }
  const double h = source.h;
  if (sq_dist >= 4.0 * h * h)
    return 0.0;
  const double q = std::sqrt(sq_dist) / h;
  if (q < 1.0)
    return 1.0 - q * q * (1.5 - 0.75 * q);
  const double rest = std::max(2.0 - q, 0.0);
  return 0.25 * rest * rest * rest;
}

/** The smoothed values of a leaf's particles. */
void
smoothLeaf(const SupportTree& tree,
           const SupportTree::Node& leaf,
           std::vector<SupportTree::Node>& reaching,
           std::vector<float>& smooth)
{
  const auto& particles = tree.getParticles();
  Box places = Box::empty();
  for (std::size_t i = leaf.begin; i < leaf.end; ++i)
    places.add(particles[i], 0.0);
  tree.findReaching(places, reaching);
  for (std::size_t i = leaf.begin; i < leaf.end; ++i) {
    double sum = 0.0, weights = 0.0;
    for (const auto& source : reaching)
      for (std::size_t j = source.begin; j < source.end; ++j) {
        const double weight = weightOf(particles[j], particles[i].x);
        sum += weight * particles[j].value;
        weights += weight;
      }
    smooth[particles[i].index] = static_cast<float>(sum / weights); // own weight is 1
  }
}

void
checkInput(std::size_t points,
           const std::vector<float>& values,
           const std::vector<float>& smoothing_lengths)
{
  if (values.size() != points || smoothing_lengths.size() != points)
    throw InvalidArgument("unfitting_membership",
                          {{"values", values.size()},
                           {"lengths", smoothing_lengths.size()},
                           {"particles", points}});
  const auto bad = std::find_if(values.begin(), values.end(), [](float value) {
    return !(value >= 0.0f && value <= 1.0f);
  });
  if (bad != values.end())
    throw InvalidArgument("membership_out_of_range",
                          {{"value", *bad}, {"particle", bad - values.begin()}});
}

} // namespace

std::vector<float>
membership(const std::vector<std::int32_t>& labels, std::int32_t cluster)
{
  std::vector<float> values(labels.size(), 0.0f);
  for (std::size_t i = 0; i < labels.size(); ++i)
    values[i] = labels[i] == cluster ? 1.0f : 0.0f;
  if (std::find(values.begin(), values.end(), 1.0f) != values.end())
    return values;
  const std::set<std::int32_t> known(labels.begin(), labels.end());
  std::string list;
  std::size_t listed = 0;
  for (auto label = known.begin(); label != known.end() && listed < most_listed;
       ++label, ++listed)
    list += (listed > 0 ? ", " : "") + std::to_string(*label);
  if (known.size() > listed)
    list += " and " + std::to_string(known.size() - listed) + " more";
  throw InvalidArgument(
      "no_such_cluster",
      {{"cluster", cluster}, {"labels", known.empty() ? "none" : list}});
}

std::vector<float>
smoothMembership(const CloudView& cloud,
                 const pcl::Indices& indices,
                 const std::vector<float>& values,
                 const std::vector<float>& smoothing_lengths,
                 unsigned threads,
                 Report& report)
{
  checkInput(indices.size(), values, smoothing_lengths);
  std::vector<Particle> particles;
  particles.reserve(indices.size());
  for (std::uint32_t i = 0; i < indices.size(); ++i) {
    const float* xyz = cloud.xyz(static_cast<std::size_t>(indices[i]));
    const float h = smoothing_lengths[i];
    if (std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]) &&
        std::isfinite(h) && h > 0.0f)
      particles.push_back({{xyz[0], xyz[1], xyz[2]}, h, values[i], i});
  }
  report.count("not_smoothed", indices.size() - particles.size());
  std::vector<float> smooth(values);
  if (particles.empty())
    return smooth;

  StepTimer step(report, "membership", particles.size());
  const SupportTree tree(std::move(particles), threads);
  const auto& leaves = tree.getLeaves();
  parallelBlocks(leaves.size(), block_leaves, threads, [&](auto begin, auto end) {
    std::vector<SupportTree::Node> reaching;
    for (std::size_t leaf = begin; leaf < end; ++leaf)
      smoothLeaf(tree, leaves[leaf], reaching, smooth);
    step.advance(leaves[end - 1].end - leaves[begin].begin);
  });
  return smooth;
}

} // namespace pcl_uvol
