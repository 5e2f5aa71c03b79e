#pragma once
// The lights of a result's scene, and whether they differ from another result's.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// "248 points, 52 spots"; "248 points, 12 of them dark"; "no lights".
std::string lights_text(const result::Scene& scene);

enum class LightChange {
  none,
  changed,
  unknown  // the counts are equal, and one of the results is older than the digest of lights
};
LightChange light_change(const result::Scene& base_scene, const result::Scene& next_scene);

// The base's scene of this name; if each result has only one scene, that one. Null: none.
const result::Scene* scene_before(const result::Result& base, const result::Result& next,
                                  const result::Scene& next_scene);

// Null for an unknown name.
const result::Scene* scene_named(const std::vector<result::Scene>& scenes, const std::string& name);

}  // namespace clusterbench::report
