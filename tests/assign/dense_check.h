#pragma once
// An independent check of lists that can only find misses: points are drawn in each light's volume in double precision,
// the cell that holds a point is found from the grid's boundaries, and the light must be in its list.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "assign/contract/assigner.h"
#include "assign/contract/assigner_run.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign::testing {

// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }
  double log_between(double lo, double hi) { return lo * std::pow(hi / lo, unit()); }
  Vec3d direction() {
    const double z = between(-1, 1), angle = between(0, 2 * M_PI), beside = std::sqrt(1 - z * z);
    return {beside * std::cos(angle), beside * std::sin(angle), z};
  }

 private:
  std::mt19937_64 engine_;
};

inline scene::WorldLight point_light(Vec3d position, double range) {
  scene::WorldLight light;
  light.type = scene::LightType::point;
  light.position = position;
  light.range_m = range;
  return light;
}

inline scene::WorldLight spot_light(Vec3d position, double range, Vec3d direction, double half_angle) {
  scene::WorldLight light = point_light(position, range);
  light.type = scene::LightType::spot;
  light.direction = glm::normalize(direction);
  light.outer_cone_rad = half_angle;
  return light;
}

inline scene::WorldLight box_light(Vec3d middle, std::array<Vec3d, 3> half_axes) {
  scene::WorldLight light;
  light.type = scene::LightType::box;
  light.position = middle;
  light.half_axes_m = half_axes;
  light.range_m = scene::corner_distance_m(half_axes);
  light.luminous_intensity_cd = 0.0;
  return light;
}

// A frame at the origin looking down -z; points must come before spots.
inline view::Frame frame_of(const view::Projection& projection, Vec2i viewport, std::vector<scene::WorldLight> lights) {
  view::Frame frame;
  frame.viewport = viewport;
  frame.projection = projection;
  frame.points = static_cast<std::uint32_t>(std::count_if(
      lights.begin(), lights.end(), [](const auto& light) { return light.type == scene::LightType::point; }));
  frame.lights = std::move(lights);
  return frame;
}

inline view::Projection perspective(double vertical_fov_rad, double aspect, double near_m, double far_m) {
  const double top = std::tan(vertical_fov_rad / 2);
  return {false, -top * aspect, top * aspect, -top, top, near_m, far_m};
}

// Index of the boundaries' interval that holds a value, -1 outside. Descending boundaries are taken as they are.
inline int interval_of(const std::vector<float>& boundaries, double value) {
  for (std::size_t i = 0; i + 1 < boundaries.size(); ++i) {
    const double a = boundaries[i], b = boundaries[i + 1];
    if (std::min(a, b) <= value && value <= std::max(a, b)) return static_cast<int>(i);
  }
  return -1;
}

inline std::int64_t cell_index(Vec3i cells, int x, int y, int z) {
  if (x < 0 || y < 0 || z < 0) return -1;
  return (static_cast<std::int64_t>(z) * cells.y + y) * cells.x + x;
}

inline std::int64_t screen_cell(const grid::ScreenGrid& screen, Vec3i cells, Vec3d p) {
  const double depth = -p.z;
  const bool by_depth = !screen.by_distance;
  const double divisor = screen.tiles.orthographic ? 1.0 : depth;
  if (divisor <= 0.0) return -1;
  return cell_index(cells, interval_of(screen.tiles.x, p.x / divisor), interval_of(screen.tiles.y, p.y / divisor),
                    interval_of(screen.slices.boundaries, by_depth ? depth : glm::length(p)));
}

inline std::int64_t cascades_cell(const grid::CascadesGrid& cascades, Vec3i cells, Vec3d p) {
  for (int level = 0; level < cascades.levels; ++level) {
    const double edge = static_cast<double>(cascades.finest_m) * std::pow(2.0, level);
    const auto x = static_cast<int>(std::floor(p.x / edge)) + cascades.cells.x / 2;
    const auto y = cascades.cells.y / 2 - 1 - static_cast<int>(std::floor(p.y / edge));
    const auto z = static_cast<int>(std::floor(-p.z / edge));
    if (x < 0 || y < 0 || z < 0 || x >= cascades.cells.x || y >= cascades.cells.y || z >= cascades.cells.z) continue;
    return cell_index(cells, x, y, level * cascades.cells.z + z);
  }
  return -1;
}

// The cell that holds a point of the grid's space, -1 outside.
inline std::int64_t cell_of_point(const grid::Grid& grid, Vec3d p) {
  switch (grid.kind()) {
    case grid::Kind::cascades:
      return cascades_cell(grid.cascades(), grid.cells(), p);
    case grid::Kind::world:
      return cell_index(grid.cells(), interval_of(grid.world().x, p.x), interval_of(grid.world().y, p.y),
                        interval_of(grid.world().z, p.z));
    default:
      return screen_cell(grid.screen(), grid.cells(), p);
  }
}

// A point of the light's volume, half of them on its surface.
inline Vec3d point_in(const scene::WorldLight& light, Random& random) {
  const double reach = std::min(light.range_m, 1e4);
  const double distance = reach * (random.unit() < 0.5 ? 1.0 - 1e-12 : std::cbrt(random.unit()));
  if (light.type == scene::LightType::point) return light.position + distance * random.direction();
  if (light.type == scene::LightType::box) {
    Vec3d at = light.position;
    for (const Vec3d& axis : light.half_axes_m)
      at += (random.unit() < 0.3 ? 1.0 - 1e-12 : random.unit()) * (random.unit() < 0.5 ? -1.0 : 1.0) * axis;
    return at;
  }
  const double angle = light.outer_cone_rad * (random.unit() < 0.5 ? 1.0 : std::sqrt(random.unit()));
  const Vec3d axis = light.direction;
  const Vec3d helper = std::fabs(axis.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d u = glm::normalize(glm::cross(axis, helper)), v = glm::cross(axis, u);
  const double turn = random.between(0, 2 * M_PI);
  return light.position +
         distance * (std::cos(angle) * axis + std::sin(angle) * (std::cos(turn) * u + std::sin(turn) * v));
}

inline bool lists_light(const Lists& lists, std::int64_t cell, std::uint32_t light) {
  const auto of_cell = lists.of(static_cast<std::uint32_t>(cell));
  return std::binary_search(of_cell.begin(), of_cell.end(), light);
}

// Points that landed in a cell whose list lacks the light.
inline int count_misses(const view::Frame& frame, const grid::Grid& grid, const Lists& lists, int points_per_light,
                        std::uint64_t seed) {
  const view::Space space = grid::space_of(grid, frame);
  Random random(seed);
  int misses = 0;
  for (std::uint32_t light = 0; light < frame.lights.size(); ++light) {
    if (frame.lights[light].range_m == 0.0) continue;
    for (int i = 0; i < points_per_light; ++i) {
      const Vec3d local = space.rotation * (point_in(frame.lights[light], random) - space.origin);
      const std::int64_t cell = cell_of_point(grid, local);
      if (cell < 0 || lists_light(lists, cell, light)) continue;
      if (++misses == 1) ADD_FAILURE() << "light " << light << " is lost in cell " << cell;
    }
  }
  return misses;
}

inline Lists lists_by(const std::string& assigner, const view::Frame& frame, const grid::Grid& grid,
                      const std::map<std::string, ParamValue>& params = {}) {
  const AssignerDescriptor* row = find_assigner(assigner);
  if (row == nullptr) throw std::runtime_error("no assigner " + assigner);
  const Params chosen(row->params, params);
  AssignerRun run(*row, chosen, answers_with_cells(*row, chosen).front());
  run.build(grid);
  const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
  const depth::DepthImage depths = row->needs.depth ? depth::seeded_depths(frame, 1) : depth::DepthImage{};
  run.assign({frame, lights, row->needs.depth ? &depths : nullptr});
  return run.cell_lists();
}

// Every pair of `part` is in `whole`.
inline bool contained(const Lists& part, const Lists& whole) {
  for (std::uint32_t cell = 0; cell < part.cell_count(); ++cell) {
    const auto a = part.of(cell), b = whole.of(cell);
    if (!std::includes(b.begin(), b.end(), a.begin(), a.end())) return false;
  }
  return true;
}

inline grid::Grid grid_of(const grid::GridSpec& spec, const view::Frame& frame) {
  return grid::make_grid(spec, grid::grid_inputs(spec, frame, 500.0, Vec3d{-100.0}, Vec3d{100.0}));
}

// Random lights around the view, small and large, the eye in some of them and some behind it; points, then spots.
inline std::vector<scene::WorldLight> random_lights(int points, int spots, std::uint64_t seed) {
  Random random(seed);
  std::vector<scene::WorldLight> lights;
  const auto place = [&] {
    const double depth = random.unit() < 0.15 ? random.between(-20, 1) : random.log_between(0.3, 300);
    const double beside = std::fabs(depth) + 5;
    return Vec3d{random.between(-1.2, 1.2) * beside, random.between(-0.8, 0.8) * beside, -depth};
  };
  // Draws are statements of their own: compilers evaluate arguments in different orders.
  for (int i = 0; i < points; ++i) {
    const double range = random.log_between(0.01, 60);
    lights.push_back(point_light(place(), range));
  }
  constexpr double k_angles[] = {
      0.0, 1.745e-4,          8.7e-4,  8.7e-3, 0.2, 0.5, M_PI / 4 - 1e-7, M_PI / 4, M_PI / 4 + 1e-7,
      1.2, 89.9 * M_PI / 180, M_PI / 2};
  for (int i = 0; i < spots; ++i) {
    const bool along_axis = random.unit() < 0.2;
    const Vec3d direction =
        along_axis ? Vec3d{i % 3 == 0, i % 3 == 1, i % 3 == 2} * (i % 2 ? 1.0 : -1.0) : random.direction();
    const double range = random.log_between(0.1, 60);
    lights.push_back(spot_light(place(), range, direction, k_angles[i % 12]));
  }
  return lights;
}

// Probes, decals, flat ones and sheared ones, some turned as the axes are.
inline std::vector<scene::WorldLight> random_boxes(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<scene::WorldLight> boxes;
  for (int i = 0; i < count; ++i) {
    const double depth = random.unit() < 0.15 ? random.between(-20, 1) : random.log_between(0.3, 300);
    const double beside = std::fabs(depth) + 5;
    const Vec3d at{random.between(-1.2, 1.2) * beside, random.between(-0.8, 0.8) * beside, -depth};
    const bool along_axes = i % 4 == 0;
    const Vec3d x = along_axes ? Vec3d(1, 0, 0) : random.direction();
    const Vec3d y = along_axes ? Vec3d(0, 1, 0) : glm::normalize(glm::cross(x, random.direction()));
    std::array<Vec3d, 3> axes{random.log_between(0.05, 40) * x, random.log_between(0.05, 40) * y,
                              (i % 5 == 0 ? 0.0 : random.log_between(0.01, 20)) * glm::cross(x, y)};
    if (i % 6 == 0) axes[0] += random.between(-1, 1) * axes[1];
    boxes.push_back(box_light(at, axes));
  }
  return boxes;
}

}  // namespace clusterbench::assign::testing
