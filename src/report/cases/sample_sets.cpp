#include "report/cases/sample_sets.h"

#include <algorithm>
#include <tuple>

#include "core/text.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::SampleSet;
using result::SampleSets;

constexpr const char* k_volume = "volume";
constexpr std::pair<const char*, std::optional<SampleSet> SampleSets::*> k_asked_for[] = {
    {"opaque", &SampleSets::opaque},
    {"transparent", &SampleSets::transparent},
    {"fog", &SampleSets::fog},
    {"mirror", &SampleSets::mirror},
    {"anywhere", &SampleSets::anywhere}};

const SampleSet* pointer_to(const std::optional<SampleSet>& counts) {
  return counts ? &*counts : nullptr;
}

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

const SampleSet* samples_of_set(const Case& result_case, const std::string& set) {
  if (set == k_volume) return pointer_to(result_case.shading);
  if (!result_case.samples) return nullptr;
  for (const auto& [name, counts] : k_asked_for)
    if (set == name) return pointer_to(*result_case.samples.*counts);
  return nullptr;
}

std::vector<std::string> ranking_set_names(const Case& result_case) {
  std::vector<std::string> sets;
  if (result_case.cost && !result_case.cost->sets.empty()) {
    // Without one of a set that has no samples in any frame, unless none has.
    for (const auto& [name, _] : result_case.cost->sets)
      if (const SampleSet* counts = samples_of_set(result_case, name); counts != nullptr && counts->samples > 0)
        sets.push_back(name);
    if (!sets.empty()) return sets;
    for (const auto& [name, _] : result_case.cost->sets)
      if (samples_of_set(result_case, name) != nullptr) sets.push_back(name);
    return sets;
  }
  for (const char* set : {"opaque", k_volume})
    if (samples_of_set(result_case, set) != nullptr) return {set};
  return {};
}

std::set<std::string> ids_without_samples(const std::vector<Case>& cases) {
  const auto view_of = [](const Case& one) { return std::tuple(one.scene, one.camera, one.viewport); };
  std::set<std::tuple<std::string, std::string, result::Counts2>> sampled_views;
  std::set<std::string> ids;
  for (const Case& one : cases)
    if (!ranking_set_names(one).empty()) sampled_views.insert(view_of(one));
  for (const Case& one : cases)
    if (ranking_set_names(one).empty() && sampled_views.contains(view_of(one))) ids.insert(one.id);
  return ids;
}

bool ranks_at_random_depths(const Case& result_case) {
  const std::vector<std::string> sets = ranking_set_names(result_case);
  const auto has = [&](const char* set) { return std::ranges::find(sets, set) != sets.end(); };
  return has(k_volume) && !has("opaque");
}

std::string heading_of_sets(const Case& result_case) {
  const std::vector<std::string> sets = ranking_set_names(result_case);
  const bool has_no_others = sets == std::vector<std::string>{k_volume} && !result_case.samples;
  return has_no_others ? "" : heading_of_sets(sets);
}

std::string heading_of_sets(const std::vector<std::string>& sets) {
  if (sets.empty()) return "";
  return " (" + (sets.size() == 1 ? printable(sets.front()) : std::string("weighted")) + ")";
}

const SampleSet* most_at_sets(const Case& result_case, SampleFigure figure) {
  const SampleSet* most = nullptr;
  for (const std::string& set : ranking_set_names(result_case)) {
    const SampleSet* counts = samples_of_set(result_case, set);
    const std::optional<double> value = figure(*counts);
    if (value && (most == nullptr || *value > *figure(*most))) most = counts;
  }
  return most;
}

}  // namespace clusterbench::report
