#pragma once
// Notes of a result about a scene, known before anything is measured.

#include <string>
#include <vector>

#include "run/cases/scene_data.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

SceneResult scene_result(const SceneData& data, const config::SceneRequest& request,
                         const std::vector<Vec2i>& viewports, int threads);

// The measured cameras of a scene without a field of view that a request could set; "" if no field of view is requested
// or all cameras have one: "--fov changes nothing ...".
std::string without_field_of_view(const SceneData& data, const config::SceneRequest& request);

// "195 of 200 lights are dark ..."; "" if none is. Engines cull such lights; methods here get those that have a range.
std::string dark_lights(const SceneData& data);

// That the scene is measured in fewer frames than requested, and why; "" if it is not.
std::string fewer_frames(const SceneData& data);

}  // namespace clusterbench::run
