#pragma once
// A frame's samples in a tree of boxes, so that the samples within a light's range are found without a test of all.

#include <cstdint>
#include <span>
#include <vector>

#include "grid/grid.h"

namespace clusterbench::measure {

class SampleTree {
 public:
  explicit SampleTree(std::span<const grid::Sample> samples);

  // Calls visitor(sample) once for every sample within `radius` of `point` (from the eye, along the world's axes), and
  // for some beyond.
  template <class Visitor>
  void each_near(const Vec3d& point, double radius, Visitor&& visitor) const {
    if (!nodes_.empty()) visit(0, point, radius * (1.0 + k_slack), visitor);
  }

 private:
  static constexpr double k_slack = 1e-9;  // far more than any rounding of distances
  static constexpr std::uint32_t k_leaf_size = 8;

  // Samples order_[begin] .. order_[end - 1] and the box around them. The first child of an inner node follows it in
  // the array; the second is at `second`, which is 0 for a leaf.
  struct Node {
    Vec3d lo, hi;
    std::uint32_t begin, end, second;
  };

  void add_node(std::uint32_t begin, std::uint32_t end);

  template <class Visitor>
  void visit(std::uint32_t index, const Vec3d& point, double radius, Visitor& visitor) const {
    const Node& node = nodes_[index];
    const Vec3d gap = glm::max(Vec3d(0.0), glm::max(node.lo - point, point - node.hi));
    if (glm::dot(gap, gap) > radius * radius) return;
    if (node.second != 0) {
      visit(index + 1, point, radius, visitor);
      visit(node.second, point, radius, visitor);
      return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) visitor(order_[i]);
  }

  std::span<const grid::Sample> samples_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace clusterbench::measure
