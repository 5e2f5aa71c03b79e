#include "result/sample_sets.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "result/at.h"

namespace clusterbench::result {
namespace {

constexpr const char* k_volume = "volume";

const SampleSet* pointer_to(const std::optional<SampleSet>& counts) {
  return counts ? &*counts : nullptr;
}

struct SetRow {
  const char *name, *words;
  std::optional<SampleSet> SampleSets::*counts;  // null: `shading`
};
constexpr SetRow k_sets[] = {{k_volume, "random points in the view", nullptr},
                             {"opaque", "visible surfaces", &SampleSets::opaque},
                             {"transparent", "transparent surfaces", &SampleSets::transparent},
                             {"fog", "fog froxels", &SampleSets::fog},
                             {"mirror", "mirrored points outside of the view", &SampleSets::mirror},
                             {"anywhere", "random points in the lights' bounds", &SampleSets::anywhere}};

const SetRow* row_of(std::string_view name) {
  const SetRow* const found = std::ranges::find_if(k_sets, [&](const SetRow& row) { return name == row.name; });
  return found == std::end(k_sets) ? nullptr : found;
}

// The number of samples of a set that a frame shades, if the case has a cost.
struct RankingSet {
  const SampleSet* counts;
  double shaded;
};

std::vector<RankingSet> ranking_sets(const Case& result_case) {
  std::vector<RankingSet> sets;
  const bool is_paid = result_case.cost && !result_case.cost->sets.empty();
  for (const std::string& name : ranking_set_names(result_case)) {
    const double shaded = is_paid ? cost_of_set(*result_case.cost, name)->samples : 1.0;
    sets.push_back({samples_of_set(result_case, name), std::isfinite(shaded) ? shaded : 0.0});
  }
  return sets;
}

}  // namespace

std::vector<std::string> sample_set_names() {
  std::vector<std::string> names;
  for (const SetRow& row : k_sets) names.emplace_back(row.name);
  return names;
}

bool is_sample_set(std::string_view name) {
  return row_of(name) != nullptr;
}

std::string words_of_set(const std::string& set) {
  const SetRow* row = row_of(set);
  return row != nullptr ? row->words : printable(set);
}

std::string words_of_sets(const std::vector<std::string>& sets) {
  std::vector<std::string> words;
  for (const std::string& set : sets) words.push_back(words_of_set(set));
  return joined(words);
}

const SampleSet* samples_of_set(const Case& result_case, const std::string& set) {
  const SetRow* row = row_of(set);
  if (row == nullptr) return nullptr;
  if (row->counts == nullptr) return pointer_to(result_case.shading);
  return result_case.samples ? pointer_to(*result_case.samples.*row->counts) : nullptr;
}

std::vector<std::string> ranking_set_names(const Case& result_case) {
  std::vector<std::string> sets;
  if (result_case.cost && !result_case.cost->sets.empty()) {
    // Skips sets without samples in any frame, unless all are.
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

std::vector<const SampleSet*> ranking_samples(const Case& result_case) {
  std::vector<const SampleSet*> all;
  for (const RankingSet& set : ranking_sets(result_case)) all.push_back(set.counts);
  return all;
}

const SampleSet* most_at_sets(const Case& result_case, SampleFigure figure) {
  const SampleSet* most = nullptr;
  for (const SampleSet* counts : ranking_samples(result_case)) {
    const std::optional<double> value = figure(*counts);
    if (value && (most == nullptr || *value > *figure(*most))) most = counts;
  }
  return most;
}

double sum_at_samples(const Case& result_case, SampleFigure count) {
  double sum = 0.0;
  for (const SampleSet* set : ranking_samples(result_case)) sum += count(*set).value_or(0.0);
  return sum;
}

std::optional<double> mean_at_samples(const Case& result_case, SampleFigure count) {
  double sum = 0.0, shaded = 0.0;
  for (const RankingSet& set : ranking_sets(result_case)) {
    if (!count(*set.counts)) return std::nullopt;
    if (set.counts->samples == 0) continue;
    sum += set.shaded * mean_per_sample(*set.counts, count);
    shaded += set.shaded;
  }
  return shaded > 0.0 ? std::optional(sum / shaded) : std::nullopt;
}

double mean_per_sample(const SampleSet& counts, SampleFigure count) {
  const auto samples = static_cast<double>(counts.samples);
  return samples > 0.0 ? count(counts).value_or(0.0) / samples : 0.0;
}

std::optional<double> unlit_at_samples(const Case& result_case) {
  const SampleSet* most = most_at_sets(result_case, number<&SampleSet::unlit>);
  return most != nullptr ? std::optional(most->unlit) : std::nullopt;
}

const SetCost* cost_of_set(const Cost& cost, const std::string& name) {
  const auto found = std::ranges::find_if(cost.sets, [&](const auto& set) { return set.first == name; });
  return found == cost.sets.end() ? nullptr : &found->second;
}

}  // namespace clusterbench::result
