#pragma once
// What a result tells of a scene, known before anything is measured.

#include <string>
#include <vector>

#include "run/cases/sweep.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

SceneResult scene_result(const SceneData& data, const config::SceneRequest& request,
                         const std::vector<Vec2i>& viewports);

// Of the scene's measured cameras, those that have no field of view for a request to set; "" where none is asked for or
// all have one: "--fov changes nothing ...".
std::string without_field_of_view(const SceneData& data, const config::SceneRequest& request);

// "195 of 200 lights are dark ..."; "" where none is. Engines cull such lights; methods here get those that have a
// range.
std::string dark_lights(const SceneData& data);

// That it is measured in fewer frames than asked for, and why; "" where it is not.
std::string fewer_frames(const SceneData& data);

}  // namespace clusterbench::run
