#include "report/case_filter.h"

#include "assign/contract/assigner.h"
#include "core/error.h"
#include "core/pattern.h"
#include "core/text.h"
#include "report/columns.h"
#include "report/conclusion.h"
#include "report/json_values.h"
#include "report/result_json.h"
#include "run/sweep.h"

namespace clusterbench::report {

namespace {

// Of a method as a case has it: name, label and params. Whether one was called otherwise.
bool use_current_choices(nlohmann::ordered_json& method) {
  const assign::AssignerDescriptor* known = assign::find_assigner(method.value("name", ""));
  if (known == nullptr || !method.contains("params")) return false;
  bool is_former = false;
  for (const assign::ParamSpec& spec : known->params) {
    const auto param = method["params"].find(spec.name);
    if (param == method["params"].end() || !param->is_string()) continue;
    const assign::ParamValue choice = param->get<std::string>(), current = assign::current_value(spec, choice);
    if (current == choice) continue;
    is_former = true;
    *param = std::get<std::string>(current);
  }
  if (is_former) method["label"] = run::current_method(method["label"].get<std::string>());
  return is_former;
}

}  // namespace

run::CaseNames names_of_case(const nlohmann::ordered_json& result_case) {
  const auto text_of = [&](const char* pointer) {
    const nlohmann::ordered_json* found = value_at(result_case, pointer);
    return found == nullptr ? std::string() : found->is_string() ? found->get<std::string>() : found->dump();
  };
  return {text_of("/name"),
          text_of("/id"),
          text_of("/scene"),
          text_of("/camera"),
          text_of("/viewport/0") + "x" + text_of("/viewport/1"),
          text_of("/grid/name"),
          value_at(result_case, "/assigner/label") == nullptr ? "" : method_name(result_case),
          text_of("/storage")};
}

void use_current_names(nlohmann::ordered_json& result) {
  for (nlohmann::ordered_json& result_case : result["cases"]) {
    const bool has_former_choice = result_case.contains("assigner") && use_current_choices(result_case["assigner"]);
    if (has_former_choice || result_case.value("storage", "") == run::k_own_structure)
      result_case["name"] = run::current_name(result_case["name"].get<std::string>());
  }
}

bool is_selected(const Pattern& pattern, const nlohmann::ordered_json& result_case) {
  return run::is_selected(pattern, names_of_case(result_case));
}

void keep_cases(nlohmann::ordered_json& result, const std::string& filter, const std::string& path) {
  if (filter.empty()) return;
  const Pattern pattern(filter, "--filter");
  nlohmann::ordered_json kept = nlohmann::ordered_json::array();
  for (const nlohmann::ordered_json& result_case : result["cases"])
    if (is_selected(pattern, result_case)) kept.push_back(result_case);
  if (kept.empty()) {
    const nlohmann::ordered_json& all = result["cases"];
    throw Error(path, "--filter",
                "'" + filter + "' matches none of " + number_of(all.size(), "case") + pattern_hint(filter) +
                    (all.empty() ? "" : "; one of them is '" + all[0]["name"].get<std::string>() + "'"));
  }
  result["cases"] = std::move(kept);
}

void keep_cases_and_conclude(nlohmann::ordered_json& result, const std::string& filter, const std::string& path) {
  if (filter.empty()) return;
  keep_cases(result, filter, path);
  result["pareto_front"] = fronts(result["scenes"], result["cases"], result);
  if (result.contains("preset_rankings")) {
    for (const char* key : {"presets", "preset_rankings"}) result.erase(key);
    add_presets(result, result);
  }
  if (!result.contains("conclusions")) return;
  result["conclusions"] = conclusions_of(result, result);
  conclude_failures(result, {});
}

}  // namespace clusterbench::report
