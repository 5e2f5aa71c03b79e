#include "run/frame_depths.h"

namespace clusterbench::run {

std::shared_ptr<const depth::DepthImage> FrameDepths::of(const view::Frame& frame, int threads) {
  const Shot shot{frame.time_s, frame.view_space.origin, frame.view_space.rotation, frame.projection, frame.viewport};
  if (shot_ == shot) return image_;
  shot_.reset();  // until the image is there
  caster_.pose(frame);
  image_ =
      std::make_shared<const depth::DepthImage>(caster_.depths(frame, depth::PixelGrid(frame.viewport, 1), threads));
  shot_ = shot;
  ++images_cast_;
  return image_;
}

depth::LayerImage FrameDepths::layers(const view::Frame& frame, const depth::DepthImage& opaque, int most_layers,
                                      int threads) {
  caster_.pose(frame);
  return caster_.layers(frame, opaque, most_layers, threads);
}

}  // namespace clusterbench::run
