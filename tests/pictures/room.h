#pragma once
// A wall before a camera, points and spots beside it, and what a configuration makes of them.

#include <atomic>

#include "assign/contract/storage.h"
#include "pictures/pictures.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_frames.h"
#include "scene/mesh_fixture.h"

namespace clusterbench::pictures::test {

using Json = nlohmann::json;

// The wall fills the middle of the picture, 8 m before the eye; its lower half leans away.
inline std::string room(bool with_wall = true) {
  scene::test::MeshFile file;
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"range", 3}},
      {{"type", "spot"}, {"range", 6}, {"spot", {{"outerConeAngle", 0.4}}}},
      {{"type", "point"}, {"range", 9}}};
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}, {"zfar", 100}}}}};
  file.node({{"camera", 0}, {"name", "eye"}});
  const auto light = [&](int index, const Json& at) {
    file.node({{"translation", at}, {"extensions", {{"KHR_lights_punctual", {{"light", index}}}}}});
  };
  for (int i = 0; i < 12; ++i) light(0, {-4.0 + 0.7 * i, -1.0 + 0.3 * (i % 5), -7.5});
  for (int i = 0; i < 5; ++i) light(1, {-2.0 + i, 0.2 * i, -4.0});
  light(2, {0, 0, -1});
  if (with_wall)
    file.node(
        {{"mesh",
          file.mesh(
              {{"attributes",
                {{"POSITION",
                  file.positions({{-3, -2, -11}, {3, -2, -11}, {-3, 0, -8}, {3, 0, -8}, {-3, 2, -8}, {3, 2, -8}})}}},
               {"mode", 5}})}});
  return file.text();
}

struct Room {
  config::Config config;
  run::Plan plan;
  Geometries geometries;
};

inline Room room_of(const std::string& scene, const std::string& assigners = R"("aabb")",
                    const std::string& rest = "") {
  const scene::test::Folder folder;
  folder.write("room.gltf", scene);
  Room out;
  out.config = config::parse_config(
      R"({"scenes": ["room.gltf"], "viewport": [64, 48], "timing": {"measure": false}, "grids": [{"tiles": {"count": [8, 8]},
          "slices": {"scheme": "exponential", "count": 8, "near": 0.1, "far": 40}}], "assigners": [)" +
          assigners + "]" + rest + "}",
      folder.path() / "c.json");
  out.plan = run::make_plan(out.config, "");
  out.geometries = load_geometries(out.config, out.plan, {});
  return out;
}

// The first group's first frame and the light structure of its first case.
struct Looked {
  view::Frame frame;
  grid::Grid grid;
  Surface surface;
  std::unique_ptr<assign::AssignerRun> method;
  std::unique_ptr<assign::Storage> storage;

  const assign::LightStructure& structure() const { return storage ? *storage : *method->structure(); }
};

inline Looked look_at(const Room& room, int divisor = 1) {
  const run::GroupPlan& group = room.plan.groups.front();
  const run::SceneData& data = room.plan.scenes.front();
  run::FrameDepths depths(data.scene, *room.geometries.front());
  const run::PathFrames path(data.scene, data.paths.front(), room.config.viewports.front(), &depths);
  Looked out;
  out.frame = path.frame(0);
  run::GridOfFrames grids(room.config.grids.front());
  grids.update(path, out.frame);
  out.grid = grids.grid();
  out.surface = visible_surface(
      out.frame, depth::thinned(*path.depths()->of(out.frame, 1), depth::PixelGrid(out.frame.viewport, divisor)));
  const run::FrameLights lights(room.config.precisions,
                                view::lights_in(out.frame, grid::space_of(out.grid, out.frame)));
  out.method = std::make_unique<assign::AssignerRun>(run::start_method(room.config, group.cases.front().method()));
  out.method->build(out.grid, assign::kinds_of(lights.in_precision(0)));
  out.method->assign({out.frame, lights.in_precision(0)});
  if (group.cases.front().storage) {
    const config::MethodRequest& request = room.config.storages[*group.cases.front().storage];
    out.storage = assign::find_storage(request.name)->make(request.params);
    out.storage->start(out.grid, out.frame.ranges());
    out.storage->store(*out.method->filled_lists());
  }
  return out;
}

inline Request all_kinds() {
  Request request;
  for (const KindName& row : k_kind_names) request.kinds.push_back(row.kind);
  return request;
}

// By file name.
inline std::map<std::string, std::string> pictures_of(const Room& room, const Request& request,
                                                      const LongestLists& longest = {},
                                                      std::vector<std::string>* skipped = nullptr) {
  std::map<std::string, std::string> out;
  Listener listener;
  listener.on_picture = [&](const Picture& picture) {
    if (!out.emplace(picture.file.string(), picture.png).second) out["twice: " + picture.file.string()];
  };
  listener.on_skipped = [&](const std::string& name, const std::string& reason) {
    if (skipped != nullptr) skipped->push_back(name + ": " + reason);
  };
  const std::atomic<bool> stop = false;
  draw_pictures(room.config, room.plan, room.geometries, request, longest, listener, stop);
  return out;
}

}  // namespace clusterbench::pictures::test
