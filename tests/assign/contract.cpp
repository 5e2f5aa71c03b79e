#include "assign/contract.h"

#include "assign/allocations.h"

namespace clusterbench::assign::testing {
namespace {

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

// A build leaves nothing to the first assignment after it, whose time would not be the build's. Memory has grown.
std::string late_build_fault(Assigner& assigner, const grid::Grid& grid, Lists& lists,
                             const view::LightArrays& lights) {
  assigner.build(grid);
  const std::uint64_t before = allocations();
  assigner.assign(lights, lists);
  const std::uint64_t taken = allocations() - before;
  if (assigner.fallbacks() > 0) return "";
  return taken == 0 ? "" : "the first frame after a build allocates " + std::to_string(taken) + " times";
}

// Exact arithmetic, which some lights here force a method into, allocates.
std::string allocation_fault(Assigner& assigner, Lists& lists, const view::LightArrays& lights) {
  assigner.assign(lights, lists);
  if (assigner.fallbacks() > 0) return "";
  const std::uint64_t before = allocations();
  assigner.assign(lights, lists);
  const std::uint64_t taken = allocations() - before;
  return taken == 0 ? "" : "a steady frame allocates " + std::to_string(taken) + " times";
}

}  // namespace

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
  add(late_build_fault(*assigner, setting.grid, lists, lights));
  return faults;
}

}  // namespace clusterbench::assign::testing
