#include "assign/contract.h"

#include <cmath>

#include "assign/allocations.h"
#include "assign/contract/assigner_run.h"

namespace clusterbench::assign::testing {
namespace {

// Pixels and depths all over the view, a few beyond the grid.
std::vector<grid::Sample> samples_in(const Setting& setting) {
  const view::Frame& frame = setting.frame;
  const view::Projection& projection = frame.projection;
  const double far = std::isfinite(projection.far_m) ? projection.far_m : 1e3;
  Random random(97);
  std::vector<grid::Sample> samples;
  for (int i = 0; i < 300; ++i) {
    const double x = random.between(0.0, 1.0), y = random.between(0.0, 1.0);
    const double depth = projection.near_m + (1.05 * far - projection.near_m) * std::pow(random.between(0.0, 1.0), 3.0);
    const double scale = projection.orthographic ? 1.0 : depth;
    const Vec3d local{(projection.left + (projection.right - projection.left) * x) * scale,
                      (projection.top - (projection.top - projection.bottom) * y) * scale, -depth};
    samples.push_back({static_cast<float>(x * frame.viewport.x), static_cast<float>(y * frame.viewport.y), Vec3f(local),
                       glm::transpose(frame.view_space.rotation) * local, frame.view_space.origin});
  }
  return samples;
}

// --- Checks, each a sentence or nothing ---

std::string at_cell(std::uint32_t cell) {
  return " (cell " + std::to_string(cell) + ")";
}

std::string form_fault(const AssignerRun& run, const grid::Grid& grid, const view::LightArrays& lights) {
  if (run.filled_lists() != nullptr) {
    const std::string fault = lists_fault(*run.filled_lists(), grid.cell_count(), lights);
    if (!fault.empty()) return fault;
  }
  if (run.structure() != nullptr && run.has_cells()) {
    const std::uint32_t cells =
        run.has_occupied_cells() ? run.structure()->occupied_cells().cell_count() : grid.cell_count();
    const std::string fault = lists_fault(run.structure()->expanded(), cells, lights);
    if (!fault.empty()) return "expanded: " + fault;
  }
  if (!run.has_cells()) return "";
  const Lists& lists = run.cell_lists();
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    if (!run.has_occupied_cells() && grid.is_hole(cell) && !lists.of(cell).empty())
      return "a hole has lights" + at_cell(cell);
    for (const std::uint32_t light : lists.of(cell))
      if (lights.radius[light] == 0.0f) return "a light without volume is listed" + at_cell(cell);
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
  for (std::uint32_t light = 0; light < lights.points.count; ++light)
    for (std::uint32_t cell = 0; std::isinf(lights.radius[light]) && cell < lists.cell_count(); ++cell)
      if (!setting.grid.is_hole(cell) && !lists_light(lists, cell, light))
        return "an unbounded point light is not everywhere" + at_cell(cell);
  return "";
}

// A frame of the view that lights are drawn in, without any.
struct NoLights {
  view::Frame frame;
  view::LightArrays lights;

  const depth::DepthImage* depth;

  explicit NoLights(const Setting& setting) : frame(setting.frame), depth(setting.input({}).depth) {
    frame.lights.clear();
    frame.points = 0;
    lights = view::lights_in(frame, grid::space_of(setting.grid, frame));
  }
  FrameInput input() const { return {frame, lights, depth}; }
};

// What the run answers now, whatever it answers with: at cells or, without them, at samples.
Lists answers_of(const AssignerRun& run, const Setting& setting) {
  if (run.has_cells()) return run.cell_lists();
  Lists lists;
  lists.begin.push_back(0);
  std::vector<std::uint32_t> given;
  for (const grid::Sample& sample : samples_in(setting)) {
    run.structure()->lights_at(sample, grid::Log2::rounded, given);
    lists.lights.insert(lists.lights.end(), given.begin(), given.end());
    lists.begin.push_back(lists.pair_count());
  }
  make_ascending(lists);
  return lists;
}

// Other frames between two equal ones, and a grid built again, must leave no trace.
std::string memory_fault(AssignerRun& run, const Lists& expected, const Setting& setting, const FrameInput& input) {
  const std::uint64_t tests = run.tests_done();
  const NoLights none(setting);
  run.assign(none.input());
  const Lists empty = answers_of(run, setting);
  if (empty.cell_count() != expected.cell_count() || !empty.lights.empty())
    return "a frame without lights has no empty lists";
  if (run.tests_done() != 0) return "tests are counted in a frame without lights";
  run.assign(input);
  if (answers_of(run, setting) != expected) return "lists depend on the frame before";
  if (run.tests_done() != tests) return "counted tests depend on the frame before";
  run.build(setting.grid);
  run.assign(input);
  return answers_of(run, setting) == expected ? "" : "lists change when the grid is built again";
}

// A build leaves nothing to the first assignment after it, whose time would not be the build's. Memory has grown.
std::string late_build_fault(AssignerRun& run, const grid::Grid& grid, const FrameInput& input) {
  run.build(grid);
  const std::uint64_t before = allocations();
  run.assign(input);
  const std::uint64_t taken = allocations() - before;
  if (run.fallbacks() > 0) return "";
  return taken == 0 ? "" : "the first frame after a build allocates " + std::to_string(taken) + " times";
}

// Exact arithmetic, which some lights here force a method into, allocates.
std::string allocation_fault(AssignerRun& run, const FrameInput& input) {
  run.assign(input);
  if (run.fallbacks() > 0) return "";
  const std::uint64_t before = allocations();
  run.assign(input);
  const std::uint64_t taken = allocations() - before;
  return taken == 0 ? "" : "a steady frame allocates " + std::to_string(taken) + " times";
}

// A structure answers at samples, each light once and points first; with cells, what the cell that the sample is looked
// up in expands to.
std::string sample_fault(const LightStructure& structure, const Setting& setting) {
  const Lists cells = structure.has_cells() ? structure.expanded() : Lists{};
  const view::LightRanges ranges = setting.frame.ranges();
  std::vector<std::uint32_t> given;
  for (const grid::Sample& sample : samples_in(setting)) {
    given.assign(3, ranges.size());  // what is there before is no answer
    structure.lights_at(sample, grid::Log2::rounded, given);
    Lists alone;
    alone.lights = given;
    alone.begin = {0, alone.pair_count()};
    const std::string fault = lists_fault(alone, 1, ranges);
    if (!fault.empty()) return "at a sample: " + fault;
    if (!structure.has_cells() || structure.has_occupied_cells()) continue;
    const std::int64_t cell = grid::lookup(setting.grid, sample);
    const auto list = cell < 0 ? std::span<const std::uint32_t>{} : cells.of(static_cast<std::uint32_t>(cell));
    if (!std::equal(list.begin(), list.end(), given.begin(), given.end()))
      return "a sample's lights are not its cell's" + at_cell(static_cast<std::uint32_t>(cell));
  }
  return "";
}

// Without cells no list can be compared: points in lights ask.
std::string lost_sample_fault(const LightStructure& structure, const Setting& setting) {
  Random random(98);
  std::vector<std::uint32_t> given;
  for (std::uint32_t light = 0; light < setting.frame.lights.size(); ++light) {
    const scene::WorldLight& at = setting.frame.lights[light];
    if (at.range_m == 0.0) continue;
    for (int i = 0; i < 60; ++i) {
      const Vec3d world = point_in(at, random);
      const Vec3d local = setting.frame.view_space.rotation * (world - setting.frame.view_space.origin);
      structure.lights_at(
          {0.0f, 0.0f, Vec3f(local), world - setting.frame.view_space.origin, setting.frame.view_space.origin},
          grid::Log2::rounded, given);
      if (std::find(given.begin(), given.end(), light) == given.end())
        return "light " + std::to_string(light) + " is lost at a sample";
    }
  }
  return "";
}

}  // namespace

std::vector<std::string> contract_faults(const AssignerDescriptor& assigner, const Params& params, Answer answer,
                                         const Setting& setting) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  const FrameInput input = setting.input(lights);
  AssignerRun run(assigner, params, answer);
  run.build(setting.grid);
  run.assign(input);
  if (const std::string fault = form_fault(run, setting.grid, lights); !fault.empty()) return {fault};

  std::vector<std::string> faults;
  const auto add = [&](std::string fault) {
    if (!fault.empty()) faults.push_back(std::move(fault));
  };
  if (assigner.conservative && run.has_cells() && !run.has_occupied_cells()) {
    add(lost_light_fault(run.cell_lists(), setting));
    add(unbounded_fault(run.cell_lists(), setting, lights));
  }
  if (run.structure() != nullptr) add(sample_fault(*run.structure(), setting));
  if (assigner.conservative && !run.has_cells() && !assigner.at_surfaces)
    add(lost_sample_fault(*run.structure(), setting));
  add(run.tests_done() == 0 ? "no test is counted" : "");
  add(run.scratch_bytes() == 0 ? "no scratch memory is counted" : "");
  add(memory_fault(run, answers_of(run, setting), setting, input));
  add(allocation_fault(run, input));
  add(late_build_fault(run, setting.grid, input));
  return faults;
}

std::vector<std::string> contract_faults(const AssignerDescriptor& assigner, const Params& params,
                                         const Setting& setting) {
  std::vector<std::string> all;
  for (const Answer answer : {Answer::lists, Answer::structure}) {
    if (!assigner.answers(answer)) continue;
    const std::vector<std::string> faults = contract_faults(assigner, params, answer, setting);
    all.insert(all.end(), faults.begin(), faults.end());
  }
  return all;
}

}  // namespace clusterbench::assign::testing
