// H23 to H26, H29: capacities of a cell, an index and a pool; order; threads; invalid cameras.

#include <algorithm>
#include <cmath>
#include <limits>

#include "assign/contract/assigner_run.h"
#include "assign/contract/storage.h"
#include "core/error.h"
#include "core/random.h"
#include "measure/truth/truth.h"
#include "stress/hard_cases.h"

namespace clusterbench::stress {
namespace {

constexpr std::uint32_t k_counts[] = {99, 100, 101, 255, 256, 257, 65535, 65536};

Rig coincident(std::uint32_t count) {
  Rig rig;
  for (std::uint32_t i = 0; i < count; ++i) rig.point({0.3, 0.2, -10}, 0.01);
  return rig;
}

std::vector<Trial> many_at_one_point(std::uint64_t) {
  std::vector<Trial> trials;
  for (const std::uint32_t count : {99u, 100u, 101u, 255u, 256u, 257u})
    coincident(count).on_each(grids_of_every_kind(), std::to_string(count) + " lights", trials);
  return trials;
}

// One cell of n lights between two empty ones.
assign::Lists one_full_cell(std::uint32_t lights) {
  assign::Lists lists;
  lists.begin = {0, 0, lights, lights};
  for (std::uint32_t i = 0; i < lights; ++i) lists.lights.push_back(i);
  return lists;
}

std::unique_ptr<assign::Storage> filled(const char* name, const std::map<std::string, assign::ParamValue>& params,
                                        std::uint32_t lights) {
  const assign::StorageDescriptor& row = *assign::find_storage(name);
  auto storage = row.make(assign::Params(row.params, params));
  storage->start(3, {lights, 0});
  storage->store(one_full_cell(lights));
  return storage;
}

std::vector<ToolCheck> caps_are_counted(std::uint64_t) {
  std::vector<ToolCheck> checks;
  for (const std::uint32_t lights : k_counts) {
    const auto storage = filled("fixed", {{"cap", 100.0}}, lights);
    const std::uint32_t kept = std::min(lights, 100u), dropped = lights - kept;
    const assign::StructureUse use = storage->use();
    const bool highest = std::all_of(use.dropped_lights.begin(), use.dropped_lights.end(),
                                     [&](std::uint32_t light) { return light >= kept; });
    checks.push_back({"fixed, cap 100, " + std::to_string(lights) + " lights in a cell",
                      use.dropped_pairs == dropped && use.dropped_lights.size() == dropped && highest &&
                          storage->expanded().of(1).size() == kept,
                      std::to_string(use.dropped_pairs) + " dropped, the highest indices"});
  }
  return checks;
}

std::vector<ToolCheck> pools_hold_their_capacity(std::uint64_t) {
  std::vector<ToolCheck> checks;
  for (const std::uint32_t lights : {255u, 256u, 257u, 65535u, 65536u, 65537u}) {
    const auto storage = filled("packed", {}, lights);
    const assign::StructureUse use = storage->use();
    const assign::Lists back = storage->expanded();
    const auto kept = static_cast<std::uint64_t>(back.of(1).size());
    const std::uint32_t bits = lights <= 256 ? 8 : lights <= 65536 ? 16 : 32;
    checks.push_back(
        {"packed, " + std::to_string(lights) + " lights: every index is read back or counted as dropped",
         kept + use.dropped_pairs == lights && storage->index_bits() == bits && back.of(0).empty() &&
             back.of(2).empty(),
         std::to_string(storage->index_bits()) + " bits, " + std::to_string(use.dropped_pairs) + " dropped"});
  }
  return checks;
}

Trial mixed_lights(std::uint64_t seed, bool reversed) {
  SplitMix64 random(seed);
  struct Made {
    Vec3d position, direction;
    double range, angle;
  };
  std::vector<Made> made;
  for (int i = 0; i < 200; ++i) {
    Made light;
    for (int axis = 0; axis < 3; ++axis) light.position[axis] = random.between(-20, 20);
    light.position.z = i % 4 == 0 ? -12.0 : light.position.z - 20.0;
    for (int axis = 0; axis < 3; ++axis) light.direction[axis] = random.between(-1, 1);
    light.range = random.between(0.2, 9.0);
    light.angle = random.between(0.02, 1.5);
    made.push_back(light);
  }
  if (reversed) std::reverse(made.begin(), made.end());
  Rig rig;
  for (const Made& light : made) {
    rig.point(light.position, light.range);
    rig.spot(light.position, light.direction, light.range, light.angle);
  }
  return rig.on(pixel_grid({64, 64}));
}

std::vector<Trial> in_another_order(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const bool reversed : {false, true})
    for (const grid::GridSpec& spec : grids_of_every_kind()) {
      trials.push_back(mixed_lights(seed, reversed));
      trials.back().grid = spec;
      trials.back().label = reversed ? "reversed" : "as drawn";
    }
  return trials;
}

// The index of a light after reversing the lights of each type.
std::uint32_t reversed_within_type(std::uint32_t light, const view::LightRanges& ranges) {
  const view::LightRange type = ranges.types()[ranges.type_of(light)];
  return type.first + type.end() - 1 - light;
}

bool has_same_sets(const assign::AssignerDescriptor& assigner, const assign::Params& params, assign::Answer answer,
                   const Trial (&trials)[2]) {
  assign::Lists lists[2];
  view::LightRanges ranges;
  for (int i = 0; i < 2; ++i) {
    const view::Frame frame = frame_of(trials[i]);
    ranges = frame.ranges();
    const grid::Grid grid = grid_of(trials[i], frame);
    assign::AssignerRun run(assigner, params, answer);
    run.build(grid);
    const view::LightArrays lights = view::lights_in(frame, frame.view_space);
    const depth::DepthImage depths = depths_for(assigner, frame);
    run.assign(input_of(frame, lights, depths));
    lists[i] = run.cell_lists();
  }
  bool same = lists[0].begin == lists[1].begin;
  for (std::uint32_t cell = 0; same && cell < lists[0].cell_count(); ++cell) {
    std::vector<std::uint32_t> back;
    for (const std::uint32_t light : lists[1].of(cell)) back.push_back(reversed_within_type(light, ranges));
    std::sort(back.begin(), back.end());
    same = std::equal(back.begin(), back.end(), lists[0].of(cell).begin());
  }
  return same;
}

std::vector<ToolCheck> order_does_not_matter(std::uint64_t seed) {
  std::vector<ToolCheck> checks;
  const Trial trials[] = {mixed_lights(seed, false), mixed_lights(seed, true)};
  for (const assign::AssignerDescriptor* row : checked_methods()) {
    if (!row->takes(grid::Kind::frustum)) continue;
    const assign::Params params(row->params);
    for (const assign::Answer answer : assign::answers_with_cells(*row, params))
      checks.push_back({row->name + ": the same sets when the lights come in reverse",
                        has_same_sets(*row, params, answer, trials), ""});
  }
  return checks;
}

// An empty picture, one wall at a single depth, and a single pixel: the resulting parts of tiles.
std::vector<ToolCheck> depth_masks(std::uint64_t seed) {
  std::vector<ToolCheck> checks;
  const Trial trial = mixed_lights(seed, false);
  const view::Frame frame = frame_of(trial);
  const grid::Grid grid = grid_of(trial, frame);
  const view::LightArrays lights = view::lights_in(frame, frame.view_space);
  for (const assign::AssignerDescriptor* row : checked_methods()) {
    if (!row->at_surfaces) continue;
    assign::AssignerRun run(*row, assign::Params(row->params), assign::Answer::structure);
    if (!run.has_cells()) continue;
    run.build(grid);
    depth::DepthImage depths = depths_for(*row, frame);
    std::ranges::fill(depths.nearest, std::numeric_limits<float>::infinity());
    run.assign(input_of(frame, lights, depths));
    checks.push_back({row->name + ": tiles of only sky have no list", run.cell_lists().pair_count() == 0, ""});
    depths.nearest[depths.nearest.size() / 2] = 4.0f;
    run.assign(input_of(frame, lights, depths));
    checks.push_back(
        {row->name + ": one pixel is one part of one cell", run.structure()->occupied_cells().parts.size() == 1, ""});
    std::ranges::fill(depths.nearest, 4.0f);
    run.assign(input_of(frame, lights, depths));
    const grid::OccupiedCells cells = run.structure()->occupied_cells();
    const measure::Truth truth = measure::find_truth(frame, grid, cells, 1);
    bool holds_all = truth.undecided == 0 && truth.lists.pair_count() > 0;
    for (std::uint32_t cell = 0; cell < cells.cell_count(); ++cell)
      holds_all = holds_all && std::ranges::includes(run.cell_lists().of(cell), truth.lists.of(cell));
    checks.push_back({row->name + ": where all pixels of a tile are equally deep no light is lost", holds_all, ""});
  }
  return checks;
}

std::vector<ToolCheck> threads_and_broken_cameras(std::uint64_t seed) {
  std::vector<ToolCheck> checks;
  bool same = true;
  for (const grid::GridSpec& spec : grids_of_every_kind()) {
    Trial trial = mixed_lights(seed, false);
    trial.grid = spec;
    const view::Frame frame = frame_of(trial);
    const grid::Grid grid = grid_of(trial, frame);
    same = same && measure::find_truth(frame, grid, 1).lists == measure::find_truth(frame, grid, 4).lists;
  }
  checks.push_back({"true lists are the same with 1 and 4 threads", same, ""});

  Trial broken = mixed_lights(seed, false);
  broken.scene.nodes[0].translation.x = std::numeric_limits<double>::quiet_NaN();
  std::string refusal;
  try {
    const view::Frame frame = frame_of(broken);
    static_cast<void>(grid_of(broken, frame));
  } catch (const Error& error) {
    refusal = error.what();
  }
  checks.push_back({"a camera at NaN is refused with a message", !refusal.empty(), refusal});
  return checks;
}

}  // namespace

std::vector<HardCase> list_cases() {
  return {{"H23", "as many lights at one place as a cell holds, and one more", many_at_one_point, caps_are_counted},
          {"H24", "index pools exactly full", nullptr, pools_hold_their_capacity},
          {"H25", "the same lights in another order; equal depths", in_another_order, order_does_not_matter},
          {"H26", "tiles of only sky, and of one depth", nullptr, depth_masks},
          {"H29", "threads; a camera that is none", nullptr, threads_and_broken_cameras}};
}

}  // namespace clusterbench::stress
