#pragma once
// The sets of samples of a case: it can have several, and is ranked by those that cost something. Tables, budgets and
// sentences name the sets in the same words.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "result/case.h"

namespace clusterbench::result {

std::vector<std::string> sample_set_names();  // "volume", "opaque" ...
bool is_sample_set(std::string_view name);
// "visible surfaces" of opaque, "random points in the view" of volume.
std::string words_of_set(const std::string& set);
// "visible surfaces, fog froxels".
std::string words_of_sets(const std::vector<std::string>& sets);

// The counts of a case's set of samples; null without them.
const SampleSet* samples_of_set(const Case& result_case, const std::string& set);

// The sets that a case is ranked by: those that cost something; without any, visible surfaces if they are asked for,
// else points of the whole view. Empty without samples.
std::vector<std::string> ranking_set_names(const Case& result_case);
std::vector<const SampleSet*> ranking_samples(const Case& result_case);

// A number of a set: number<&SampleSet::unlit>.
using SampleFigure = std::optional<double> (*)(const SampleSet& set);
// The ranking set with the largest number of a kind; null where none has one.
const SampleSet* most_at_sets(const Case& result_case, SampleFigure figure);
// A count over all ranking sets; 0 where they do not have it.
double sum_at_samples(const Case& result_case, SampleFigure count);
// A count per sample, mean over the samples of the ranking sets as a frame shades them. None without samples, and where
// a set does not have it.
std::optional<double> mean_at_samples(const Case& result_case, SampleFigure count);
// A count per sample of one set; 0 without samples.
double mean_per_sample(const SampleSet& counts, SampleFigure count);
// Share of the needed lights that the samples lack, of the ranking set that lacks most. None where no sample needs one.
std::optional<double> unlit_at_samples(const Case& result_case);

// What the model says of a set; null where it has no part in the cost.
const SetCost* cost_of_set(const Cost& cost, const std::string& name);

}  // namespace clusterbench::result
