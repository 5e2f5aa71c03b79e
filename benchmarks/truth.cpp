// Truth per frame on the project's own scenes: 30 x 17 x 16 cells (64 px tiles at 1920 x 1080), one thread.

#include <benchmark/benchmark.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks.h"
#include "core/random.h"
#include "geom/filter/light_filter.h"
#include "geom/light_meets_cell.h"
#include "geom/shapes/verdict.h"
#include "measure/truth/truth.h"
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

// Spots that the filter leaves uncertain against cells, on a lattice or moved off it by roundoffs.
std::vector<std::pair<geom::LightVolume, geom::Cell>> open_spots(const std::string& kind, bool on_lattice) {
  SplitMix64 random(5);
  const auto whole = [&](int lo, int hi) { return lo + static_cast<double>(random.below(std::uint64_t(hi - lo + 1))); };
  std::vector<std::pair<geom::LightVolume, geom::Cell>> found;
  while (found.size() < 500) {
    geom::SpotVolume light;
    light.apex.position = {whole(-8, 8), whole(-8, 8), whole(-12, 8)};
    light.range = whole(1, 12);
    light.direction = {whole(-1, 1), whole(-1, 1), whole(-1, 1)};
    if (light.direction == Vec3d(0.0)) continue;
    light.half_angle_rad = whole(1, 4) * (std::numbers::pi / 8.0);
    if (!on_lattice) light.apex.position += 0x1p-45 * Vec3d(random.unit(), random.unit(), random.unit());
    const auto x = static_cast<float>(0.25 * whole(-4, 3)), y = static_cast<float>(0.25 * whole(-4, 3));
    const auto near = static_cast<float>(whole(0, 6)), far = near + static_cast<float>(whole(1, 6));
    geom::Cell cell = geom::FrustumCell{x, x + 0.5f, y, y + 0.5f, near, far, false};
    if (kind == "shells") cell = geom::ShellCell{x, x + 0.5f, y, y + 0.5f, near, far};
    if (kind == "boxes") cell = geom::Box{{8 * x, 8 * y, -far}, {8 * x + 4, 8 * y + 4, -near}};
    if (geom::filter_meets(light, cell) == geom::Verdict::uncertain) found.emplace_back(light, cell);
  }
  return found;
}

void decide(benchmark::State& state, const std::string& kind, bool on_lattice) {
  const auto pairs = open_spots(kind, on_lattice);
  for (auto _ : state)
    for (const auto& [light, cell] : pairs) benchmark::DoNotOptimize(geom::prove_meets(light, cell));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs.size()));
}

}  // namespace

void register_truth() {
  for (const std::string kind : {"frustum", "shells", "boxes"})
    for (const bool on_lattice : {false, true})
      benchmark::RegisterBenchmark(("decide_spot/" + kind + (on_lattice ? "/lattice" : "/nudged")).c_str(),
                                   [=](benchmark::State& state) { decide(state, kind, on_lattice); })
          ->Unit(benchmark::kMillisecond);
  for (const char* name : {"hall-512", "hall-1024", "hall-4096", "open-world", "jam"})
    for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::distance, grid::Kind::cascades, grid::Kind::world})
      benchmark::RegisterBenchmark((std::string("truth/") + name + "/" + grid::kind_name(kind)).c_str(),
                                   [name, kind](benchmark::State& state) { find(state, name, kind); })
          ->Unit(benchmark::kMillisecond);
}

}  // namespace clusterbench
