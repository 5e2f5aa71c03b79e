#pragma once
// Why a combination of a configuration's axes cannot be measured in a scene. Each function returns the reason in words,
// "" if there is none.

#include <cstdint>
#include <string>

#include "config/config.h"
#include "run/cases/scene_data.h"
#include "view/frame.h"

namespace clusterbench::run {

// The first frame of a path in a grid. It decides for the whole path.
struct FirstFrame {
  std::uint32_t cells = 0;
  view::LightRanges lights;
  std::string obstacle;  // why this path has no such grid; then the other members are not set
};
FirstFrame first_frame(const grid::GridSpec& spec, const SceneData& data, const scene::CameraPath& path,
                       Vec2i viewport);

// Of a method in a grid of this kind.
std::string method_obstacle(const config::MethodRequest& request, grid::Kind kind, const SceneData& data,
                            bool orthographic);
// Of a method that would test more pairs of light and cell than limits.all_pairs allows.
std::string limit_obstacle(const assign::AssignerDescriptor& assigner, const config::LimitsRequest& limits,
                           const FirstFrame& first);
// Of a method with lights in this precision.
std::string precision_obstacle(const assign::AssignerDescriptor& assigner, const config::PrecisionRequest& precision,
                               const SceneData& data);
std::string pre_cull_obstacle(const cull::PreCullSpec& pre_cull, const SceneData& data);
// Of a storage that cannot hold lists of this many cells and lights within memory_limit().
std::string storage_obstacle(const config::MethodRequest& request, const FirstFrame& first);

std::string set_obstacle(const config::SampleSetRequest& request, const SceneData& data);
// Of shadow maps of the scene's lights.
std::string shadow_obstacle(const SceneData& data);

}  // namespace clusterbench::run
