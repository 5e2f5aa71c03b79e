#pragma once
// Which lights a result's scene has, and whether they are another one's.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Of a result's scene: "248 points, 52 spots"; "248 points, 12 of them dark"; "no lights".
std::string lights_text(const result::Scene& scene);

enum class LightChange {
  none,
  changed,
  unknown  // as many of each kind, and one of the results is older than the digest of lights
};
LightChange light_change(const result::Scene& base_scene, const result::Scene& next_scene);

// The base's scene of this name; where each result has one scene alone, that one. Null: none.
const result::Scene* scene_before(const result::Result& base, const result::Result& next,
                                  const result::Scene& next_scene);

// Null: there is none of this name.
const result::Scene* scene_named(const std::vector<result::Scene>& scenes, const std::string& name);

}  // namespace clusterbench::report
