// One frame of the workloads on which the best public implementations were measured, of `CLUSTERBENCH_SCENE_LIBRARY`:
// every assigner, and `brute`, the plain loop of every light against every cell's box that those measurements take as
// their unit.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <string>

#include "assign/contract/assigner.h"
#include "assign/contract/assigner_run.h"
#include "benchmarks.h"
#include "geom/single_precision/bounding_volumes.h"
#include "setting.h"

namespace clusterbench {
namespace {

using grid::Scheme;

struct Workload {
  const char* name;
  Vec2i tiles;
  grid::Slicing slices;
  float range_m = 0.0f;  // of all lights, if not 0
  const char* file = name;
};

const std::array<Workload, 7> k_workloads{{
    {"W1", {12, 12}, {.scheme = Scheme::exponential, .count = 24, .near_m = 0.1, .far_m = 400, .boundaries_m = {}}},
    {"W1-60m",
     {12, 12},
     {.scheme = Scheme::exponential, .count = 24, .near_m = 0.1, .far_m = 400, .boundaries_m = {}},
     60.0f,
     "W1"},
    {"W2", {12, 12}, {.scheme = Scheme::exponential, .count = 24, .near_m = 0.1, .far_m = 400, .boundaries_m = {}}},
    {"W3", {12, 12}, {.scheme = Scheme::exponential, .count = 24, .near_m = 0.1, .far_m = 400, .boundaries_m = {}}},
    {"W4", {12, 12}, {.scheme = Scheme::exponential, .count = 24, .near_m = 0.1, .far_m = 400, .boundaries_m = {}}},
    {"W5",
     {30, 17},
     {.scheme = Scheme::exponential_first, .count = 16, .near_m = 0.1, .first_m = 5, .far_m = 500, .boundaries_m = {}}},
    {"W7", {32, 18}, {.scheme = Scheme::exponential, .count = 64, .near_m = 0.1, .far_m = 120, .boundaries_m = {}}},
}};

grid::GridSpec spec_of(const Workload& workload) {
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, workload.tiles};
  spec.slices = workload.slices;
  return spec;
}

void assign_frame(benchmark::State& state, const Setting& setting, const assign::AssignerDescriptor& row) {
  const assign::Params params(row.params);
  assign::AssignerRun run(row, params, assign::answers_with_cells(row, params).front());
  run.build(setting.grid);
  for (auto _ : state) run.assign({setting.frame, setting.lights});
  state.counters["pairs"] = run.cell_lists().pair_count();
}

// Cell by cell, light by light, with boxes made beforehand.
void brute_frame(benchmark::State& state, const Setting& setting) {
  std::vector<geom::Box> boxes;
  for (std::uint32_t cell = 0; cell < setting.grid.cell_count(); ++cell)
    boxes.push_back(geom::box_around(std::get<geom::FrustumCell>(setting.grid.cell(cell))));
  const view::LightArrays& lights = setting.lights;
  std::vector<std::uint32_t> begin(boxes.size() + 1), list(1u << 20);
  std::uint32_t pairs = 0;
  for (auto _ : state) {
    pairs = 0;
    for (std::size_t cell = 0; cell < boxes.size(); ++cell) {
      begin[cell] = pairs;
      const Vec3f lo = boxes[cell].lo, hi = boxes[cell].hi;
      for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const float x = std::max(0.0f, std::max(lo.x - lights.x[i], lights.x[i] - hi.x));
        const float y = std::max(0.0f, std::max(lo.y - lights.y[i], lights.y[i] - hi.y));
        const float z = std::max(0.0f, std::max(lo.z - lights.z[i], lights.z[i] - hi.z));
        if (x * x + y * y + z * z <= lights.radius[i] * lights.radius[i]) list[pairs++] = i;
      }
    }
    benchmark::DoNotOptimize(list.data());
  }
  state.counters["pairs"] = pairs;
}

}  // namespace

void register_peers() {
  for (const Workload& workload : k_workloads) {
    const std::string file = peer_workload(workload.file);
    const std::string prefix = std::string("peers/") + workload.name + "/";
    const auto add = [&](const std::string& name, auto&& frame) {
      benchmark::RegisterBenchmark((prefix + name).c_str(), [=](benchmark::State& state) {
        frame(state, make_setting(file, spec_of(workload), 0.0, workload.range_m));
      })->Unit(benchmark::kMicrosecond);
    };
    add("brute", [](benchmark::State& state, const Setting& setting) { brute_frame(state, setting); });
    for (const assign::AssignerDescriptor* row : assign::assigner_descriptors())
      if (!row->naive && !row->needs.depth && row->takes(grid::Kind::frustum))
        add(row->name, [row](benchmark::State& state, const Setting& setting) { assign_frame(state, setting, *row); });
  }
}

}  // namespace clusterbench
