#pragma once
// Sets of points where a frame is shaded; each tests a method in another way.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "depth/depth_image.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::measure {

enum class SampleSet : std::uint8_t {
  volume,       // seeded points in the whole view, independent of surfaces
  opaque,       // visible surfaces
  transparent,  // transparent surfaces in front of them
  fog,          // the middles of a volumetric grid's froxels
  mirror,       // seeded points outside of the view, as mirrors and probes shade them
  anywhere      // seeded points in the lights' bounds
};
inline constexpr std::size_t k_sample_set_count = 6;
const char* name_of(SampleSet set);
std::optional<SampleSet> sample_set_named(const std::string& name);

// An axis-aligned box in world space.
struct Bounds {
  Vec3d lo_m{0.0}, hi_m{0.0};
};

// The point on a pixel's ray at a depth. Pixels are counted from the top left.
grid::Sample sample_at(const view::Frame& frame, double pixel_x, double pixel_y, double depth);
// `from_eye`: along the world's axes. A point behind a perspective eye has no pixel: NaN.
grid::Sample sample_of(const view::Frame& frame, const Vec3d& from_eye);

// Pixels uniform; depths from near to far_m uniform in log (orthographic: uniform).
std::vector<grid::Sample> volume_samples(const view::Frame& frame, double far_m, int count, std::uint64_t seed);
std::vector<grid::Sample> opaque_samples(const view::Frame& frame, const depth::DepthImage& image);
// The depths of a horizontal plane at a height of the world's y, in front of the eye, between near and far plane and up
// to 1e9 m; +inf for a pixel that does not see it.
depth::DepthImage ground_depths(const view::Frame& frame, const depth::PixelGrid& pixels, double height_m);
std::vector<grid::Sample> transparent_samples(const view::Frame& frame, const depth::LayerImage& image);
// The centres of froxels, spaced like the points of volume_samples().
std::vector<grid::Sample> fog_samples(const view::Frame& frame, double far_m, Vec3i froxels);
std::vector<grid::Sample> anywhere_samples(const view::Frame& frame, const Bounds& bounds, int count,
                                           std::uint64_t seed);
// Returns fewer than `count` if nearly all of the bounds are in view.
std::vector<grid::Sample> mirror_samples(const view::Frame& frame, const Bounds& bounds, int count, std::uint64_t seed);

}  // namespace clusterbench::measure
