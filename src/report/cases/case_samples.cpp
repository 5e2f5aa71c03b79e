#include "report/cases/case_samples.h"

#include <algorithm>
#include <tuple>

#include "core/text.h"

namespace clusterbench::report {

std::set<std::string> ids_without_samples(const std::vector<result::Case>& cases) {
  const auto view_of = [](const result::Case& one) { return std::tuple(one.scene, one.camera, one.viewport); };
  std::set<std::tuple<std::string, std::string, result::Counts2>> sampled_views;
  std::set<std::string> ids;
  for (const result::Case& one : cases)
    if (!ranking_set_names(one).empty()) sampled_views.insert(view_of(one));
  for (const result::Case& one : cases)
    if (ranking_set_names(one).empty() && sampled_views.contains(view_of(one))) ids.insert(one.id);
  return ids;
}

bool ranks_at_random_depths(const result::Case& result_case) {
  const std::vector<std::string> sets = ranking_set_names(result_case);
  const auto has = [&](const char* set) { return std::ranges::find(sets, set) != sets.end(); };
  return has("volume") && !has("opaque");
}

std::string heading_of_sets(const result::Case& result_case) {
  const std::vector<std::string> sets = ranking_set_names(result_case);
  const bool has_no_others = sets == std::vector<std::string>{"volume"} && !result_case.samples;
  return has_no_others ? "" : heading_of_sets(sets);
}

std::string heading_of_sets(const std::vector<std::string>& sets) {
  if (sets.empty()) return "";
  return " (" + (sets.size() == 1 ? printable(sets.front()) : std::string("weighted")) + ")";
}

}  // namespace clusterbench::report
