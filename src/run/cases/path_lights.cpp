#include "run/cases/path_lights.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/work_in_order.h"
#include "grid/lights_in_view.h"
#include "scene/digests.h"

namespace clusterbench::run {

std::size_t PathLights::bytes() const {
  std::size_t sum = in_view.size() * sizeof(in_view[0]);
  for (const std::vector<bool>& frame : in_view) sum += frame.size() / 8;
  return sum + (lights ? lights->size() * sizeof(scene::WorldLight) : 0);
}

view::Frame frame_of_shot(const scene::Scene& scene, const scene::CameraPath& path, int shot, Vec2i viewport,
                          const std::vector<scene::WorldLight>* lights) {
  const scene::Shot& at = path.shots[static_cast<std::size_t>(shot)];
  return lights != nullptr ? view::make_frame(scene, at, shot, viewport, *lights)
                           : view::make_frame(scene, at, shot, viewport);
}

PathLights path_lights(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport, int threads,
                       std::size_t most_bytes) {
  PathLights out;
  const std::size_t frames = path.shots.size();
  if (frames == 0) return out;
  view::Frame first = frame_of_shot(scene, path, 0, viewport, nullptr);
  out.shape = first.projection;
  if (frames <= most_bytes / (first.lights.size() / 8 + sizeof(std::vector<bool>))) out.in_view.resize(frames);
  if (!scene::lights_change(scene))
    out.lights = std::make_shared<const std::vector<scene::WorldLight>>(std::move(first.lights));
  std::mutex adding;
  constexpr int k_frames_at_once = 8;
  ranges_in_order(threads, static_cast<int>(frames), k_frames_at_once, [&](int begin, int end) {
    LightReach reach;
    for (int i = begin; i < end; ++i) {
      const view::Frame frame = frame_of_shot(scene, path, i, viewport, out.lights.get());
      std::vector<bool> in_view = grid::lights_in_view(frame);
      reach.add(frame, in_view);
      if (!out.in_view.empty()) out.in_view[static_cast<std::size_t>(i)] = std::move(in_view);
    }
    const std::lock_guard lock(adding);
    out.reach.add(reach);
  });
  return out;
}

std::shared_ptr<const PathLights> PathLightsOfScene::of(const scene::Scene& scene, const scene::CameraPath& path,
                                                        std::size_t camera, Vec2i viewport, int threads) {
  const std::lock_guard lock(finding_);
  const auto known =
      std::ranges::find_if(kept_, [&](const Kept& kept) { return kept.camera == camera && kept.viewport == viewport; });
  if (known != kept_.end()) return known->lights;
  ++times_found_;
  const auto found = std::make_shared<const PathLights>(path_lights(scene, path, viewport, threads));
  kept_.push_back({camera, viewport, found});
  std::size_t bytes = 0;
  for (const Kept& kept : kept_) bytes += kept.lights->bytes();
  for (; kept_.size() > 1 && bytes > PathLights::k_most_bytes; kept_.pop_front())
    bytes -= kept_.front().lights->bytes();
  return found;
}

}  // namespace clusterbench::run
