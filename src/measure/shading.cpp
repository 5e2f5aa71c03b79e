#include "measure/shading.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "measure/sample_tree.h"

namespace clusterbench::measure {
namespace {

// From a light to a sample, by their positions seen from the eye: those in the world may be rounded to metres.
Vec3d way_to(const grid::Sample& sample, const scene::WorldLight& light) {
  return sample.from_eye - (light.position - sample.eye);
}

bool reaches(const scene::WorldLight& light, const Vec3d& to_place) {
  const double distance = glm::length(to_place);
  if (light.range_m == 0.0 || distance > light.range_m) return false;
  if (light.type != scene::LightType::spot) return true;
  // By both parts of the way, along and across: the cosine of a cone below 1e-8 rad is that of 0.
  const double along = glm::dot(to_place, light.direction), across = glm::length(glm::cross(to_place, light.direction));
  return along >= 0.0 && std::cos(light.outer_cone_rad) * across <= std::sin(light.outer_cone_rad) * along;
}

// A spot's share of its intensity in a direction, as KHR_lights_punctual recommends it: 1 within the inner cone, 0 from
// the outer one on. In between it falls with the square of the cosine's share, over no less than a thousandth.
double spot_falloff(const scene::WorldLight& spot, double cos_to_place) {
  constexpr double k_least_span = 0.001;
  const double cos_outer = std::cos(spot.outer_cone_rad);
  const double span = std::max(k_least_span, std::cos(spot.inner_cone_rad) - cos_outer);
  const double share = std::clamp((cos_to_place - cos_outer) / span, 0.0, 1.0);
  return share * share;
}

// What a surface that faces the light gets of it: inverse square with the extension's window, 1 - (d/r)^4.
double irradiance_lux(const scene::WorldLight& light, const Vec3d& to_place) {
  constexpr double k_smallest_square = 1e-4;  // 1 cm: a sample within the lamp. The window has no such limit.
  const double square = glm::dot(to_place, to_place), share = square / (light.range_m * light.range_m);
  const double window = std::clamp(1.0 - share * share, 0.0, 1.0);
  const double lux = light.luminous_intensity_cd * window / std::max(square, k_smallest_square);
  // At the apex there is no direction: as along the axis.
  if (light.type != scene::LightType::spot || square == 0.0) return lux;
  return lux * spot_falloff(light, glm::dot(to_place, light.direction) / std::sqrt(square));
}

}  // namespace

grid::Sample sample_at(const view::Frame& frame, double pixel_x, double pixel_y, double depth) {
  const view::Projection& projection = frame.projection;
  const double across = projection.left + (projection.right - projection.left) * pixel_x / frame.viewport.x;
  const double up = projection.top - (projection.top - projection.bottom) * pixel_y / frame.viewport.y;
  const double scale = projection.orthographic ? 1.0 : depth;
  const Vec3d local{across * scale, up * scale, -depth};
  return {static_cast<float>(pixel_x), static_cast<float>(pixel_y), Vec3f(local),
          glm::transpose(frame.view_space.rotation) * local, frame.view_space.origin};
}

double ShadingCounts::overshade() const {
  if (needed == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(evaluated) / static_cast<double>(needed);
}

double ShadingCounts::comparable_overshade() const {
  if (needed < k_least_needed || unlit() > k_most_unlit) return std::numeric_limits<double>::quiet_NaN();
  return overshade();
}

double ShadingCounts::unlit() const {
  if (needed == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(missed) / static_cast<double>(needed);
}

std::vector<grid::Sample> volume_samples(const view::Frame& frame, double far_m, int count, std::uint64_t seed) {
  // Mixed once more: neighbouring states of this generator give the same numbers one step apart.
  SplitMix64 random(SplitMix64(seed + static_cast<std::uint64_t>(frame.index)).next());
  // Perspective: uniform in log depth, as slices are; orthographic: uniform.
  const double near_m = frame.projection.near_m;
  const bool logarithmic = near_m > 0.0 && !frame.projection.orthographic;
  std::vector<grid::Sample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double x = random.between(0.0, frame.viewport.x), y = random.between(0.0, frame.viewport.y);
    const double share = random.unit();
    const double depth = logarithmic ? near_m * std::pow(far_m / near_m, share) : near_m + (far_m - near_m) * share;
    samples.push_back(sample_at(frame, x, y, depth));
  }
  return samples;
}

assign::Lists lights_reaching(const view::Frame& frame, std::span<const grid::Sample> samples) {
  const SampleTree tree(samples);
  assign::PairBuffer pairs;
  pairs.start(static_cast<std::uint32_t>(samples.size()));
  for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
    const scene::WorldLight& light = frame.lights[index];
    tree.each_near(light.position - frame.view_space.origin, light.range_m, [&](std::uint32_t sample) {
      if (reaches(light, way_to(samples[sample], light))) pairs.add(sample, index);
    });
  }
  assign::Lists lists;
  pairs.finish(lists);
  return lists;
}

void add_frame(ShadingCounts& counts, const view::Frame& frame, std::span<const grid::Sample> samples,
               const assign::Lists& reaching, const assign::LightStructure& structure,
               const std::vector<bool>& is_outside) {
  std::vector<std::uint32_t> given;
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    structure.lights_at(samples[i], grid::Log2::rounded, given);
    std::sort(given.begin(), given.end());
    counts.evaluated += given.size();
    for (const std::uint32_t light : reaching.of(i)) {
      const double carried_lux = irradiance_lux(frame.lights[light], way_to(samples[i], frame.lights[light]));
      ++counts.needed;
      counts.total_lux += carried_lux;
      if (std::binary_search(given.begin(), given.end(), light)) continue;
      ++counts.missed;
      if (!is_outside.empty() && is_outside[i]) ++counts.missed_outside;
      counts.lost_lux += carried_lux;
    }
  }
  counts.samples += samples.size();
  counts.lost_irradiance = counts.total_lux > 0.0 ? counts.lost_lux / counts.total_lux : 0.0;
}

}  // namespace clusterbench::measure
