#pragma once
// Views, grids and lights that every assigner must cope with.

#include <limits>
#include <string>
#include <vector>

#include "assign/contract/assigner.h"
#include "assign/dense_check.h"
#include "assign/touching_lights.h"
#include "geom/shapes/domain.h"
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
  depth::DepthImage depth{};   // where a method is asked for that needs it

  FrameInput input(const view::LightArrays& lights) const {
    return {frame, lights, depth.nearest.empty() ? nullptr : &depth};
  }
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

inline std::vector<Plan> plans_for(const AssignerDescriptor& row, grid::Kind kind) {
  const view::Projection usual = perspective(60 * k_degree, 16.0 / 9.0, 0.1, 300);
  const view::Projection off_centre{false, -0.3, 1.1, -0.9, 0.2, 0.1, 300};
  const view::Projection boxy{true, -40, 40, -22.5, 22.5, 0, 300};
  using grid::Scheme;
  if (kind == grid::Kind::world) return {{"world", box_spec(kind, {18, 6, 16}), usual, {}}};
  if (kind == grid::Kind::cascades) return {{"cascades", box_spec(kind, {8, 8, 8}), usual, far_and_turned()}};
  std::vector<Plan> plans{
      {"usual view", screen_spec(kind, {16, 9}, Scheme::exponential, 24, 0.1), usual, far_and_turned()},
      {"off-centre view", screen_spec(kind, {7, 11}, Scheme::exponential_first, 12, 0.1), off_centre, {}}};
  if (row.orthographic && kind == grid::Kind::frustum) {
    plans.push_back({"orthographic view", screen_spec(kind, {16, 9}, Scheme::linear, 20, 0.0), boxy, far_and_turned()});
    plans.push_back({"orthographic view, exponential from 0", screen_spec(kind, {16, 9}, Scheme::exponential, 12, 0.0),
                     boxy, far_and_turned()});
  }
  return plans;
}

inline void place_in_world(std::vector<scene::WorldLight>& lights, const view::Space& space) {
  const Mat3d back = glm::transpose(space.rotation);
  for (scene::WorldLight& light : lights) {
    light.position = back * light.position + space.origin;
    light.direction = back * light.direction;
    for (Vec3d& axis : light.half_axes_m) axis = back * axis;
  }
}

inline void add_touching(Setting& setting, const std::vector<TouchingLight>& touching) {
  for (const TouchingLight& each : touching) {
    setting.touches.push_back({each.cell, static_cast<std::uint32_t>(setting.frame.lights.size())});
    setting.frame.lights.push_back(each.light);
  }
}

inline void add_lights(Setting& setting, const AssignerDescriptor& row, std::uint64_t seed) {
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
  if (row.boxes) {
    const std::size_t others = lights.size();
    std::vector<scene::WorldLight> boxes = random_boxes(60, seed + 4);
    place_in_world(boxes, setting.frame.view_space);
    lights.insert(lights.end(), boxes.begin(), boxes.end());
    lights.push_back(box_light(ahead, {Vec3d(0), Vec3d(0), Vec3d(0)}));
    lights.push_back(box_light(setting.frame.view_space.origin, {Vec3d(2, 0, 0), Vec3d(0, 3, 0), Vec3d(0, 0, 1)}));
    add_touching(setting, touching_boxes(setting.grid, cells, 300, seed + 5));
    setting.frame.boxes = static_cast<std::uint32_t>(lights.size() - others);
  }
}

// --- Nasty scales: cells and lights from the domain's least lengths (geom/shapes/domain.h) to its greatest ---

// A grid whose cells are about so large, and its view.
inline Plan plan_of_size(const AssignerDescriptor& row, grid::Kind kind, double size_m, Random& random) {
  Plan plan;
  plan.name = std::to_string(static_cast<int>(std::lround(std::log10(size_m))));
  plan.spec.kind = kind;
  const bool orthographic = row.orthographic && kind == grid::Kind::frustum && random.unit() < 0.3;
  const double most_slope = std::min(100.0, 0.25 * geom::k_farthest_m / (10 * size_m));  // in the domain at the far end
  const double steepest = orthographic ? size_m * random.log_between(0.1, 10) : random.log_between(1e-3, most_slope);
  const double left = -steepest * random.between(-0.5, 1), down = -steepest * random.between(-0.5, 1);
  const double right = left + steepest * random.between(0.1, 1), up = down + steepest * random.between(0.1, 1);
  plan.projection = {orthographic, left, right, down, up, 0.0, 100 * size_m};
  plan.spec.tiles = {{random.unit() < 0.5 ? Vec2i{100, 90} : Vec2i{330, 100}}, {0, 0}};
  plan.spec.slices.scheme = grid::Scheme::list;
  plan.spec.slices.boundaries_m = {0, 0.1 * size_m, size_m, 3 * size_m, 10 * size_m};
  if (random.unit() < 0.3) plan.spec.slices.boundaries_m.erase(plan.spec.slices.boundaries_m.begin());
  plan.projection.near_m = plan.spec.slices.boundaries_m.front();
  plan.spec.cells = kind == grid::Kind::world ? Vec3i{7, 3, 5} : Vec3i{8, 4, 4};
  plan.spec.levels = 2;
  plan.spec.finest_m = size_m;
  plan.spec.has_bounds = true;
  plan.spec.bounds_lo_m = Vec3d(-size_m * random.between(0.1, 1));
  plan.spec.bounds_hi_m = Vec3d(size_m * random.between(0.1, 1));
  return plan;
}

// Near cells' sides by a hair of any size, in them, and anywhere; the eye in some, by a hair of any size.
inline scene::WorldLight light_of_any_size(const grid::Grid& grid, const view::Space& space, double size_m,
                                           Random& random) {
  const auto hair = [&] { return random.log_between(1e-17, 1e-2) * (random.unit() < 0.5 ? -1 : 1); };
  const double least = 1.01 * geom::k_nearest_m, most = 0.5 * geom::k_farthest_m;
  const double range = random.unit() < 0.5 ? random.log_between(least, most)
                                           : std::clamp(size_m * random.log_between(1e-3, 1e4), least, most);
  const double kind = random.unit();
  if (kind < 0.2) return point_light(space.origin + range * random.direction(), range * (1 + hair()));
  if (kind < 0.4) return point_light(space.origin + random.log_between(least, most) * random.direction(), range);
  const std::uint32_t cell = touching::random_cell(grid, random);
  const touching::Contact contact =
      std::visit([&](const auto& shape) { return touching::contact_of(shape, random); }, grid.cell(cell));
  return point_light(touching::in_world(contact.point + range * contact.outward, space), range * (1 + hair()));
}

inline bool stands_in_domain(const scene::WorldLight& light) {
  return geom::is_in_domain(light.position.x) && geom::is_in_domain(light.position.y) &&
         geom::is_in_domain(light.position.z);
}

inline void add_lights_of_any_size(Setting& setting, const AssignerDescriptor& row, double size_m, int count,
                                   Random& random) {
  const view::Space cells = grid::space_of(setting.grid, setting.frame);
  std::vector<scene::WorldLight>& lights = setting.frame.lights;
  for (const bool is_spot : {false, true}) {
    for (int i = 0; i < count && (is_spot ? row.spots : row.points); ++i) {
      scene::WorldLight light = light_of_any_size(setting.grid, cells, size_m, random);
      if (is_spot)
        light = spot_light(light.position, light.range_m, random.direction(), random.log_between(1e-5, 1.57));
      light.range_m = geom::range_in_domain(light.range_m);
      if (stands_in_domain(light)) lights.push_back(light);
    }
    if (!is_spot) setting.frame.points = static_cast<std::uint32_t>(lights.size());
  }
  for (int i = 0; i < count && row.boxes; ++i) {
    const scene::WorldLight at = light_of_any_size(setting.grid, cells, size_m, random);
    const double reach = std::min(at.range_m, 1e14);
    scene::WorldLight box = box_light(
        at.position, {reach * random.direction(), random.log_between(1e-6, 1) * reach * random.direction(),
                      random.unit() < 0.3 ? Vec3d(0) : random.log_between(1e-6, 1) * reach * random.direction()});
    box.range_m = geom::range_in_domain(box.range_m);
    if (!stands_in_domain(box)) continue;
    lights.push_back(box);
    ++setting.frame.boxes;
  }
}

}  // namespace settings

// What draws lights looks at each pixel of each light, in the contract's tests many times over.
inline Vec2i viewport_for(const AssignerDescriptor& row, Vec2i viewport) {
  return row.draws_lights ? viewport / 4 : viewport;
}

// Settings at all scales of the domain, with lights of all sizes: `count` points and spots each.
inline std::vector<Setting> settings_of_any_size(const AssignerDescriptor& row, int count, std::uint64_t seed) {
  std::vector<Setting> all;
  Random random(seed);
  for (const grid::Kind kind : row.kinds)
    for (const double size_m : {1e-13, 1e-9, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e5, 1e8, 1e11, 1e13}) {
      const settings::Plan plan = settings::plan_of_size(row, kind, size_m, random);
      Setting setting;
      setting.name = std::string(grid::kind_name(kind)) + " of 1e" + plan.name + " m";
      setting.frame = frame_of(plan.projection, viewport_for(row, {1000, 640}), {});
      setting.frame.view_space = random.unit() < 0.5 ? view::Space{} : settings::far_and_turned();
      setting.grid = grid_of(plan.spec, setting.frame);
      settings::add_lights_of_any_size(setting, row, size_m, count, random);
      if (row.needs.depth) setting.depth = depth::seeded_depths(setting.frame, seed);
      all.push_back(std::move(setting));
    }
  return all;
}

// Every grid kind that the row takes, in perspective, off-centre and (where the row allows it) orthographic views, with
// random lights, lights that touch cells from outside by a hair, the eye in lights, lights behind the eye, lights
// without volume and without end.
inline std::vector<Setting> settings_for(const AssignerDescriptor& row, std::uint64_t seed) {
  std::vector<Setting> settings;
  for (const grid::Kind kind : row.kinds)
    for (const settings::Plan& plan : settings::plans_for(row, kind)) {
      Setting setting;
      setting.name = std::string(grid::kind_name(kind)) + ", " + plan.name;
      setting.frame = frame_of(plan.projection, viewport_for(row, {1280, 717}), {});
      setting.frame.view_space = plan.view_space;
      setting.grid = grid_of(plan.spec, setting.frame);
      settings::add_lights(setting, row, seed);
      if (row.needs.depth) setting.depth = depth::seeded_depths(setting.frame, seed);
      settings.push_back(std::move(setting));
    }
  return settings;
}

// The row's defaults, and each choice of each text parameter.
inline std::vector<Params> params_of(const AssignerDescriptor& row) {
  std::vector<Params> all{Params(row.params)};
  for (const ParamSpec& param : row.params)
    for (const std::string& choice : param.choices)
      if (ParamValue(choice) != param.default_value)
        all.emplace_back(row.params, std::map<std::string, ParamValue>{{param.name, choice}});
  return all;
}

}  // namespace clusterbench::assign::testing
