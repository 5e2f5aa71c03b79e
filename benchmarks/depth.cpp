// Depth of one 1080p picture by ray casting: of a made terrain of 100,000 triangles, and of real maps where
// CLUSTERBENCH_SCENE_LIBRARY names their folder. Arguments: threads.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "benchmarks.h"
#include "core/random.h"
#include "depth/ray_caster.h"
#include "scene/camera_path.h"
#include "scene/geometry.h"
#include "scene/scene.h"

namespace clusterbench {
namespace {

constexpr Vec2i k_viewport{1920, 1080};

struct Stage {
  scene::Scene scene;
  scene::Geometry geometry;
  view::Frame frame;
};

// Hills of 224 x 224 squares, each of two triangles, seen from above one side; all pixels but the sky's meet them.
std::unique_ptr<Stage> terrain() {
  constexpr std::uint32_t k_squares = 224;
  auto out = std::make_unique<Stage>();
  scene::Surface hills;
  SplitMix64 random(1);
  for (std::uint32_t z = 0; z <= k_squares; ++z)
    for (std::uint32_t x = 0; x <= k_squares; ++x)
      hills.vertices.emplace_back(static_cast<float>(x) - 112.0f,
                                  static_cast<float>(4.0 * std::sin(0.1 * x) * std::cos(0.07 * z) + random.unit()),
                                  -static_cast<float>(z));
  hills.double_sided = true;
  for (std::uint32_t z = 0; z < k_squares; ++z)
    for (std::uint32_t x = 0; x < k_squares; ++x) {
      const std::uint32_t at = z * (k_squares + 1) + x, behind = at + k_squares + 1;
      hills.triangles.push_back({at, at + 1, behind});
      hills.triangles.push_back({at + 1, behind + 1, behind});
    }
  out->geometry.surfaces.push_back(std::move(hills));
  out->scene.nodes.emplace_back();
  out->geometry.instances.push_back({.surface = 0, .node = 0, .shown_by = 0});
  out->frame.view_space.origin = {0.0, 12.0, 4.0};
  out->frame.projection = {false, -1.0264, 1.0264, -0.8, 0.3547, 0.1, 1000.0};
  return out;
}

std::unique_ptr<Stage> stage_of(const std::string& file) {
  auto out = std::make_unique<Stage>();
  out->scene = scene::load_gltf(file);
  scene::resolve_ranges(out->scene, {});
  out->geometry = scene::load_geometry(out->scene);
  const scene::CameraPath path = scene::camera_paths(out->scene, {}).front();
  out->frame = view::make_frame(out->scene, path.shots[path.shots.size() / 3], 0, k_viewport);
  return out;
}

void picture(benchmark::State& state, std::unique_ptr<Stage> stage) {
  stage->frame.viewport = k_viewport;
  depth::RayCaster caster(stage->scene, stage->geometry);
  caster.pose(stage->frame);
  std::size_t seen = 0;
  for (auto _ : state) {
    const depth::DepthImage image =
        caster.depths(stage->frame, depth::PixelGrid(k_viewport, 1), static_cast<int>(state.range(0)));
    seen = 0;
    for (const float depth : image.nearest) seen += std::isfinite(depth) ? 1 : 0;
  }
  state.counters["triangles"] = static_cast<double>(stage->geometry.triangle_count());
  state.counters["seen"] = static_cast<double>(seen) / (k_viewport.x * k_viewport.y);
}

// What is paid once where surfaces do not move.
void build(benchmark::State& state, std::unique_ptr<Stage> stage) {
  stage->frame.viewport = k_viewport;
  for (auto _ : state) {
    depth::RayCaster caster(stage->scene, stage->geometry);
    caster.pose(stage->frame);
  }
}

}  // namespace

void register_depth() {
  const auto add = [](const std::string& name, auto&& stage) {
    benchmark::RegisterBenchmark(("depth/" + name + "/build").c_str(),
                                 [=](benchmark::State& state) { build(state, stage()); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    benchmark::RegisterBenchmark(("depth/" + name + "/1080p").c_str(),
                                 [=](benchmark::State& state) { picture(state, stage()); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Arg(1)
        ->Arg(2);
  };
  add("terrain", terrain);
  const char* library = std::getenv("CLUSTERBENCH_SCENE_LIBRARY");
  for (const char* map : {"oacmp-maps/oacmpctf3.glb", "nexuiz-maps/desertfactory.glb", "quake1-maps/e3m6.glb"}) {
    const std::string file = (library == nullptr ? "" : library) + std::string("/") + map;
    if (std::filesystem::exists(file))
      add(std::filesystem::path(map).stem().string(), [file] { return stage_of(file); });
  }
}

}  // namespace clusterbench
