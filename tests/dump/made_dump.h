#pragma once
// A frame of a random rig in a small grid, and dumps of lists for it.

#include <algorithm>
#include <string>

#include "assign/contract/storage.h"
#include "dump/judge.h"
#include "dump/write_dump.h"
#include "measure/truth/truth.h"
#include "scene/rig.h"

namespace clusterbench::dump::testing {

struct Made {
  view::Frame frame;
  grid::Grid grid;
  assign::Lists truth;
};

inline Made made_frame(grid::Tiling tiles = {{0, 0}, {12, 7}, 0.0}) {
  scene::Scene scene = scene::make_rig({.lights = 200, .spots = 0.3, .range_m = 4.0, .size_m = {40.0, 10.0, 40.0}});
  scene::resolve_ranges(scene, {});
  const scene::Camera& camera = scene.cameras.front();
  const scene::Shot shot{0.0, scene::camera_pose(scene, camera, 0.0), scene::projection_at(scene, camera, 0.0)};
  Made out;
  out.frame = view::make_frame(scene, shot, 0, {1280, 720});
  // Askew, so that no axis of the world is one of the camera.
  const Vec3d back = glm::normalize(Vec3d{0.3, 0.1, 0.9}), right = glm::normalize(glm::cross(Vec3d{0.1, 1, 0}, back));
  out.frame.view_space.rotation = glm::transpose(Mat3d(right, glm::cross(back, right), back));
  grid::GridSpec spec;
  spec.tiles = tiles;
  spec.slices = {.scheme = grid::Scheme::exponential, .count = 10, .near_m = 0.5, .far_m = 50.0, .boundaries_m = {}};
  out.grid = grid::make_grid(spec, grid::grid_inputs(spec, out.frame, 50.0, Vec3d(0.0), Vec3d(0.0)));
  out.truth = measure::find_truth(out.frame, out.grid, 1).lists;
  return out;
}

inline layout::Described described(const assign::Lists& lists, const view::LightRanges& lights,
                                   const std::string& storage = "packed") {
  const assign::StorageDescriptor* row = assign::find_storage(storage);
  const auto made = row->make(assign::Params(row->params));
  made->start(lists.cell_count(), lights);
  made->store(lists);
  return *layout::describe(*made->shader_buffers());
}

inline DumpFile dump_of(const Made& made, const assign::Lists& lists, const layout::CellOrder& order = {}) {
  MadeDump dump = make_dump(made.frame, made.grid,
                            described(layout::in_order(lists, made.grid.cells(), order), made.frame.ranges()), order);
  return {"made.json", std::move(dump.record), std::move(dump.buffers)};
}

inline result::CheckedSet verdict_on(const DumpFile& dump) {
  return judge(dump, {}).sets.front();
}

// The new cell and light of a pair; none: it is removed.
using Moved = std::optional<std::pair<std::uint32_t, std::uint32_t>>;

// Each pair through change(cell, light).
template <class Change>
assign::Lists changed(const assign::Lists& lists, Change&& change) {
  std::vector<std::vector<std::uint32_t>> cells(lists.cell_count());
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
    for (const std::uint32_t light : lists.of(cell))
      if (const Moved to = change(cell, light)) cells[to->first].push_back(to->second);
  assign::Lists out;
  out.begin.push_back(0);
  for (std::vector<std::uint32_t>& cell : cells) {
    std::ranges::sort(cell);
    out.lights.insert(out.lights.end(), cell.begin(), cell.end());
    out.begin.push_back(static_cast<std::uint32_t>(out.lights.size()));
  }
  return out;
}

// One frame for all tests that do not change it.
inline const Made& made() {
  static const Made frame = made_frame();
  return frame;
}

struct Deepest {
  std::uint32_t cell = 0, light = 0;
  double reach = -1.0;
};

// Where a light reaches deepest into a cell without being all around it.
inline Deepest deepest_pair() {
  Deepest out;
  for (std::uint32_t cell = 0; cell < made().truth.cell_count(); ++cell)
    for (const std::uint32_t light : made().truth.of(cell)) {
      const double reach = 1.0 - measure::relative_distance(made().frame, made().grid, cell, light);
      if (reach > out.reach) out = {cell, light, reach};
    }
  return out;
}

}  // namespace clusterbench::dump::testing
