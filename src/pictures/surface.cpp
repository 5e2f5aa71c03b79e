#include "pictures/surface.h"

#include <algorithm>
#include <cmath>

#include "core/memory.h"
#include "core/parallel.h"
#include "measure/samples/samples.h"
#include "measure/samples/shading.h"

namespace clusterbench::pictures {
namespace {

// The step to the neighbour that is more likely on the same surface: the nearer one in depth. Points of pixels without
// a surface are NaN.
Vec3d step_to_neighbour(const std::vector<Vec3d>& points, std::size_t at, std::size_t before, std::size_t after) {
  const Vec3d back = points[at] - points[before], on = points[after] - points[at];
  const bool has_back = before != at && std::isfinite(back.z), has_on = after != at && std::isfinite(on.z);
  if (has_back && has_on) return std::abs(back.z) < std::abs(on.z) ? back : on;
  return has_back ? back : has_on ? on : Vec3d(0.0);
}

std::vector<Vec3d> points_of(const view::Frame& frame, const depth::DepthImage& image) {
  std::vector<Vec3d> points;
  points.reserve(image.nearest.size());
  for (std::size_t i = 0; i < image.nearest.size(); ++i)
    points.push_back(view::picture_ray(frame, image.pixels.pixel(i)).at(static_cast<double>(image.nearest[i])));
  return points;
}

}  // namespace

Surface visible_surface(const view::Frame& frame, depth::DepthImage image) {
  Surface out;
  out.image = std::move(image);
  out.samples = measure::opaque_samples(frame, out.image);
  out.pixel_of_sample.reserve(out.samples.size());
  for (std::size_t i = 0; i < out.image.nearest.size(); ++i)
    if (std::isfinite(out.image.nearest[i])) out.pixel_of_sample.push_back(static_cast<std::uint32_t>(i));
  return out;
}

Surface plane(const view::Frame& frame, const depth::PixelGrid& pixels, double depth_m) {
  check_memory("pixels of a picture", pixels.count(), sizeof(float), k_smaller_picture);
  Surface out = visible_surface(frame, {pixels, std::vector<float>(pixels.count(), static_cast<float>(depth_m))});
  out.plane_m = depth_m;
  return out;
}

double depth_amid_lights(const view::Frame& frame, double far_m) {
  const double near_m = frame.projection.near_m;
  std::vector<double> depths;
  for (const scene::WorldLight& light : frame.lights) {
    const grid::Sample at = measure::sample_of(frame, light.position - frame.view_space.origin);
    const double depth = -static_cast<double>(at.view.z);
    if (light.range_m > 0.0 && depth > near_m && depth < far_m && at.pixel_x >= 0.0f && at.pixel_y >= 0.0f &&
        at.pixel_x <= static_cast<float>(frame.viewport.x) && at.pixel_y <= static_cast<float>(frame.viewport.y))
      depths.push_back(depth);
  }
  double depth = (near_m + far_m) / 2.0;
  if (!depths.empty()) {
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    depth = *middle;
  }
  return std::clamp(std::round(depth * 100.0) / 100.0, near_m, far_m);
}

int divisor_for(Vec2i viewport, int longest) {
  return (std::max(viewport.x, viewport.y) + longest - 1) / longest;
}

std::vector<float> relief(const view::Frame& frame, const Surface& surface) {
  constexpr float k_light_of_plane = 0.6f;
  const depth::DepthImage& image = surface.image;
  if (surface.plane_m) return std::vector<float>(image.nearest.size(), k_light_of_plane);
  check_memory("points of a picture", image.nearest.size(), sizeof(Vec3d), k_smaller_picture);
  const std::vector<Vec3d> points = points_of(frame, image);
  const auto width = static_cast<std::size_t>(image.pixels.size.x), all = image.nearest.size();
  constexpr double k_lamp = 0.65, k_sky = 0.35;
  const Vec3d up = frame.view_space.rotation * Vec3d(0.0, 1.0, 0.0);
  std::vector<float> light(all, 0.0f);
  for (std::size_t i = 0; i < all; ++i) {
    if (!std::isfinite(image.nearest[i])) continue;
    const std::size_t x = i % width;
    const Vec3d across = step_to_neighbour(points, i, x > 0 ? i - 1 : i, x + 1 < width ? i + 1 : i);
    const Vec3d down = step_to_neighbour(points, i, i >= width ? i - width : i, i + width < all ? i + width : i);
    const Vec3d normal = glm::cross(across, down);
    const double size = glm::length(normal);
    if (!(size > 0.0)) continue;
    const Vec3d along = glm::normalize(view::picture_ray(frame, image.pixels.pixel(i)).along);
    light[i] = static_cast<float>(
        (k_lamp * std::abs(glm::dot(normal, along)) + k_sky * std::abs(glm::dot(normal, up))) / size);
  }
  return light;
}

NeededAt::NeededAt(const view::Frame& frame, const Surface& surface, int threads) {
  const std::span<const grid::Sample> samples = surface.samples;
  parts_.resize((samples.size() + k_part - 1) / k_part);
  const std::size_t at_once = 4 * static_cast<std::size_t>(threads);
  for (std::size_t first = 0; first < parts_.size(); first += at_once) {
    const std::size_t count = std::min(at_once, parts_.size() - first);
    parallel_ranges(count, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = first + begin; i < first + end; ++i)
        parts_[i] =
            measure::lights_reaching(frame, samples.subspan(i * k_part, std::min(k_part, samples.size() - i * k_part)));
    });
    for (std::size_t i = first; i < first + count; ++i) total_ += parts_[i].lights.size();
    check_memory("lights that pixels need", total_, sizeof(std::uint32_t), k_smaller_picture);
  }
}

}  // namespace clusterbench::pictures
