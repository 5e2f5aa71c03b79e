#pragma once
// The scenes of a run as they are measured: loaded, with the frames of each camera path chosen.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "run/cases/frame_depths.h"
#include "run/cases/path_lights.h"
#include "run/cases/scene_visible_sets.h"
#include "scene/camera_path.h"
#include "scene/geometry.h"
#include "scene/scene.h"

namespace clusterbench::run {

struct SceneData {
  scene::Scene scene;
  std::vector<scene::CameraPath> paths;
  std::vector<double> lights_at_points = {};     // run/cases/frame_work.h, of each path; empty if nothing depends on it
  int requested_frames = 0, equal_steps = 0;     // set if the path has fewer equal steps than requested
  std::optional<scene::Geometry> geometry = {};  // read only if something needs triangles
  bool counts_triangles = false;                 // something else than readings does: they are part of the contents
  // Depths of these triangles, for all cameras, viewports and grids; null without triangles. Refers to this plan's
  // scene: a plan is moved, never copied.
  std::shared_ptr<FrameDepths> depths = {};
  std::shared_ptr<SceneVisibleSets> visible_sets = {};  // like depths
  // Of this scene's lights and paths, which do not change any more once something has asked for it.
  std::shared_ptr<PathLightsOfScene> path_lights = std::make_shared<PathLightsOfScene>();
  // The lowest height of the lights, and of points 1.7 m below the eyes, over the paths' frames; set if a floor is
  // requested.
  std::optional<double> lowest_m = {};

  bool has_triangles() const { return geometry && !geometry->empty(); }
  // Why its surfaces cannot be seen: "the scene has no triangles", or that this build lacks Embree; "" if they can.
  std::string surface_obstacle() const;
  bool has_lights(scene::LightType type) const;

  // Hash of all contents read from its file.
  std::string contents_sha256() const;
};

// The scenes of files, each read once and kept beside the plans that use it.
class SceneFiles {
 public:
  scene::Scene scene(const config::SceneRequest& request);

 private:
  struct ReadScene {
    std::filesystem::path path;
    scene::GltfChoice choice;
    scene::Scene scene;
  };
  std::vector<ReadScene> read_;
};

// One per scene of the configuration, in its order. Names of scenes, and of the cameras of a scene, are unique and
// without slashes. Reads triangles only if something in the configuration needs them. Throws Error for a file that
// cannot be read, and for lights or cameras outside of the domain (geom/shapes/domain.h).
std::vector<SceneData> load_scenes(const config::Config& config, SceneFiles* files = nullptr);

// Whether a grid's slices follow the visible surfaces, which needs triangles.
bool follows_surfaces(const grid::GridSpec& grid);

// The height of the floor on which a scene's opaque samples lie; none if it has triangles or no floor is requested.
std::optional<double> ground_height(const config::SampleSetRequest& request, const SceneData& data);

}  // namespace clusterbench::run
