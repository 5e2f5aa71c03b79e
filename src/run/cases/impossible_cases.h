#pragma once
// The reasons why a combination of a configuration's axes cannot be measured in a scene. Each function whose name ends
// in _obstacle returns the reason in words, or "" if nothing prevents the measurement.

#include <cstdint>
#include <optional>
#include <string>

#include "config/config.h"
#include "run/cases/light_reach.h"
#include "run/cases/scene_data.h"
#include "view/frame.h"

namespace clusterbench::run {

// Facts about the first frame of a path in a grid. They decide for all frames of the path.
struct FirstFrame {
  std::uint32_t cells = 0;
  view::LightRanges lights;
  std::optional<grid::Grid> grid = {};
  std::string obstacle =
      {};  // the reason why the grid cannot be made for this path; the other members are then not set
};

// The first frame of a path in a viewport, made once for all grids. The scene must outlive it.
class FirstView {
 public:
  FirstView(const SceneData& data, const scene::CameraPath& path, Vec2i viewport);

  FirstFrame in(const grid::GridSpec& spec) const;

 private:
  const SceneData& data_;
  std::optional<view::Frame> frame_;
  LightReach reach_;      // of the frame
  std::string obstacle_;  // the reason why there is no frame
};

// The reason why a method cannot run on a grid of this kind with the scene's lights, with its triangles, with an
// orthographic camera if `orthographic` is set, or on this machine.
std::string method_obstacle(const config::MethodRequest& request, grid::Kind kind, const SceneData& data,
                            bool orthographic);
// The reason why a method cannot run on this grid, though on others of its kind.
std::string fit_obstacle(const assign::AssignerDescriptor& assigner, const FirstFrame& first);
// The reason why a method is skipped that would test more pairs of light and cell than limits.all_pairs allows.
std::string limit_obstacle(const assign::AssignerDescriptor& assigner, const config::LimitsRequest& limits,
                           const FirstFrame& first);
// The reason why a method cannot run with lights in this precision.
std::string precision_obstacle(const assign::AssignerDescriptor& assigner, const config::PrecisionRequest& precision,
                               const SceneData& data);
// The reason why a pre-cull cannot run on the scene's lights or without triangles.
std::string pre_cull_obstacle(const cull::PreCullSpec& pre_cull, const SceneData& data);
// The reason why a storage is skipped: for the first frame's cells and lights it would reserve more than
// memory_limit() bytes, or its parameters do not fit them.
std::string storage_obstacle(const config::MethodRequest& request, const FirstFrame& first);

// The reason why a set of samples cannot be made in the scene: it needs triangles
// (or a ground), or lights that have an end.
std::string set_obstacle(const config::SampleSetRequest& request, const SceneData& data);
// The reason why the scene's lights have no shadow maps.
std::string shadow_obstacle(const SceneData& data);

}  // namespace clusterbench::run
