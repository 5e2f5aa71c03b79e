#include "run/cases/scene_visible_sets.h"

#include <algorithm>

namespace clusterbench::run {

std::shared_ptr<const cull::VisibleSets> SceneVisibleSets::of(const scene::CameraPath& path,
                                                              const cull::VisibleSetStep& step, std::uint64_t seed,
                                                              int threads) {
  std::vector<Eye> eyes;
  for (const scene::Shot& shot : path.shots) eyes.push_back({shot.time_s, shot.pose.eye});
  const std::lock_guard one_at_a_time(building_);
  const auto found = std::ranges::find_if(
      kept_, [&](const Kept& kept) { return kept.eyes == eyes && kept.step == step && kept.seed == seed; });
  if (found != kept_.end()) return found->sets;
  auto sets = std::make_shared<const cull::VisibleSets>(scene_, geometry_, path, step, seed, threads);
  kept_.push_back({std::move(eyes), step, seed, sets});
  return sets;
}

}  // namespace clusterbench::run
