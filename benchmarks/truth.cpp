// Truth per frame on the project's own scenes: 30 x 17 x 16 cells (64 px tiles at 1920 x 1080), one thread.

#include <benchmark/benchmark.h>

#include <string>

#include "benchmarks.h"
#include "measure/truth.h"
#include "setting.h"

namespace clusterbench {
namespace {

grid::GridSpec spec_of(grid::Kind kind) {
  grid::GridSpec spec;
  spec.kind = kind;
  spec.slices.near_m = 0.1;
  spec.slices.far_m = 500.0;
  return spec;
}

void find(benchmark::State& state, const std::string& name, grid::Kind kind) {
  const Setting setting = make_setting(own_scene(name), spec_of(kind), 0.5);
  std::uint32_t pairs = 0;
  for (auto _ : state) pairs = measure::find_truth(setting.frame, setting.grid, 1).lists.pair_count();
  state.counters["lights"] = static_cast<double>(setting.frame.lights.size());
  state.counters["cells"] = setting.grid.cell_count();
  state.counters["pairs"] = pairs;
}

}  // namespace

void register_truth() {
  for (const char* name : {"hall-512", "hall-1024", "hall-4096", "open-world", "jam"})
    for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::distance, grid::Kind::cascades, grid::Kind::world})
      benchmark::RegisterBenchmark((std::string("truth/") + name + "/" + grid::kind_name(kind)).c_str(),
                                   [name, kind](benchmark::State& state) { find(state, name, kind); })
          ->Unit(benchmark::kMillisecond);
}

}  // namespace clusterbench
