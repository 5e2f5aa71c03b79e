#include "cull/visible_sets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/clock.h"
#include "core/memory.h"
#include "core/random.h"
#include "grid/lights_in_view.h"

namespace clusterbench::cull {
namespace {

constexpr std::uint64_t k_word_bits = 64;

// A separate source for each view cell, so that none depends on the path's other view cells.
SplitMix64 random_of(const VoxelIndex& view_cell, std::uint64_t seed) {
  std::uint64_t state = seed;
  for (const std::int64_t index : view_cell) state = SplitMix64(state ^ static_cast<std::uint64_t>(index)).next();
  return SplitMix64(state);
}

// The surfaces around this eye, at the path's beginning.
view::Frame pose_at(const Vec3d& eye, double time_s) {
  view::Frame frame;
  frame.time_s = time_s;
  frame.view_space.origin = eye;
  frame.projection.near_m = 1.0;
  return frame;
}

// Direction number i of n: equal steps in height, turned by the golden ratio from one to the next.
Vec3d fibonacci_direction(int i, int n, double turn) {
  const double z = 1.0 - (2.0 * i + 1.0) / n, across = std::sqrt(1.0 - z * z);
  const double turns = i * (std::numbers::phi - 1.0) + turn;
  const double angle = 2.0 * std::numbers::pi * (turns - std::floor(turns));
  return {across * std::cos(angle), across * std::sin(angle), z};
}

bool is_alike(const scene::WorldLight& a, const scene::WorldLight& b) {
  return a.position == b.position && a.range_m == b.range_m && a.direction == b.direction &&
         a.outer_cone_rad == b.outer_cone_rad;
}

bool touches(const Voxels& voxels, const scene::WorldLight& light) {
  if (!(light.range_m > 0.0)) return false;
  if (!std::isfinite(light.range_m)) return true;
  const grid::WorldBall ball = grid::ball_around(light);
  return voxels.are_touched_by(ball.center, ball.radius_m);
}

}  // namespace

std::vector<depth::WorldRay> view_rays(const VoxelIndex& view_cell, std::span<const Vec3d> eyes,
                                       const VisibleSetStep& step, const depth::RayCaster& caster, std::uint64_t seed,
                                       int threads) {
  SplitMix64 random = random_of(view_cell, seed);
  const double turn = random.unit();
  const Vec3d corner(step.view_cell_m * static_cast<double>(view_cell[0]),
                     step.view_cell_m * static_cast<double>(view_cell[1]),
                     step.view_cell_m * static_cast<double>(view_cell[2]));
  // From an eye to a point of the view cell; a surface between them shortens the ray, and the sampled ray begins
  // somewhere on the remaining part.
  std::vector<depth::WorldRay> to_points;
  std::vector<double> shares;
  for (int i = 0; i < step.rays; ++i) {
    const Vec3d& eye = eyes[static_cast<std::size_t>(i) % eyes.size()];
    const double x = random.unit(), y = random.unit(), z = random.unit();
    const Vec3d way = corner + step.view_cell_m * Vec3d(x, y, z) - eye;
    const double length = glm::length(way);
    to_points.push_back({eye, length > 0.0 ? way / length : Vec3d(0.0, 0.0, -1.0), length});
    shares.push_back(random.unit());
  }
  const std::vector<double> free = caster.free_ways(to_points, threads);
  std::vector<depth::WorldRay> rays;
  for (int i = 0; i < step.rays; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const depth::WorldRay& way = to_points[at];
    const double length = free[at] < way.most_m ? shares[at] * free[at] : way.most_m;
    rays.push_back({way.from + length * way.along, fibonacci_direction(i, step.rays, turn),
                    std::numeric_limits<double>::infinity()});
  }
  const std::vector<double> ways = caster.free_ways(rays, threads);
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].most_m = ways[i];
  return rays;
}

VisibleSets::VisibleSets(const scene::Scene& scene, const scene::Geometry& geometry, const scene::CameraPath& path,
                         const VisibleSetStep& step, std::uint64_t seed, int threads)
    : step_(step) {
  const double start = wall_ns();
  find_moving(scene, path);
  std::map<VoxelIndex, std::vector<Vec3d>> eyes;
  for (const scene::Shot& shot : path.shots) eyes[voxel_of(shot.pose.eye, step.view_cell_m)].push_back(shot.pose.eye);
  depth::RayCaster caster(scene, geometry);
  const Voxels empty(lo_, hi_, step.voxel_m);
  if (any_moves_)
    check_memory("bytes of visible sets for lights that move", empty.bytes(), eyes.size(),
                 "use larger view cells or voxels (pre_cull: visible_set)");
  for (const auto& [index, in_cell] : eyes) {
    caster.pose(pose_at(in_cell.front(), path.shots.front().time_s));
    cells_[index] = view_cell_of(empty, view_rays(index, in_cell, step, caster, seed, threads));
  }
  build_ns_ = wall_ns() - start;
}

void VisibleSets::find_moving(const scene::Scene& scene, const scene::CameraPath& path) {
  bool is_first = true;
  for (const scene::Shot& shot : path.shots) {
    const std::vector<scene::WorldLight> now = scene::world_lights(scene, shot.time_s);
    if (lights_.empty()) {
      lights_ = now;
      moves_.assign(now.size(), false);
    }
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (!is_alike(now[i], lights_[i])) moves_[i] = any_moves_ = true;
      if (!std::isfinite(now[i].range_m) || !(now[i].range_m > 0.0)) continue;
      const grid::WorldBall ball = grid::ball_around(now[i]);
      lo_ = is_first ? ball.center - ball.radius_m : glm::min(lo_, ball.center - ball.radius_m);
      hi_ = is_first ? ball.center + ball.radius_m : glm::max(hi_, ball.center + ball.radius_m);
      is_first = false;
    }
  }
}

VisibleSets::ViewCell VisibleSets::view_cell_of(const Voxels& empty, std::span<const depth::WorldRay> rays) const {
  ViewCell cell{std::vector<std::uint64_t>((lights_.size() + k_word_bits - 1) / k_word_bits, 0), empty};
  for (const depth::WorldRay& ray : rays) cell.voxels.mark_way(ray.from, ray.along, ray.most_m);
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (!moves_[i] && touches(cell.voxels, lights_[i]))
      cell.lights[i / k_word_bits] |= std::uint64_t{1} << i % k_word_bits;
  if (!any_moves_) cell.voxels = {};
  return cell;
}

const VisibleSets::ViewCell* VisibleSets::at(const Vec3d& eye) const {
  const auto found = cells_.find(voxel_of(eye, step_.view_cell_m));
  return found == cells_.end() ? nullptr : &found->second;
}

bool VisibleSets::keeps(const ViewCell& cell, std::uint32_t index, const scene::WorldLight& light) const {
  if (moves_[index]) return touches(cell.voxels, light);
  return (cell.lights[index / k_word_bits] >> index % k_word_bits & 1) != 0;
}

std::uint64_t VisibleSets::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& [index, cell] : cells_) sum += cell.lights.size() * sizeof(std::uint64_t) + cell.voxels.bytes();
  return sum;
}

}  // namespace clusterbench::cull
