#include "search/best_frames.h"

#include <algorithm>

#include "search/search_space.h"

namespace clusterbench::search {

bool BestFrames::are_near(const FrameChoice& a, const FrameChoice& b) const {
  constexpr double k_cosine = 0.86602540378443865;  // of 30 degrees
  const Vec3d apart = a.eye - b.eye;
  return a.moment == b.moment && glm::dot(apart, apart) <= near_m_ * near_m_ &&
         glm::dot(direction_of(a.rotation), direction_of(b.rotation)) > k_cosine;
}

void BestFrames::add(const RatedFrame& frame) {
  if (!can_enter(frame.value)) return;
  const auto is_near = [&](const RatedFrame& other) { return are_near(other.choice, frame.choice); };
  if (std::ranges::any_of(frames_,
                          [&](const RatedFrame& other) { return other.value >= frame.value && is_near(other); }))
    return;
  std::erase_if(frames_, is_near);
  const auto place = std::ranges::find_if(frames_, [&](const auto& other) { return other.value < frame.value; });
  frames_.insert(place, frame);
  if (frames_.size() > most_) frames_.pop_back();
}

void BestFrames::add_all(const BestFrames& others) {
  for (const RatedFrame& frame : others.frames_) add(frame);
}

}  // namespace clusterbench::search
