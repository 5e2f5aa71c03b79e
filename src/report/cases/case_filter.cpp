#include "report/cases/case_filter.h"

#include "assign/contract/assigner.h"
#include "core/error.h"
#include "core/pattern.h"
#include "core/text.h"
#include "report/cases/columns.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {

namespace {

// Updates params and label of a method from former names. Returns whether a name was a former one.
bool use_current_choices(result::Method& method) {
  const assign::AssignerDescriptor* known = assign::find_assigner(method.name);
  if (known == nullptr) return false;
  bool is_former = false;
  for (const assign::ParamSpec& spec : known->params) {
    const auto param = method.params.find(spec.name);
    if (param == method.params.end() || !param->is_string()) continue;
    const assign::ParamValue choice = param->get<std::string>(), current = assign::current_value(spec, choice);
    if (current == choice) continue;
    is_former = true;
    *param = std::get<std::string>(current);
  }
  if (is_former) method.label = run::current_method(method.label);
  return is_former;
}

}  // namespace

run::CaseNames names_of_case(const result::Case& result_case) {
  return {result_case.name,
          result_case.id,
          result_case.scene,
          result_case.camera,
          viewport_text(result_case.viewport),
          result_case.grid.name,
          method_name(result_case),
          result_case.storage};
}

void use_current_names(result::Result& result) {
  for (result::Case& result_case : result.cases) {
    const bool has_former_choice = use_current_choices(result_case.assigner);
    if (has_former_choice || result_case.storage == run::k_own_structure)
      result_case.name = run::current_name(result_case.name);
  }
}

bool is_selected(const Pattern& pattern, const result::Case& result_case) {
  return run::is_selected(pattern, names_of_case(result_case));
}

void keep_cases(result::Result& result, const std::string& filter, const std::string& path) {
  if (filter.empty()) return;
  const Pattern pattern(filter, "--filter");
  std::vector<result::Case> kept;
  for (const result::Case& result_case : result.cases)
    if (is_selected(pattern, result_case)) kept.push_back(result_case);
  if (kept.empty())
    throw Error(path, "--filter",
                run::no_match_text(filter, result.cases.size(), result.cases.empty() ? "" : result.cases.front().name));
  result.cases = std::move(kept);
}

}  // namespace clusterbench::report
