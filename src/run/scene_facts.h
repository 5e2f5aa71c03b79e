#pragma once
// What a result tells of a scene, known before anything is measured.

#include <vector>

#include "run/result.h"
#include "run/sweep.h"

namespace clusterbench::run {

SceneResult scene_result(const SceneData& data, const config::SceneRequest& request,
                         const std::vector<Vec2i>& viewports);

}  // namespace clusterbench::run
