#include "run/findings/light_shadows.h"

#include <algorithm>

#include "core/clock.h"
#include "core/memory.h"
#include "core/parallel.h"

namespace clusterbench::run {
namespace {

// A point in the middle of all lights that does not depend on any frame.
Vec3d middle_of(const measure::Bounds& bounds) {
  return glm::round(0.5 * (bounds.lo_m + bounds.hi_m));
}

}  // namespace

LightShadows::LightShadows(const config::Config& config, const SceneData& data, const PathFrames& path)
    : config_(config),
      caster_(data.scene, *data.geometry),
      origin_(middle_of(path.light_bounds())),
      kept_(config.shadow_culls.size()) {}

bool LightShadows::Seen::is_same(const Seen& other) const {
  return surfaces == other.surfaces && light.position == other.light.position && light.range_m == other.light.range_m &&
         light.direction == other.light.direction && light.outer_cone_rad == other.light.outer_cone_rad;
}

void LightShadows::start(const view::Frame& frame) {
  caster_.pose(frame.time_s, origin_);
  frame_ = &frame;
  for (Kept& kept : kept_) kept.of_lights.resize(frame.lights.size());
}

// Bytes of the cached maps of all lights and requests.
std::uint64_t LightShadows::kept_bytes() const {
  std::uint64_t bytes = 0;
  for (const Kept& kept : kept_)
    for (const Made& made : kept.of_lights) bytes += made.map ? made.map->bytes() : 0;
  return bytes;
}

std::vector<const depth::ShadowMap*> LightShadows::maps(std::size_t request, const assign::Lists& lists) {
  std::vector<bool> wanted(frame_->lights.size(), false);
  for (const std::uint32_t light : lists.lights) wanted[light] = true;
  Kept& kept = kept_[request];
  std::vector<std::uint32_t> missing;
  for (std::uint32_t light = 0; light < wanted.size(); ++light)
    if (wanted[light] && !(kept.of_lights[light].map && kept.of_lights[light].seen.is_same(seen(light))))
      missing.push_back(light);
  check_memory("bytes of shadow maps",
               kept_bytes() + missing.size() * depth::ShadowMap::most_bytes(config_.shadow_culls[request].map()), 1,
               "ask for a lower resolution (shadow_cull), or for fewer of them");
  parallel_ranges(missing.size(), config_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Made& made = kept.of_lights[missing[i]];
      made.seen = seen(missing[i]);
      const double cast_start = wall_ns();
      made.map = std::make_unique<depth::ShadowMap>(caster_, made.seen.light, config_.shadow_culls[request].map());
      made.cast_ns = wall_ns() - cast_start;
      const double reduce_start = wall_ns();
      made.map->reduce();
      made.reduce_ns = wall_ns() - reduce_start;
    }
  });
  std::vector<const depth::ShadowMap*> out(wanted.size(), nullptr);
  for (const std::uint32_t light : missing) {
    ++kept.times.maps;
    kept.times.cast_ns += kept.of_lights[light].cast_ns;
    kept.times.reduce_ns += kept.of_lights[light].reduce_ns;
  }
  for (std::uint32_t light = 0; light < wanted.size(); ++light)
    if (wanted[light]) out[light] = kept.of_lights[light].map.get();
  return out;
}

std::vector<std::vector<bool>> LightShadows::lit(std::span<const grid::Sample> samples,
                                                 const measure::NeededLights& needed) const {
  std::vector<std::vector<bool>> out;
  for (const config::ShadowCullRequest& request : config_.shadow_culls) {
    const auto same = std::ranges::find_if(config_.shadow_culls, [&](const config::ShadowCullRequest& other) {
      return other.near_m == request.near_m && other.bias_m == request.bias_m;
    });
    const auto first = static_cast<std::size_t>(same - config_.shadow_culls.begin());
    if (first < out.size())
      out.push_back(out[first]);
    else
      out.push_back(lit(request.near_m, request.bias_m, samples, needed));
  }
  return out;
}

std::vector<bool> LightShadows::lit(double near_m, double bias_m, std::span<const grid::Sample> samples,
                                    const measure::NeededLights& needed) const {
  std::vector<char> found(needed.lists.lights.size(), 0);  // char: bits of a vector<bool> share bytes
  parallel_ranges(samples.size(), config_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::uint32_t k = needed.lists.begin[i]; k < needed.lists.begin[i + 1]; ++k) {
        const scene::WorldLight& light = frame_->lights[needed.lists.lights[k]];
        const Vec3d way = samples[i].from_eye - (light.position - samples[i].eye);
        const double distance = glm::length(way), end_m = distance - bias_m;
        const bool is_lit = end_m <= near_m || !caster_.is_blocked(light.position, way / distance, near_m, end_m);
        found[k] = is_lit ? 1 : 0;
      }
  });
  return {found.begin(), found.end()};
}

void ShadowCullMeter::add(LightShadows& shadows, const view::Frame& frame, const grid::Grid& grid,
                          const assign::Lists& lists, const assign::Lists* truth) {
  const std::vector<const depth::ShadowMap*> maps = shadows.maps(index_, lists);
  count_maps(shadows, maps);
  const double start = wall_ns();
  measure::remove_shadowed(frame, grid, lists, maps, result_.request.bias_m, kept_);
  const double ns = wall_ns() - start;
  step_ns_ += ns;
  result_.times.step_max_ns = std::max(result_.times.step_max_ns, ns);
  ++frames_;
  measure::add_pairs(result_.counts, lists, kept_, truth);
  result_.has_truth = truth != nullptr;
  lists_ = &lists;
}

void ShadowCullMeter::count_maps(const LightShadows& shadows, const std::vector<const depth::ShadowMap*>& maps) {
  seen_.resize(maps.size());
  bytes_.resize(maps.size(), 0);
  for (std::uint32_t light = 0; light < maps.size(); ++light) {
    if (maps[light] == nullptr) continue;
    const LightShadows::Seen now = shadows.seen(light);
    if (seen_[light] && seen_[light]->is_same(now)) continue;
    if (!seen_[light]) ++result_.maps.lights;
    seen_[light] = now;
    ++result_.maps.made;
    result_.maps.faces += maps[light]->face_count();
    const depth::ShadowMap::TexelCounts texels = maps[light]->texel_counts();
    result_.maps.texels += texels.texels;
    result_.maps.unlimited += texels.unlimited;
    bytes_[light] = maps[light]->bytes();
  }
}

void ShadowCullMeter::add_samples(const grid::Grid& grid, std::span<const grid::Sample> samples,
                                  const measure::NeededLights& needed, const std::vector<bool>& is_lit) {
  result_.has_samples = true;
  measure::add_samples(result_.counts, grid, samples, needed, is_lit, *lists_, kept_);
}

ShadowCullResult ShadowCullMeter::result(const LightShadows& shadows) const {
  ShadowCullResult out = result_;
  for (const std::size_t bytes : bytes_) out.maps.bytes += bytes;
  const LightShadows::MakingTimes& making = shadows.making(index_);
  if (making.maps > 0) {
    out.times.cast_ns = making.cast_ns / static_cast<double>(making.maps);
    out.times.reduce_ns = making.reduce_ns / static_cast<double>(making.maps);
  }
  if (frames_ > 0) out.times.step_mean_ns = step_ns_ / frames_;
  return out;
}

}  // namespace clusterbench::run
