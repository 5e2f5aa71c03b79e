#pragma once
// Views, grids and lights that every assigner must cope with.

#include <limits>
#include <string>
#include <vector>

#include "assign/assigner.h"
#include "assign/dense_check.h"
#include "assign/touching_lights.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign::testing {

// A grid with the frame that it is seen in; the frame's lights are what the contract is checked with.
struct Setting {
  struct Touch {
    std::uint32_t cell, light;
  };

  std::string name;
  view::Frame frame;
  grid::Grid grid;
  std::vector<Touch> touches;  // true pairs by a hair
};

namespace settings {

inline constexpr double k_unbounded = std::numeric_limits<double>::infinity();
inline constexpr double k_degree = M_PI / 180;

inline grid::GridSpec screen_spec(grid::Kind kind, Vec2i tiles, grid::Scheme scheme, int slices, double near_m) {
  grid::GridSpec spec;
  spec.kind = kind;
  spec.tiles = {{0, 0}, tiles};
  spec.slices = {.scheme = scheme, .count = slices, .near_m = near_m, .far_m = 300.0, .boundaries_m = {}};
  return spec;
}

inline grid::GridSpec box_spec(grid::Kind kind, Vec3i cells) {
  grid::GridSpec spec;
  spec.kind = kind;
  spec.cells = cells;
  spec.levels = 4;
  spec.has_bounds = true;
  spec.bounds_lo_m = {-150, -40, -200};
  spec.bounds_hi_m = {120, 60, 40};
  return spec;
}

// A place far from the origin, where single precision would hold 0.1 mm, looking askew.
inline view::Space far_and_turned() {
  const Vec3d back = glm::normalize(Vec3d{0.3, 0.2, 0.9}), right = glm::normalize(glm::cross(Vec3d{0.1, 1, 0}, back));
  return {{2000, -30, 1000}, glm::transpose(Mat3d{right, glm::cross(back, right), back})};
}

struct Plan {
  std::string name;
  grid::GridSpec spec;
  view::Projection projection;
  view::Space view_space;
};

inline std::vector<Plan> plans_for(const AssignerRow& row, grid::Kind kind) {
  const view::Projection usual = perspective(60 * k_degree, 16.0 / 9.0, 0.1, 300);
  const view::Projection off_centre{false, -0.3, 1.1, -0.9, 0.2, 0.1, 300};
  const view::Projection boxy{true, -40, 40, -22.5, 22.5, 0, 300};
  using grid::Scheme;
  if (kind == grid::Kind::world) return {{"world", box_spec(kind, {18, 6, 16}), usual, {}}};
  if (kind == grid::Kind::cascades) return {{"cascades", box_spec(kind, {8, 8, 8}), usual, far_and_turned()}};
  std::vector<Plan> plans{
      {"usual view", screen_spec(kind, {16, 9}, Scheme::exponential, 24, 0.1), usual, far_and_turned()},
      {"off-centre view", screen_spec(kind, {7, 11}, Scheme::exponential_first, 12, 0.1), off_centre, {}}};
  if (row.orthographic && kind == grid::Kind::frustum)
    plans.push_back({"orthographic view", screen_spec(kind, {16, 9}, Scheme::linear, 20, 0.0), boxy, far_and_turned()});
  return plans;
}

inline void place_in_world(std::vector<scene::WorldLight>& lights, const view::Space& space) {
  const Mat3d back = glm::transpose(space.rotation);
  for (scene::WorldLight& light : lights) {
    light.position = back * light.position + space.origin;
    light.direction = back * light.direction;
  }
}

inline void add_touching(Setting& setting, const std::vector<TouchingLight>& touching) {
  for (const TouchingLight& each : touching) {
    setting.touches.push_back({each.cell, static_cast<std::uint32_t>(setting.frame.lights.size())});
    setting.frame.lights.push_back(each.light);
  }
}

inline void add_lights(Setting& setting, const AssignerRow& row, std::uint64_t seed) {
  const view::Space cells = grid::space_of(setting.grid, setting.frame);
  const Vec3d ahead = setting.frame.view_space.origin - 10.0 * glm::transpose(setting.frame.view_space.rotation)[2];
  std::vector<scene::WorldLight>& lights = setting.frame.lights;
  if (row.points) {
    lights = random_lights(60, 0, seed);
    place_in_world(lights, setting.frame.view_space);
    lights.push_back(point_light(ahead, 0.0));
    lights.push_back(point_light(ahead, k_unbounded));
    lights.push_back(point_light(setting.frame.view_space.origin, 3.0));
    add_touching(setting, touching_points(setting.grid, cells, 300, seed + 1));
  }
  setting.frame.points = static_cast<std::uint32_t>(lights.size());
  if (row.spots) {
    std::vector<scene::WorldLight> spots = random_lights(0, 60, seed + 2);
    place_in_world(spots, setting.frame.view_space);
    lights.insert(lights.end(), spots.begin(), spots.end());
    lights.push_back(spot_light(ahead, 0.0, {0, 0, -1}, 0.5));
    lights.push_back(spot_light(ahead, k_unbounded, {0.2, 0.1, -1}, 0.7));
    add_touching(setting, touching_spots(setting.grid, cells, 300, seed + 3));
  }
}

}  // namespace settings

// Every grid kind that the row takes, in perspective, off-centre and (where the row allows it) orthographic views, with
// random lights, lights that touch cells from outside by a hair, the eye in lights, lights behind the eye, lights
// without volume and without end.
inline std::vector<Setting> settings_for(const AssignerRow& row, std::uint64_t seed) {
  std::vector<Setting> settings;
  for (const grid::Kind kind : row.kinds)
    for (const settings::Plan& plan : settings::plans_for(row, kind)) {
      Setting setting;
      setting.name = std::string(grid::kind_name(kind)) + ", " + plan.name;
      setting.frame = frame_of(plan.projection, {1280, 717}, {});
      setting.frame.view_space = plan.view_space;
      setting.grid = grid_of(plan.spec, setting.frame);
      settings::add_lights(setting, row, seed);
      settings.push_back(std::move(setting));
    }
  return settings;
}

// The row's defaults, and each choice of each text parameter.
inline std::vector<Params> params_of(const AssignerRow& row) {
  std::vector<Params> all{Params(row.params)};
  for (const ParamSpec& param : row.params)
    for (const std::string& choice : param.choices)
      if (ParamValue(choice) != param.standard)
        all.emplace_back(row.params, std::map<std::string, ParamValue>{{param.name, choice}});
  return all;
}

}  // namespace clusterbench::assign::testing
