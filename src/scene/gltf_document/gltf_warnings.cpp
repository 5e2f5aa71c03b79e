#include "scene/gltf_document/gltf_warnings.h"

namespace clusterbench::scene {
namespace {

// The text with every number written as '#': "/nodes/12/name" and "/nodes/7/name" have one shape.
std::string shape_of(const std::string& text) {
  std::string shape;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit) {
      shape += c;
    } else if (shape.empty() || shape.back() != '#') {
      shape += '#';
    }
  }
  return shape;
}

}  // namespace

void Warnings::add(const std::string& pointer, const std::string& message) {
  const std::string line = pointer + ": " + message;
  const std::string shape = shape_of(line);
  if (const auto known = known_.find(shape); known != known_.end()) {
    ++kinds_[known->second].count;
  } else if (kinds_.size() < k_most) {
    known_.emplace(shape, kinds_.size());
    kinds_.push_back({line});
  } else {
    ++left_out_;
  }
}

std::vector<std::string> Warnings::lines() const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    const bool alone = kind.count == 1;
    lines.push_back(alone ? kind.first : kind.first + " (and " + std::to_string(kind.count - 1) + " more like it)");
  }
  if (left_out_ > 0) lines.push_back("and " + std::to_string(left_out_) + " more warnings");
  return lines;
}

}  // namespace clusterbench::scene
