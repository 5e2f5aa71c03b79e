#include "run/cases/frame_depths.h"

#include <algorithm>

namespace clusterbench::run {

std::shared_ptr<const depth::DepthImage> FrameDepths::of(const view::Frame& frame, int threads) {
  return thinned(frame, 1, threads);
}

std::shared_ptr<const depth::DepthImage> FrameDepths::thinned(const view::Frame& frame, int divisor, int threads) {
  Shot shot{frame.time_s, frame.view_space.origin, frame.view_space.rotation, frame.projection, frame.viewport};
  const depth::PixelGrid pixels(frame.viewport, divisor);
  const std::lock_guard one_at_a_time(casting_);
  if (const std::shared_ptr<const depth::DepthImage> all = kept(shot))
    return divisor == 1 ? all : std::make_shared<const depth::DepthImage>(depth::thinned(*all, pixels));
  shot.divisor = divisor;
  if (std::shared_ptr<const depth::DepthImage> image = kept(shot)) return image;
  caster_.pose(frame);
  Kept now{shot, std::make_shared<const depth::DepthImage>(caster_.depths(frame, pixels, threads))};
  ++images_cast_;
  pixels_cast_ += pixels.count();
  // Frames are requested in the same order for grid after grid. So the first images stay cached: if the latest ones
  // replaced them, each image would be gone before its next request.
  std::size_t bytes = now.bytes();
  for (const Kept& kept : kept_) bytes += kept.bytes();
  if (!kept_.empty() && bytes > k_most_kept_bytes) kept_.pop_back();
  kept_.push_back(now);
  return now.image;
}

std::shared_ptr<const depth::DepthImage> FrameDepths::kept(const Shot& shot) const {
  const auto found = std::ranges::find(kept_, shot, &Kept::shot);
  return found == kept_.end() ? nullptr : found->image;
}

depth::LayerImage FrameDepths::layers(const view::Frame& frame, const depth::DepthImage& opaque, int most_layers,
                                      int threads) {
  const std::lock_guard one_at_a_time(casting_);
  caster_.pose(frame);
  return caster_.layers(frame, opaque, most_layers, threads);
}

}  // namespace clusterbench::run
