#include "cli/processes/handover.h"

#include <nlohmann/json.hpp>

#include "config/config_plugins.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "os/call_notes.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* k_no_file = "-";

// The path by which another process can open the file behind this process's stream; null for other paths.
Json path_for_others(const fs::path& path) {
  if (!is_stream_name(path)) return nullptr;
  std::error_code failed;
  const fs::path file = fs::canonical(path, failed);
  return failed ? Json() : Json(file.string());
}

}  // namespace

std::string file_argument(const config::Config& config) {
  return config.file.empty() ? k_no_file : config.file.string();
}

std::string handover_line(const config::Config& config, const run::Plan& plan, std::optional<std::size_t> scene) {
  Json scenes = Json::array();
  for (std::size_t i = scene.value_or(0); i < (scene ? *scene + 1 : config.scenes.size()); ++i)
    scenes.push_back({{"scene_index", i},
                      {"path", path_for_others(config.scenes[i].path)},
                      {"sha256", plan.scenes[i].contents_sha256()}});
  Json plugins = Json::object();
  for (const plugin::LoadedPlugin* loaded : config::plugins_of(config)) plugins[loaded->facts.id] = loaded->sha256;
  return Json{{"config", config.resolved}, {"scenes", scenes}, {"plugins", plugins}, {"notes", os::path_of_notes()}}
      .dump();
}

ReceivedRun received_run(const std::string& line, const std::string& file) {
  const Json given = read_json<Json>(line, file);
  if (const std::string notes = given.value("notes", ""); !notes.empty()) os::join_notes(notes);
  ReceivedRun run{config::parse_config(given["config"].dump(), file == k_no_file ? "" : file), {}};
  for (const plugin::LoadedPlugin* loaded : config::plugins_of(run.config))
    if (given["plugins"].value(loaded->facts.id, "") != loaded->sha256)
      throw Error(loaded->file.string(), "", "has changed since the run began; run again");
  std::vector<config::SceneRequest> scenes;
  for (const Json& scene : given["scenes"]) {
    scenes.push_back(run.config.scenes.at(scene["scene_index"].get<std::size_t>()));
    if (scene["path"].is_string()) scenes.back().path = scene["path"].get<std::string>();
    // Its place would be that in this line, not in the user's configuration.
    if (const fs::path& path = scenes.back().path; !path.empty() && !fs::exists(path))
      throw Error(path.string(), "", "has been removed since the run began; run again");
  }
  run.config.scenes = std::move(scenes);
  run.plan = run::make_plan(run.config, "");
  for (std::size_t i = 0; i < run.plan.scenes.size(); ++i)
    if (run.plan.scenes[i].contents_sha256() != given["scenes"][i]["sha256"].get<std::string>())
      throw Error(run.config.scenes[i].path.string(), "", "has changed since the run began; run again");
  return run;
}

}  // namespace clusterbench::cli
