#include "measure/samples/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/memory.h"
#include "core/random.h"

namespace clusterbench::measure {
namespace {

constexpr std::array k_names = {"volume", "opaque", "transparent", "fog", "mirror", "anywhere"};
static_assert(k_names.size() == k_sample_set_count);

constexpr const char* k_fewer_samples = "ask for fewer samples";
constexpr const char* k_larger_blocks = "ask for a larger divisor";
constexpr const char* k_fewer_froxels = "ask for fewer froxels";

// Reserves `count` samples. Throws Error, which names the remedy, beyond the memory limit.
std::vector<grid::Sample> room_for(std::uint64_t count, const char* remedy) {
  check_memory("samples", count, sizeof(grid::Sample), remedy);
  std::vector<grid::Sample> samples;
  samples.reserve(count);
  return samples;
}

// Hashed once more: consecutive seeds of this generator give the same sequence, shifted by one.
SplitMix64 random_of(std::uint64_t seed, const view::Frame& frame) {
  return SplitMix64(SplitMix64(seed + static_cast<std::uint64_t>(frame.index)).next());
}

// Depths from near to far: in a perspective picture uniform in log depth, like slices.
class Depths {
 public:
  Depths(const view::Projection& projection, double far_m)
      : near_m_(projection.near_m), far_m_(far_m), is_logarithmic_(near_m_ > 0.0 && !projection.orthographic) {}

  double at(double share) const {
    return is_logarithmic_ ? near_m_ * std::pow(far_m_ / near_m_, share) : near_m_ + (far_m_ - near_m_) * share;
  }

 private:
  double near_m_, far_m_;
  bool is_logarithmic_;
};

bool is_in_view(const view::Frame& frame, const grid::Sample& sample) {
  const double depth = -static_cast<double>(sample.view.z);
  return depth >= frame.projection.near_m && depth <= frame.projection.far_m && sample.pixel_x >= 0.0f &&
         sample.pixel_x <= static_cast<float>(frame.viewport.x) && sample.pixel_y >= 0.0f &&
         sample.pixel_y <= static_cast<float>(frame.viewport.y);
}

grid::Sample random_point(const view::Frame& frame, const Bounds& bounds, SplitMix64& random) {
  Vec3d at;
  for (int axis = 0; axis < 3; ++axis) at[axis] = random.between(bounds.lo_m[axis], bounds.hi_m[axis]);
  return sample_of(frame, at - frame.view_space.origin);
}

}  // namespace

const char* name_of(SampleSet set) {
  return k_names[static_cast<std::size_t>(set)];
}

std::optional<SampleSet> sample_set_named(const std::string& name) {
  const auto found = std::find(k_names.begin(), k_names.end(), name);
  if (found == k_names.end()) return std::nullopt;
  return static_cast<SampleSet>(found - k_names.begin());
}

grid::Sample sample_at(const view::Frame& frame, double pixel_x, double pixel_y, double depth) {
  const Vec3d local = view::picture_ray(frame, {pixel_x, pixel_y}).at(depth);
  return {static_cast<float>(pixel_x), static_cast<float>(pixel_y), Vec3f(local),
          glm::transpose(frame.view_space.rotation) * local, frame.view_space.origin};
}

grid::Sample sample_of(const view::Frame& frame, const Vec3d& from_eye) {
  const view::Projection& projection = frame.projection;
  const Vec3d local = frame.view_space.rotation * from_eye;
  const double scale = projection.orthographic ? 1.0 : -local.z;
  grid::Sample sample{std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN(), Vec3f(local),
                      from_eye, frame.view_space.origin};
  if (!(scale > 0.0)) return sample;
  const double across = (local.x / scale - projection.left) / (projection.right - projection.left);
  const double down = (projection.top - local.y / scale) / (projection.top - projection.bottom);
  sample.pixel_x = static_cast<float>(across * frame.viewport.x);
  sample.pixel_y = static_cast<float>(down * frame.viewport.y);
  return sample;
}

std::vector<grid::Sample> volume_samples(const view::Frame& frame, double far_m, int count, std::uint64_t seed) {
  SplitMix64 random = random_of(seed, frame);
  const Depths depths(frame.projection, far_m);
  std::vector<grid::Sample> samples = room_for(static_cast<std::uint64_t>(count), k_fewer_samples);
  for (int i = 0; i < count; ++i) {
    const double x = random.between(0.0, frame.viewport.x), y = random.between(0.0, frame.viewport.y);
    samples.push_back(sample_at(frame, x, y, depths.at(random.unit())));
  }
  return samples;
}

std::vector<grid::Sample> opaque_samples(const view::Frame& frame, const depth::DepthImage& image) {
  std::vector<grid::Sample> samples = room_for(static_cast<std::uint64_t>(std::ranges::count_if(
                                                   image.nearest, [](float depth) { return std::isfinite(depth); })),
                                               k_larger_blocks);
  for (std::size_t i = 0; i < image.nearest.size(); ++i) {
    if (!std::isfinite(image.nearest[i])) continue;
    const Vec2d pixel = image.pixels.pixel(i);
    samples.push_back(sample_at(frame, pixel.x, pixel.y, static_cast<double>(image.nearest[i])));
  }
  return samples;
}

depth::DepthImage ground_depths(const view::Frame& frame, const depth::PixelGrid& pixels, double height_m) {
  constexpr double k_farthest_depth_m = 1e9;
  check_memory("depths of pixels", pixels.count(), sizeof(float), k_larger_blocks);
  depth::DepthImage image{pixels, std::vector<float>(pixels.count(), std::numeric_limits<float>::infinity())};
  const Mat3d world_from_view = glm::transpose(frame.view_space.rotation);
  const double far_m = std::min(frame.projection.far_m, k_farthest_depth_m);
  for (std::size_t i = 0; i < pixels.count(); ++i) {
    const view::PictureRay ray = view::picture_ray(frame, pixels.pixel(i));
    const double begins_at = frame.view_space.origin.y + (world_from_view * ray.at(0.0)).y;
    const double climbs = (world_from_view * (ray.at(1.0) - ray.at(0.0))).y;  // per metre of depth
    const double depth_m = (height_m - begins_at) / climbs;
    if (depth_m > 0.0 && depth_m >= frame.projection.near_m && depth_m <= far_m)
      image.nearest[i] = static_cast<float>(depth_m);
  }
  return image;
}

std::vector<grid::Sample> transparent_samples(const view::Frame& frame, const depth::LayerImage& image) {
  std::vector<grid::Sample> samples = room_for(image.depths.size(), k_larger_blocks);
  for (std::size_t i = 0; i + 1 < image.begin.size(); ++i) {
    const Vec2d pixel = image.pixels.pixel(i);
    for (std::uint32_t k = image.begin[i]; k < image.begin[i + 1]; ++k)
      samples.push_back(sample_at(frame, pixel.x, pixel.y, static_cast<double>(image.depths[k])));
  }
  return samples;
}

std::vector<grid::Sample> fog_samples(const view::Frame& frame, double far_m, Vec3i froxels) {
  const Depths depths(frame.projection, far_m);
  std::vector<grid::Sample> samples =
      room_for(static_cast<std::uint64_t>(froxels.x) * static_cast<std::uint64_t>(froxels.y) *
                   static_cast<std::uint64_t>(froxels.z),
               k_fewer_froxels);
  for (int z = 0; z < froxels.z; ++z)
    for (int y = 0; y < froxels.y; ++y)
      for (int x = 0; x < froxels.x; ++x)
        samples.push_back(sample_at(frame, (x + 0.5) * frame.viewport.x / froxels.x,
                                    (y + 0.5) * frame.viewport.y / froxels.y, depths.at((z + 0.5) / froxels.z)));
  return samples;
}

std::vector<grid::Sample> anywhere_samples(const view::Frame& frame, const Bounds& bounds, int count,
                                           std::uint64_t seed) {
  SplitMix64 random = random_of(seed, frame);
  std::vector<grid::Sample> samples = room_for(static_cast<std::uint64_t>(count), k_fewer_samples);
  for (int i = 0; i < count; ++i) samples.push_back(random_point(frame, bounds, random));
  return samples;
}

std::vector<grid::Sample> mirror_samples(const view::Frame& frame, const Bounds& bounds, int count,
                                         std::uint64_t seed) {
  constexpr int k_tries = 16;
  SplitMix64 random = random_of(seed, frame);
  std::vector<grid::Sample> samples = room_for(static_cast<std::uint64_t>(count), k_fewer_samples);
  for (std::int64_t i = 0; i < std::int64_t{k_tries} * count && samples.size() < static_cast<std::size_t>(count); ++i) {
    const grid::Sample sample = random_point(frame, bounds, random);
    if (!is_in_view(frame, sample)) samples.push_back(sample);
  }
  return samples;
}

}  // namespace clusterbench::measure
