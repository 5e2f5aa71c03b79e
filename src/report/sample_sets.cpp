#include "report/sample_sets.h"

#include <algorithm>

#include "core/text.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_volume = "volume";

}  // namespace

std::string words_of_set(const std::string& set) {
  constexpr std::pair<const char*, const char*> k_words[] = {
      {k_volume, "random points in the view"},           {"opaque", "visible surfaces"},
      {"transparent", "transparent surfaces"},           {"fog", "fog froxels"},
      {"mirror", "mirrored points outside of the view"}, {"anywhere", "random points in the lights' bounds"}};
  for (const auto& [name, words] : k_words)
    if (set == name) return words;
  return printable(set);
}

std::string words_of_sets(const std::vector<std::string>& sets) {
  std::vector<std::string> words;
  for (const std::string& set : sets) words.push_back(words_of_set(set));
  return joined(words);
}

const Json* samples_of_set(const Json& result_case, const std::string& set) {
  return value_at(result_case, set == k_volume ? "/shading" : "/samples/" + set);
}

std::vector<std::string> ranking_set_names(const Json& result_case) {
  std::vector<std::string> sets;
  if (const Json* paid = value_at(result_case, "/cost/sets"); paid != nullptr && !paid->empty()) {
    // Without one of a set that has no samples in any frame, unless none has.
    for (const auto& [name, set] : paid->items())
      if (const Json* counts = samples_of_set(result_case, name);
          counts != nullptr && number_at(*counts, "/samples").value_or(0.0) > 0.0)
        sets.push_back(name);
    if (!sets.empty()) return sets;
    for (const auto& [name, set] : paid->items())
      if (samples_of_set(result_case, name) != nullptr) sets.push_back(name);
    return sets;
  }
  for (const char* set : {"opaque", k_volume})
    if (samples_of_set(result_case, set) != nullptr) return {set};
  return {};
}

std::set<std::string> ids_without_samples(const Json& cases) {
  const auto view_of = [](const Json& one) { return Json{one["scene"], one["camera"], one["viewport"]}.dump(); };
  std::set<std::string> sampled_views, ids;
  for (const Json& one : cases)
    if (!ranking_set_names(one).empty()) sampled_views.insert(view_of(one));
  for (const Json& one : cases)
    if (ranking_set_names(one).empty() && sampled_views.contains(view_of(one)))
      ids.insert(one["id"].get<std::string>());
  return ids;
}

bool ranks_at_random_depths(const Json& result_case) {
  const std::vector<std::string> sets = ranking_set_names(result_case);
  const auto has = [&](const char* set) { return std::ranges::find(sets, set) != sets.end(); };
  return has(k_volume) && !has("opaque");
}

std::string heading_of_sets(const Json& result_case) {
  const std::vector<std::string> sets = ranking_set_names(result_case);
  const bool has_no_others = sets == std::vector<std::string>{k_volume} && !result_case.contains("samples");
  return has_no_others ? "" : heading_of_sets(sets);
}

std::string heading_of_sets(const std::vector<std::string>& sets) {
  if (sets.empty()) return "";
  return " (" + (sets.size() == 1 ? printable(sets.front()) : std::string("weighted")) + ")";
}

const Json* most_at_sets(const Json& result_case, const char* pointer) {
  const Json* most = nullptr;
  for (const std::string& set : ranking_set_names(result_case)) {
    const Json* counts = samples_of_set(result_case, set);
    const std::optional<double> value = number_at(*counts, pointer);
    if (value && (most == nullptr || *value > *number_at(*most, pointer))) most = counts;
  }
  return most;
}

}  // namespace clusterbench::report
