#include "measure/samples/sample_tree.h"

#include <algorithm>
#include <numeric>

namespace clusterbench::measure {

SampleTree::SampleTree(std::span<const grid::Sample> samples) : samples_(samples), order_(samples.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!samples.empty()) add_node(0, static_cast<std::uint32_t>(samples.size()));
}

void SampleTree::add_node(std::uint32_t begin, std::uint32_t end) {
  const auto position = [&](std::uint32_t i) -> const Vec3d& { return samples_[order_[i]].from_eye; };
  Node node{position(begin), position(begin), begin, end, 0};
  for (std::uint32_t i = begin; i < end; ++i) {
    node.lo = glm::min(node.lo, position(i));
    node.hi = glm::max(node.hi, position(i));
  }
  const auto index = nodes_.size();
  nodes_.push_back(node);
  if (end - begin <= k_leaf_size) return;

  const Vec3d size = node.hi - node.lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) { return samples_[a].from_eye[axis] < samples_[b].from_eye[axis]; });
  add_node(begin, middle);
  nodes_[index].second = static_cast<std::uint32_t>(nodes_.size());
  add_node(middle, end);
}

}  // namespace clusterbench::measure
