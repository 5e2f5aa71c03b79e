#include "measure/samples/lookup_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/random.h"
#include "core/single_precision.h"
#include "measure/samples/shading.h"

namespace clusterbench::measure {
namespace {

float moved(float value, int ulps) {
  const float towards = ulps > 0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) value = std::nextafter(value, towards);
  return value;
}

// The depth of the point on a pixel's ray at a distance from the eye.
double depth_at_distance(const view::Frame& frame, double pixel_x, double pixel_y, double distance) {
  const Vec3d ray = sample_at(frame, pixel_x, pixel_y, 1.0).from_eye;
  return distance / glm::length(ray);
}

// A sample at a slice boundary, or a few ulp beside it.
grid::Sample at_boundary(const view::Frame& frame, const grid::ScreenGrid& grid, SplitMix64& random) {
  const std::vector<float>& boundaries = grid.slices.boundaries;
  const double x = random.between(0.0, frame.viewport.x), y = random.between(0.0, frame.viewport.y);
  const float boundary = boundaries[random.below(boundaries.size())];
  constexpr int k_offsets[] = {-16, -4, -2, -1, 0, 1, 2, 4, 16};
  const double along = moved(boundary, k_offsets[random.below(std::size(k_offsets))]);
  const double depth = grid.by_distance ? depth_at_distance(frame, x, y, along) : along;
  return sample_at(frame, x, y, depth);
}

// The centre of a pixel beside a tile edge.
double beside_edge(int tiles, float scale, int pixels, SplitMix64& random) {
  const auto edge =
      static_cast<double>(random.below(static_cast<std::uint64_t>(tiles) + 1)) / static_cast<double>(scale);
  const double pixel = std::floor(edge) - 1.0 + static_cast<double>(random.below(3));
  return std::clamp(pixel, 0.0, pixels - 1.0) + 0.5;
}

// Adds a sample just inside a light, at its nearest or farthest point from the eye; no sample if that point is not in
// view.
void add_at_light_end(const view::Frame& frame, bool by_distance, SplitMix64& random,
                      std::vector<grid::Sample>& samples) {
  if (frame.lights.empty()) return;
  const scene::WorldLight& light = frame.lights[random.below(frame.lights.size())];
  const double side = random.below(2) == 0 ? -1.0 : 1.0;
  if (!std::isfinite(light.range_m)) return;
  const view::Projection& projection = frame.projection;
  const Vec3d center = frame.view_space.rotation * (light.position - frame.view_space.origin);
  const Vec3d away = by_distance && glm::length(center) > 0.0 ? glm::normalize(center) : Vec3d(0.0, 0.0, -1.0);
  const Vec3d point = center + side * (1.0 - 1e-6) * light.range_m * away;
  const double depth = -point.z, scale = projection.orthographic ? 1.0 : depth;
  if (!(depth > projection.near_m && depth < projection.far_m)) return;
  const double pixel_x = (point.x / scale - projection.left) / (projection.right - projection.left) * frame.viewport.x;
  const double pixel_y = (projection.top - point.y / scale) / (projection.top - projection.bottom) * frame.viewport.y;
  if (pixel_x < 0.0 || pixel_y < 0.0 || pixel_x > frame.viewport.x || pixel_y > frame.viewport.y) return;
  samples.push_back(sample_at(frame, pixel_x, pixel_y, depth));
}

grid::Sample read_back(const view::Frame& frame, const grid::Sample& sample, DepthRead read) {
  if (read == DepthRead::given) return sample;
  const Vec3d local = frame.view_space.rotation * sample.from_eye;
  const double depth = read_depth(frame.projection, read, -local.z);
  return sample_at(frame, static_cast<double>(sample.pixel_x), static_cast<double>(sample.pixel_y), depth);
}

bool takes_logarithm(const grid::Grid& grid) {
  return grid.has_tiles() && grid.screen().slices.lookup.form == grid::SliceLookup::Form::log2;
}

// A sample outside of all cells is not an error of the lookup.
bool is_beyond(const view::Frame& frame, const grid::Grid& grid, const grid::Sample& sample) {
  if (!grid.has_tiles()) return grid::lookup(grid, sample) < 0;
  const Vec3d local = frame.view_space.rotation * sample.from_eye;
  return grid.screen().along(local) > static_cast<double>(grid.screen().slices.boundaries.back());
}

// The smallest and the largest result that a logarithm may have.
std::vector<grid::Log2> ends_of(Logarithm logarithm) {
  if (logarithm == Logarithm::glsl) return {grid::Log2::glsl_low, grid::Log2::glsl_high};
  return {logarithm == Logarithm::fast ? grid::Log2::fast : grid::Log2::rounded};
}

}  // namespace

const char* name_of(Logarithm logarithm) {
  constexpr const char* k_names[] = {"rounded", "glsl", "fast"};
  return k_names[static_cast<int>(logarithm)];
}

const char* name_of(DepthRead depth) {
  constexpr const char* k_names[] = {"given", "d32f", "d24"};
  return k_names[static_cast<int>(depth)];
}

double read_depth(const view::Projection& projection, DepthRead read, double depth) {
  if (read == DepthRead::given) return rounded_to_float(depth);
  const double near = projection.near_m, far = projection.far_m, clamped = std::clamp(depth, near, far);
  double stored;
  if (projection.orthographic)
    stored = (far - clamped) / (far - near);
  else
    stored = std::isinf(far) ? near / clamped : near * (far - clamped) / ((far - near) * clamped);
  constexpr double k_d24_steps = (1 << 24) - 1;
  stored = read == DepthRead::d24 ? std::round(stored * k_d24_steps) / k_d24_steps : static_cast<float>(stored);
  if (projection.orthographic) return static_cast<float>(far - stored * (far - near));
  // As in a shader: single precision, constants rounded once. A stored 0 is the far end.
  if (std::isinf(far)) return static_cast<float>(near) / static_cast<float>(stored);
  const auto scale = static_cast<float>((far - near) / (near * far)), bias = static_cast<float>(1.0 / far);
  return 1.0f / (static_cast<float>(stored) * scale + bias);
}

std::vector<grid::Sample> edge_samples(const view::Frame& frame, const grid::Grid& grid, double far_m, int count,
                                       std::uint64_t seed) {
  const bool on_screen = grid.has_tiles(), by_distance = on_screen && grid.screen().by_distance;
  std::vector<grid::Sample> samples = volume_samples(frame, far_m, on_screen ? count / 4 : count * 3 / 4, seed);
  SplitMix64 random(SplitMix64(seed + 77 + static_cast<std::uint64_t>(frame.index)).next());
  const double near = std::max(frame.projection.near_m, 1e-3 * far_m);
  const int in_view = static_cast<int>(samples.size());
  for (int i = 0; i < count / 4; ++i) add_at_light_end(frame, by_distance, random, samples);
  for (int i = 0; on_screen && i < count - 2 * in_view; ++i) {
    if (i % 2 == 0) {
      samples.push_back(at_boundary(frame, grid.screen(), random));
      continue;
    }
    const grid::Tiles& tiles = grid.screen().tiles;
    const double x = beside_edge(tiles.count.x, tiles.scale_x, frame.viewport.x, random);
    const double y = beside_edge(tiles.count.y, tiles.scale_y, frame.viewport.y, random);
    samples.push_back(sample_at(frame, x, y, near * std::pow(far_m / near, random.unit())));
  }
  return samples;
}

LookupFrame::LookupFrame(const view::Frame& frame, const grid::Grid& grid, const std::vector<LookupWay>& ways,
                         double far_m, int samples, std::uint64_t seed) {
  std::vector<grid::Sample> samples_at_edges = edge_samples(frame, grid, far_m, samples, seed);
  std::erase_if(samples_at_edges, [&](const grid::Sample& sample) { return is_beyond(frame, grid, sample); });
  reaching_ = lights_reaching(frame, samples_at_edges);
  for (const LookupWay& way : ways) {
    Way tried{way, {grid::Log2::rounded}, 0, {}};
    if (takes_logarithm(grid)) {
      tried.ends = ends_of(way.logarithm);
      for (const grid::Log2 end : tried.ends)
        tried.padding = std::max(tried.padding, grid::safe_padding_ulps(grid.screen().slices, end));
    }
    for (const grid::Sample& sample : samples_at_edges) tried.samples.push_back(read_back(frame, sample, way.depth));
    ways_.push_back(std::move(tried));
  }
}

void LookupFrame::add(const assign::LightStructure& structure, std::vector<LookupCounts>& counts) const {
  counts.resize(ways_.size());
  for (std::size_t i = 0; i < ways_.size(); ++i) add_way(ways_[i], structure, counts[i]);
}

void LookupFrame::add_way(const Way& way, const assign::LightStructure& structure, LookupCounts& counts) const {
  counts.way = way.way;
  counts.samples += way.samples.size();
  counts.safe_padding_ulps = std::max(counts.safe_padding_ulps, way.padding);
  std::vector<std::uint32_t> given, left, missed;
  for (std::uint32_t i = 0; i < way.samples.size(); ++i) {
    missed.clear();
    for (const grid::Log2 end : way.ends) {
      structure.lights_at(way.samples[i], end, given);
      std::sort(given.begin(), given.end());
      left.clear();
      std::set_difference(reaching_.of(i).begin(), reaching_.of(i).end(), given.begin(), given.end(),
                          std::back_inserter(left));
      missed.insert(missed.end(), left.begin(), left.end());
    }
    // A light missed at both ends counts once.
    std::sort(missed.begin(), missed.end());
    missed.erase(std::unique(missed.begin(), missed.end()), missed.end());
    counts.needed += reaching_.of(i).size();
    counts.missed += missed.size();
    counts.wrong_samples += missed.empty() ? 0 : 1;
  }
}

}  // namespace clusterbench::measure
