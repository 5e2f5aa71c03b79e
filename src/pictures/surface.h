#pragma once
// The points at which the pixels of a picture are shaded: on visible surfaces, or on a plane in front of the camera.

#include <optional>
#include <vector>

#include "assign/contract/lists.h"
#include "depth/depth_image.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::pictures {

// The remedy where a picture takes too much memory.
inline constexpr const char* k_smaller_picture = "ask for a larger --image-divisor";

struct Surface {
  depth::DepthImage image;
  std::vector<grid::Sample> samples;  // of the pixels with a surface, in their order
  std::vector<std::uint32_t> pixel_of_sample;
  std::optional<double> plane_m;  // set if all pixels are at one depth
};

// The same samples as those of the set `opaque` with this image.
Surface visible_surface(const view::Frame& frame, depth::DepthImage image);
Surface plane(const view::Frame& frame, const depth::PixelGrid& pixels, double depth_m);

// A depth that cuts through many lights: the median of those whose centre is in the picture, to a centimetre. Between
// the near plane and far_m.
double depth_amid_lights(const view::Frame& frame, double far_m);

// The size of square pixels, in pixels of the viewport, at which neither side of the picture is longer than `longest`.
int divisor_for(Vec2i viewport, int longest);

// How much light of a lamp at the eye and of the sky a surface reflects, 0 to 1, per pixel: makes shapes recognisable.
std::vector<float> relief(const view::Frame& frame, const Surface& surface);

// The lights that reach the samples, by the samples' own measure (measure::lights_reaching), part by part.
class NeededAt {
 public:
  static constexpr std::size_t k_part = 16384;  // samples

  // Throws Error if they do not fit into the limit on memory.
  NeededAt(const view::Frame& frame, const Surface& surface, int threads);

  std::size_t parts() const { return parts_.size(); }
  const assign::Lists& part(std::size_t index) const { return parts_[index]; }
  std::uint64_t total() const { return total_; }

 private:
  std::vector<assign::Lists> parts_;
  std::uint64_t total_ = 0;
};

}  // namespace clusterbench::pictures
