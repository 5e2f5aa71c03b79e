#pragma once
// A frame's samples in a tree of boxes, so that a light finds those in its reach without looking at all of them.

#include <cstdint>
#include <span>
#include <vector>

#include "grid/grid.h"

namespace clusterbench::measure {

class SampleTree {
 public:
  explicit SampleTree(std::span<const grid::Sample> samples);

  // Calls take(sample) for every sample within radius of a point (from the eye, along the world's axes), and for some
  // beyond, each once.
  template <class Take>
  void each_near(const Vec3d& point, double radius, Take&& take) const {
    if (!nodes_.empty()) visit(0, point, radius * (1.0 + k_slack), take);
  }

 private:
  static constexpr double k_slack = 1e-9;  // far more than any rounding of distances
  static constexpr std::uint32_t k_leaf_size = 8;

  // Samples order_[begin] .. order_[end - 1] and the box around them. An inner node's first half follows it at once;
  // its second half is at `second`, which is 0 in a leaf.
  struct Node {
    Vec3d lo, hi;
    std::uint32_t begin, end, second;
  };

  void add_node(std::uint32_t begin, std::uint32_t end);

  template <class Take>
  void visit(std::uint32_t index, const Vec3d& point, double radius, Take& take) const {
    const Node& node = nodes_[index];
    const Vec3d gap = glm::max(Vec3d(0.0), glm::max(node.lo - point, point - node.hi));
    if (glm::dot(gap, gap) > radius * radius) return;
    if (node.second != 0) {
      visit(index + 1, point, radius, take);
      visit(node.second, point, radius, take);
      return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) take(order_[i]);
  }

  std::span<const grid::Sample> samples_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace clusterbench::measure
