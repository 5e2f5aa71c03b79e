#include "measure/samples/shading.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "geom/box/box_decider.h"
#include "geom/box/quick_box.h"
#include "measure/samples/sample_tree.h"
#include "measure/truth/light_reaches_point.h"

namespace clusterbench::measure {
namespace {

// From a light to a sample, relative to the eye: world positions may be rounded to metres.
Vec3d way_to(const grid::Sample& sample, const scene::WorldLight& light) {
  return sample.from_eye - (light.position - sample.eye);
}

// A spot's falloff in a direction, as KHR_lights_punctual recommends: 1 within the inner cone, 0 outside of the outer
// one, and in between the square of a ramp in the cosine. The ramp is at least a thousandth wide: if the cones differ
// by less, no direction has full intensity.
double spot_falloff(const scene::WorldLight& spot, double cos_to_sample) {
  constexpr double k_least_span = 0.001;
  const double cos_outer = std::cos(spot.outer_cone_rad);
  const double span = std::max(k_least_span, std::cos(spot.inner_cone_rad) - cos_outer);
  const double share = std::clamp((cos_to_sample - cos_outer) / span, 0.0, 1.0);
  return share * share;
}

// Illuminance of a surface that faces the light: inverse square with the extension's window, 1 - (d/r)^4.
double irradiance_lux(const scene::WorldLight& light, const Vec3d& to_sample) {
  constexpr double k_smallest_square = 1e-4;  // 1 cm: closer samples are within the lamp. The window has no such limit.
  if (light.type == scene::LightType::box) return 0.0;
  const double square = glm::dot(to_sample, to_sample), share = square / (light.range_m * light.range_m);
  const double window = std::clamp(1.0 - share * share, 0.0, 1.0);
  const double lux = light.luminous_intensity_cd * window / std::max(square, k_smallest_square);
  // At the apex there is no direction: full intensity.
  if (light.type != scene::LightType::spot || square == 0.0) return lux;
  return lux * spot_falloff(light, glm::dot(to_sample, light.direction) / std::sqrt(square));
}

// A box around the eye, along the world's axes, that contains the samples exactly.
class BoxOfSamples {
 public:
  BoxOfSamples(const scene::WorldLight& light, const Vec3d& eye)
      : volume_(std::get<geom::BoxVolume>(view::volume_of(light, view::Space{eye, Mat3d(1.0)}))),
        quick_(volume_, light.position - eye),
        decider_(volume_) {}

  bool holds(const Vec3d& from_eye) const {
    if (quick_.surely_misses(from_eye, 0.0)) return false;
    return quick_.surely_holds(from_eye) || decider_.holds(from_eye);
  }

 private:
  geom::BoxVolume volume_;
  geom::QuickBox quick_;
  geom::BoxDecider decider_;
};

}  // namespace

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

double ShadingCounts::unlit_inside() const {
  return needed > 0 ? static_cast<double>(missed - missed_outside) / static_cast<double>(needed)
                    : std::numeric_limits<double>::quiet_NaN();
}

assign::Lists lights_reaching(const view::Frame& frame, std::span<const grid::Sample> samples) {
  const SampleTree tree(samples);
  assign::PairBuffer pairs;
  pairs.start(static_cast<std::uint32_t>(samples.size()));
  for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
    const scene::WorldLight& light = frame.lights[index];
    std::optional<BoxOfSamples> box;
    if (light.type == scene::LightType::box && light.range_m > 0.0) box.emplace(light, frame.view_space.origin);
    tree.each_near(light.position - frame.view_space.origin, light.range_m, [&](std::uint32_t sample) {
      if (box ? box->holds(samples[sample].from_eye) : reaches(light, way_to(samples[sample], light)))
        pairs.add(sample, index);
    });
  }
  assign::Lists lists;
  pairs.finish(lists);
  return lists;
}

NeededLights needed_lights(const view::Frame& frame, std::span<const grid::Sample> samples) {
  NeededLights needed{lights_reaching(frame, samples), {}};
  needed.lux.reserve(needed.lists.lights.size());
  for (std::uint32_t i = 0; i < samples.size(); ++i)
    for (const std::uint32_t light : needed.lists.of(i))
      needed.lux.push_back(irradiance_lux(frame.lights[light], way_to(samples[i], frame.lights[light])));
  return needed;
}

void add_samples(ShadingCounts& counts, int frame, std::span<const grid::Sample> samples, const NeededLights& needed,
                 const assign::LightStructure& structure) {
  std::vector<std::uint32_t> given;
  const ShadingCounts before = counts;
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    const bool is_answered = structure.lights_at(samples[i], grid::Log2::rounded, given);
    if (!std::is_sorted(given.begin(), given.end())) std::sort(given.begin(), given.end());
    counts.evaluated += given.size();
    counts.reads += structure.reads_at(samples[i], grid::Log2::rounded);
    counts.unanswered += is_answered ? 0 : 1;
    double lost_lux = 0.0;
    auto from = given.cbegin();  // both lists ascend
    for (std::uint32_t k = needed.lists.begin[i]; k < needed.lists.begin[i + 1]; ++k) {
      ++counts.needed;
      counts.total_lux += needed.lux[k];
      while (from != given.cend() && *from < needed.lists.lights[k]) ++from;
      if (from != given.cend() && *from == needed.lists.lights[k]) continue;
      ++counts.missed;
      if (!is_answered) ++counts.missed_outside;
      lost_lux += needed.lux[k];
    }
    counts.lost_lux += lost_lux;
    if (lost_lux > (counts.darkest ? counts.darkest->lost_lux : 0.0))
      counts.darkest = {frame, samples[i].pixel_x, samples[i].pixel_y, lost_lux};
  }
  counts.samples += samples.size();
  ShadingCounts::WorstFrame& now = counts.now;
  if (now.frame != frame) now = {frame};
  now.missed += counts.missed - before.missed;
  now.needed += counts.needed - before.needed;
  if (now.missed > (counts.worst ? counts.worst->missed : 0) || (counts.worst && counts.worst->frame == frame))
    counts.worst = now;
}

double ShadingCounts::lost_irradiance() const {
  return total_lux > 0.0 ? lost_lux / total_lux : 0.0;
}

}  // namespace clusterbench::measure
