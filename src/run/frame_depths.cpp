#include "run/frame_depths.h"

#include <algorithm>

namespace clusterbench::run {

std::shared_ptr<const depth::DepthImage> FrameDepths::of(const view::Frame& frame, int threads) {
  const Shot shot{frame.time_s, frame.view_space.origin, frame.view_space.rotation, frame.projection, frame.viewport};
  const auto found = std::ranges::find(kept_, shot, &Kept::shot);
  if (found != kept_.end()) return found->image;
  caster_.pose(frame);
  Kept now{shot, std::make_shared<const depth::DepthImage>(
                     caster_.depths(frame, depth::PixelGrid(frame.viewport, 1), threads))};
  ++images_cast_;
  // Frames are asked for in the same order grid after grid: the first ones stay, since each would be gone before it is
  // asked for again if the latest ones did.
  std::size_t bytes = now.bytes();
  for (const Kept& kept : kept_) bytes += kept.bytes();
  if (!kept_.empty() && bytes > k_most_kept_bytes) kept_.pop_back();
  kept_.push_back(now);
  return now.image;
}

depth::LayerImage FrameDepths::layers(const view::Frame& frame, const depth::DepthImage& opaque, int most_layers,
                                      int threads) {
  caster_.pose(frame);
  return caster_.layers(frame, opaque, most_layers, threads);
}

}  // namespace clusterbench::run
