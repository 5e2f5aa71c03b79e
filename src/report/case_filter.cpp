#include "report/case_filter.h"

#include "core/error.h"
#include "core/pattern.h"
#include "core/text.h"

namespace clusterbench::report {

void keep_cases(nlohmann::ordered_json& result, const std::string& filter, const std::string& path) {
  if (filter.empty()) return;
  const Pattern pattern(filter, "--filter");
  nlohmann::ordered_json kept = nlohmann::ordered_json::array();
  for (const nlohmann::ordered_json& result_case : result["cases"])
    if (pattern.is_in(result_case["name"].get<std::string>())) kept.push_back(result_case);
  if (kept.empty()) {
    const nlohmann::ordered_json& all = result["cases"];
    throw Error(path, "--filter",
                "'" + filter + "' matches none of " + number_of(all.size(), "case") + pattern_hint(filter) +
                    (all.empty() ? "" : "; one of them is '" + all[0]["name"].get<std::string>() + "'"));
  }
  result["cases"] = std::move(kept);
}

}  // namespace clusterbench::report
