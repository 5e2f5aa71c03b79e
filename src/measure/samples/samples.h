#pragma once
// Sets of points where a frame is shaded, each of which asks other things of a method.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "depth/depth_image.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::measure {

enum class SampleSet : std::uint8_t {
  volume,       // seeded points in the whole view, whatever is there
  opaque,       // visible surfaces
  transparent,  // surfaces that are seen through, in front of them
  fog,          // the middles of a volumetric grid's froxels
  mirror,       // seeded points outside of the view, as mirrors and probes shade them
  anywhere      // seeded points in the lights' bounds
};
inline constexpr std::size_t k_sample_set_count = 6;
const char* name_of(SampleSet set);
std::optional<SampleSet> sample_set_named(const std::string& name);

// A box in the world.
struct Bounds {
  Vec3d lo_m{0.0}, hi_m{0.0};
};

// The point on a pixel's ray at a depth. Pixels from the top left.
grid::Sample sample_at(const view::Frame& frame, double pixel_x, double pixel_y, double depth);
// A point along the world's axes from the eye. Behind a perspective eye no pixel shows it: NaN.
grid::Sample sample_of(const view::Frame& frame, const Vec3d& from_eye);

// Pixels uniform, depths uniform in log from near to far_m (orthographic: uniform).
std::vector<grid::Sample> volume_samples(const view::Frame& frame, double far_m, int count, std::uint64_t seed);
std::vector<grid::Sample> opaque_samples(const view::Frame& frame, const depth::DepthImage& image);
// The depths of a horizontal plane at a height of the world's y, in front of the eye, between near and far plane and up
// to 1e9 m; +inf where a pixel does not see it.
depth::DepthImage ground_depths(const view::Frame& frame, const depth::PixelGrid& pixels, double height_m);
std::vector<grid::Sample> transparent_samples(const view::Frame& frame, const depth::LayerImage& image);
// Froxels as volume_samples() spreads its points.
std::vector<grid::Sample> fog_samples(const view::Frame& frame, double far_m, Vec3i froxels);
std::vector<grid::Sample> anywhere_samples(const view::Frame& frame, const Bounds& bounds, int count,
                                           std::uint64_t seed);
// Fewer where nearly all of the bounds are in view.
std::vector<grid::Sample> mirror_samples(const view::Frame& frame, const Bounds& bounds, int count, std::uint64_t seed);

}  // namespace clusterbench::measure
