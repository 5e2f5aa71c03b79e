#include "run/cases/path_lights.h"

#include <algorithm>
#include <utility>

#include "core/work_in_order.h"
#include "grid/lights_in_view.h"
#include "scene/digests.h"
#include "scene/domain_check.h"

namespace clusterbench::run {
namespace {

// Of one frame, with what the allocator adds.
std::size_t bytes_of(std::size_t lights) {
  return sizeof(std::vector<bool>) + 16 + (lights / 64 + 1) * 8;
}

}  // namespace

SharedLights find_static_lights(const scene::Scene& scene, double time_s) {
  if (scene::lights_change(scene)) return nullptr;
  std::vector<scene::WorldLight> lights = scene::world_lights(scene, time_s);
  scene::check_domain(scene, lights, time_s);
  return std::make_shared<const std::vector<scene::WorldLight>>(std::move(lights));
}

std::size_t PathLights::bytes_in_view() const {
  return in_view.empty() ? 0 : in_view.size() * bytes_of(in_view.front().size());
}

view::Frame frame_of_shot(const scene::Scene& scene, const scene::CameraPath& path, int shot, Vec2i viewport,
                          const SharedLights& static_lights) {
  const scene::Shot& at = path.shots[static_cast<std::size_t>(shot)];
  return static_lights ? view::make_frame(scene, at, shot, viewport, *static_lights)
                       : view::make_frame(scene, at, shot, viewport);
}

PathLights path_lights(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport,
                       const SharedLights& static_lights, int threads, std::size_t most_bytes) {
  PathLights out;
  out.static_lights = static_lights;
  const std::size_t frames = path.shots.size();
  if (frames == 0) return out;
  const view::Frame first = frame_of_shot(scene, path, 0, viewport, static_lights);
  out.shape = first.projection;
  if (frames <= most_bytes / bytes_of(first.lights.size())) out.in_view.resize(frames);
  std::mutex adding;
  constexpr int k_frames_at_once = 8;
  ranges_in_order(threads, static_cast<int>(frames), k_frames_at_once, [&](int begin, int end) {
    LightReach reach;
    for (int i = begin; i < end; ++i) {
      const view::Frame frame = frame_of_shot(scene, path, i, viewport, static_lights);
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
  const std::shared_ptr<View> view = view_of(camera, viewport);
  const std::lock_guard one_at_a_time(view->finding);
  if (view->found) return view->found;
  auto found =
      std::make_shared<const PathLights>(path_lights(scene, path, viewport, static_lights_of(scene, path), threads));
  const std::lock_guard lock(changing_);
  ++times_found_;
  view->found = found;
  drop_oldest();
  return found;
}

std::shared_ptr<PathLightsOfScene::View> PathLightsOfScene::view_of(std::size_t camera, Vec2i viewport) {
  const std::lock_guard lock(changing_);
  const auto known = std::ranges::find_if(
      kept_, [&](const std::shared_ptr<View>& view) { return view->camera == camera && view->viewport == viewport; });
  if (known != kept_.end()) return *known;
  kept_.push_back(std::make_shared<View>());
  kept_.back()->camera = camera;
  kept_.back()->viewport = viewport;
  return kept_.back();
}

SharedLights PathLightsOfScene::static_lights_of(const scene::Scene& scene, const scene::CameraPath& path) {
  const std::lock_guard lock(changing_);
  if (!knows_static_lights_ && !path.shots.empty()) {
    static_lights_ = find_static_lights(scene, path.shots.front().time_s);
    knows_static_lights_ = true;
  }
  return static_lights_;
}

void PathLightsOfScene::drop_oldest() {
  const auto bytes_of = [](const std::shared_ptr<View>& view) {
    return view->found ? view->found->bytes_in_view() : std::size_t{0};
  };
  std::size_t bytes = 0;
  for (const std::shared_ptr<View>& view : kept_) bytes += bytes_of(view);
  for (; kept_.size() > 1 && bytes > most_bytes_; kept_.pop_front()) bytes -= bytes_of(kept_.front());
}

}  // namespace clusterbench::run
