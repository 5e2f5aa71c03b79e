#include "assign/contract.h"

#include <limits>

#include "assign/allocations.h"
#include "assign/dense_check.h"
#include "assign/touching_lights.h"

namespace clusterbench::assign::testing {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_degree = M_PI / 180;

// --- Settings ---

grid::GridSpec screen_spec(grid::Kind kind, Vec2i tiles, grid::Scheme scheme, int slices, double near_m) {
  grid::GridSpec spec;
  spec.kind = kind;
  spec.tiles = {{0, 0}, tiles};
  spec.slices = {.scheme = scheme, .count = slices, .near_m = near_m, .far_m = 300.0, .boundaries_m = {}};
  return spec;
}

grid::GridSpec box_spec(grid::Kind kind, Vec3i cells) {
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
view::Space far_and_turned() {
  const Vec3d back = glm::normalize(Vec3d{0.3, 0.2, 0.9}), right = glm::normalize(glm::cross(Vec3d{0.1, 1, 0}, back));
  return {{2000, -30, 1000}, glm::transpose(Mat3d{right, glm::cross(back, right), back})};
}

struct Plan {
  std::string name;
  grid::GridSpec spec;
  view::Projection projection;
  view::Space view_space;
};

std::vector<Plan> plans_for(const AssignerRow& row, grid::Kind kind) {
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

void place_in_world(std::vector<scene::WorldLight>& lights, const view::Space& space) {
  const Mat3d back = glm::transpose(space.rotation);
  for (scene::WorldLight& light : lights) {
    light.position = back * light.position + space.origin;
    light.direction = back * light.direction;
  }
}

void add_touching(Setting& setting, const std::vector<TouchingLight>& touching) {
  for (const TouchingLight& each : touching) {
    setting.touches.push_back({each.cell, static_cast<std::uint32_t>(setting.frame.lights.size())});
    setting.frame.lights.push_back(each.light);
  }
}

void add_lights(Setting& setting, const AssignerRow& row, std::uint64_t seed) {
  const view::Space cells = grid::space_of(setting.grid, setting.frame);
  const Vec3d ahead = setting.frame.view_space.origin - 10.0 * glm::transpose(setting.frame.view_space.rotation)[2];
  std::vector<scene::WorldLight>& lights = setting.frame.lights;
  if (row.points) {
    lights = random_lights(60, 0, seed);
    place_in_world(lights, setting.frame.view_space);
    lights.push_back(point_light(ahead, 0.0));
    lights.push_back(point_light(ahead, k_infinity));
    lights.push_back(point_light(setting.frame.view_space.origin, 3.0));
    add_touching(setting, touching_points(setting.grid, cells, 300, seed + 1));
  }
  setting.frame.points = static_cast<std::uint32_t>(lights.size());
  if (row.spots) {
    std::vector<scene::WorldLight> spots = random_lights(0, 60, seed + 2);
    place_in_world(spots, setting.frame.view_space);
    lights.insert(lights.end(), spots.begin(), spots.end());
    lights.push_back(spot_light(ahead, 0.0, {0, 0, -1}, 0.5));
    lights.push_back(spot_light(ahead, k_infinity, {0.2, 0.1, -1}, 0.7));
    add_touching(setting, touching_spots(setting.grid, cells, 300, seed + 3));
  }
}

// --- Checks, each a sentence or nothing ---

std::string at_cell(std::uint32_t cell) {
  return " (cell " + std::to_string(cell) + ")";
}

std::string form_fault(const Lists& lists, const grid::Grid& grid, const view::LightArrays& lights) {
  if (lists.begin.size() != grid.cell_count() + std::size_t{1}) return "not one list per cell";
  if (lists.begin.front() != 0 || lists.begin.back() != lists.lights.size()) return "lists do not cover the indices";
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    if (lists.begin[cell] > lists.begin[cell + 1]) return "a list of negative length" + at_cell(cell);
    const auto list = lists.of(cell);
    if (grid.is_hole(cell) && !list.empty()) return "a hole has lights" + at_cell(cell);
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (list[i] >= lights.size()) return "a light that does not exist" + at_cell(cell);
      if (i > 0 && list[i - 1] >= list[i]) return "lights not ascending, each once" + at_cell(cell);
      if (lights.radius[list[i]] == 0.0f) return "a light without volume is listed" + at_cell(cell);
    }
  }
  return "";
}

std::string lost_light_fault(const Lists& lists, const Setting& setting) {
  for (const auto& [cell, light] : setting.touches)
    if (!lists_light(lists, cell, light))
      return "light " + std::to_string(light) + " is lost where it touches by a hair" + at_cell(cell);
  const view::Space space = grid::space_of(setting.grid, setting.frame);
  Random random(99);
  for (std::uint32_t light = 0; light < setting.frame.lights.size(); ++light) {
    if (setting.frame.lights[light].range_m == 0.0) continue;
    for (int i = 0; i < 60; ++i) {
      const Vec3d local = space.rotation * (point_in(setting.frame.lights[light], random) - space.origin);
      const std::int64_t cell = cell_of_point(setting.grid, local);
      if (cell >= 0 && !lists_light(lists, cell, light))
        return "light " + std::to_string(light) + " is lost" + at_cell(static_cast<std::uint32_t>(cell));
    }
  }
  return "";
}

std::string unbounded_fault(const Lists& lists, const Setting& setting, const view::LightArrays& lights) {
  for (std::uint32_t light = 0; light < lights.points; ++light)
    for (std::uint32_t cell = 0; std::isinf(lights.radius[light]) && cell < lists.cell_count(); ++cell)
      if (!setting.grid.is_hole(cell) && !lists_light(lists, cell, light))
        return "an unbounded point light is not everywhere" + at_cell(cell);
  return "";
}

// Other frames between two equal ones, and a grid built again, must leave no trace.
std::string memory_fault(Assigner& assigner, const Lists& expected, const Setting& setting,
                         const view::LightArrays& lights) {
  const std::uint64_t tests = assigner.tests_done();
  Lists lists;
  assigner.assign({}, lists);
  if (lists.begin.size() != setting.grid.cell_count() + std::size_t{1} || !lists.lights.empty())
    return "a frame without lights has no empty lists";
  if (assigner.tests_done() != 0) return "tests are counted in a frame without lights";
  assigner.assign(lights, lists);
  if (lists != expected) return "lists depend on the frame before";
  if (assigner.tests_done() != tests) return "counted tests depend on the frame before";
  assigner.build(setting.grid);
  assigner.assign(lights, lists);
  return lists == expected ? "" : "lists change when the grid is built again";
}

std::string allocation_fault(Assigner& assigner, Lists& lists, const view::LightArrays& lights) {
  assigner.assign(lights, lists);
  const std::uint64_t before = allocations();
  assigner.assign(lights, lists);
  const std::uint64_t taken = allocations() - before;
  return taken == 0 ? "" : "a steady frame allocates " + std::to_string(taken) + " times";
}

}  // namespace

std::vector<Setting> settings_for(const AssignerRow& row, std::uint64_t seed) {
  std::vector<Setting> settings;
  for (const grid::Kind kind : row.kinds)
    for (const Plan& plan : plans_for(row, kind)) {
      Setting setting;
      setting.name = std::string(grid::kind_name(kind)) + ", " + plan.name;
      setting.frame = frame_of(plan.projection, {1280, 717}, {});
      setting.frame.view_space = plan.view_space;
      setting.grid = grid_of(plan.spec, setting.frame);
      add_lights(setting, row, seed);
      settings.push_back(std::move(setting));
    }
  return settings;
}

std::vector<Params> params_of(const AssignerRow& row) {
  std::vector<Params> all{Params(row.params)};
  for (const ParamSpec& param : row.params)
    for (const std::string& choice : param.choices)
      if (ParamValue(choice) != param.standard)
        all.emplace_back(row.params, std::map<std::string, ParamValue>{{param.name, choice}});
  return all;
}

std::vector<std::string> contract_faults(const AssignerRow& row, const Params& params, const Setting& setting) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  const auto assigner = row.make(params);
  assigner->build(setting.grid);
  Lists lists;
  assigner->assign(lights, lists);
  if (const std::string fault = form_fault(lists, setting.grid, lights); !fault.empty()) return {fault};

  std::vector<std::string> faults;
  const auto add = [&](std::string fault) {
    if (!fault.empty()) faults.push_back(std::move(fault));
  };
  if (row.conservative) {
    add(lost_light_fault(lists, setting));
    add(unbounded_fault(lists, setting, lights));
  }
  add(assigner->tests_done() == 0 ? "no test is counted" : "");
  add(assigner->scratch_bytes() == 0 ? "no scratch memory is counted" : "");
  add(memory_fault(*assigner, Lists(lists), setting, lights));
  add(allocation_fault(*assigner, lists, lights));
  return faults;
}

}  // namespace clusterbench::assign::testing
