// Truth per frame on the project's own scenes: 30 x 17 x 16 cells (64 px tiles at 1920 x 1080), one thread.

#include <benchmark/benchmark.h>

#include <string>

#include "benchmarks.h"
#include "measure/truth.h"
#include "scene/camera_path.h"

namespace clusterbench {
namespace {

struct Setting {
  view::Frame frame;
  grid::Grid grid;
};

Setting setting_of(const std::string& name, grid::Kind kind) {
  scene::Scene scene = scene::load_gltf(CLUSTERBENCH_SOURCE_DIR "/scenes/" + name + ".glb");
  scene::resolve_ranges(scene, {});
  const scene::CameraPath path = scene::camera_paths(scene, {}).front();
  Setting setting;
  setting.frame = view::make_frame(scene, path.shots[path.shots.size() / 2], 0, {1920, 1080});
  grid::GridSpec spec;
  spec.kind = kind;
  spec.slices.near_m = 0.1;
  spec.slices.far_m = 500.0;
  setting.grid = grid::make_grid(spec, grid::grid_inputs(spec, setting.frame, 0.0, {-250, -50, -250}, {250, 80, 250}));
  return setting;
}

void find(benchmark::State& state, const std::string& name, grid::Kind kind) {
  const Setting setting = setting_of(name, kind);
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
