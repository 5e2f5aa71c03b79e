#include "report/cases/scene_lights.h"

#include <algorithm>
#include <cstdint>

#include "core/text.h"
#include "report/cases/nothing_seen.h"

namespace clusterbench::report {
namespace {

using result::Result;
using result::Scene;
using result::SceneLights;

bool are_as_many(const Scene& a, const Scene& b) {
  const SceneLights &some = a.lights, &others = b.lights;
  return some.point == others.point && some.spot == others.spot && some.box == others.box &&
         some.directional == others.directional;
}

}  // namespace

const Scene* scene_named(const std::vector<Scene>& scenes, const std::string& name) {
  const auto found = std::ranges::find(scenes, name, &Scene::name);
  return found == scenes.end() ? nullptr : &*found;
}

std::string lights_text(const Scene& scene) {
  const std::uint64_t point = scene.lights.point, spot = scene.lights.spot, box = scene.lights.box;
  std::string text;
  const auto add = [&](std::uint64_t count, const std::string& words) {
    if (count > 0) text += (text.empty() ? "" : ", ") + words;
  };
  add(point, number_of(point, "point"));
  add(spot, number_of(spot, "spot"));
  add(box, box == 1 ? "1 box" : std::to_string(box) + " boxes");
  if (text.empty()) return "no lights";
  const std::uint64_t dark = dark_lights(scene);
  return dark == 0 ? text : text + ", " + std::to_string(dark) + " of them dark";
}

LightChange light_change(const Scene& base_scene, const Scene& next_scene) {
  const std::optional<std::string>&before = base_scene.light_digest, &now = next_scene.light_digest;
  if (before && now) return *before == *now ? LightChange::none : LightChange::changed;
  return are_as_many(base_scene, next_scene) ? LightChange::unknown : LightChange::changed;
}

const Scene* scene_before(const Result& base, const Result& next, const Scene& next_scene) {
  if (base.scenes.size() == 1 && next.scenes.size() == 1) return &base.scenes[0];
  return scene_named(base.scenes, next_scene.name);
}

}  // namespace clusterbench::report
