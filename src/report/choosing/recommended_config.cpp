#include "report/choosing/recommended_config.h"

#include <algorithm>
#include <filesystem>

#include "config/config_plugins.h"
#include "core/error.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// The configuration's entry of a scene, which can stand for several.
Json scene_json(const config::Config& config, std::size_t scene, const std::string& file) {
  namespace fs = std::filesystem;
  const config::SceneRequest& request = config.scenes[scene];
  const Json resolved = config.resolved["scenes"];
  std::size_t first = 0;
  Json entry;
  for (const Json& candidate : resolved) {
    std::size_t count = candidate.contains("paths") ? candidate["paths"].size() : 1;
    if (candidate.contains("rig"))
      for (const auto& [key, value] : candidate["rig"].items())
        if (value.is_array() && !(key == "size" && value[0].is_number())) count *= value.size();
    if (scene < first + count) {
      entry = candidate;
      break;
    }
    first += count;
  }
  entry.erase("paths");
  if (request.rig) {
    const scene::RigSpec& rig = *request.rig;
    entry["rig"] = {{"lights", rig.lights},
                    {"spots", rig.spots},
                    {"range", rig.range_m},
                    {"size", {rig.size_m.x, rig.size_m.y, rig.size_m.z}},
                    {"seed", rig.seed}};
    return entry;
  }
  const fs::path folder = fs::absolute(file).parent_path();
  entry["path"] =
      fs::absolute(request.path).lexically_normal().lexically_proximate(folder.lexically_normal()).generic_string();
  return entry;
}

void add_once(Json& list, const Json& entry) {
  if (!entry.is_null() && std::ranges::find(list, entry) == list.end()) list.push_back(entry);
}

}  // namespace

Json recommended_config(const config::Config& config, const search::View& view, const result::Answer& answer,
                        const Question& question, int runners_up, const std::string& file) {
  if (!answer.choice)
    throw Error(file, "", "is not written: no candidate satisfies all constraints", ExitCode::gate_failed);
  Json out = config.resolved;
  out["scenes"] = Json::array({scene_json(config, view.scene, file)});
  out["viewports"] = Json::array({Json(answer.viewport)});
  for (const char* key : {"presets", "as_shipped"}) out.erase(key);
  config::name_plugins(config, out);
  for (const char* key : {"grids", "assigners", "storages", "precision"}) out[key] = Json::array();
  for (int i = 0; i <= runners_up && i <= static_cast<int>(answer.runners_up.size()); ++i) {
    const result::Candidate& record = i == 0 ? *answer.choice : answer.runners_up[static_cast<std::size_t>(i) - 1];
    add_once(out["grids"], record.grid);
    add_once(out["assigners"], record.assigner);
    add_once(out["storages"], record.storage);
    add_once(out["precision"], record.precision);
  }
  if (out["storages"].empty()) out["storages"].push_back("packed");  // of lists, which it may have besides
  // Of a method that leaves lists and a structure of its own only the choice has to hold.
  const assign::AssignerDescriptor& method = *assign::find_assigner(answer.choice->assigner["name"].get<std::string>());
  const bool has_others = method.answers(assign::Answer::lists) && method.answers(assign::Answer::structure);
  const std::string only_choice = has_others ? answer.choice->name + ": " : "";
  Json budgets = Json::array();
  for (const Constraint& constraint : question.constraints)
    if (constraint.is_given)
      budgets.push_back(only_choice + constraint.rule.figure + (constraint.rule.is_inclusive ? " >= " : " > ") +
                        Json(constraint.rule.limit).dump());
  out["limits"]["fail_if"] = budgets;
  return out;
}

}  // namespace clusterbench::report
