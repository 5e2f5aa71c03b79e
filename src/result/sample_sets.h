#pragma once
// The sets of samples of a case, and which of them rank it: those with a cost. Tables, budgets and sentences use the
// same words for sets.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "result/case.h"

namespace clusterbench::result {

std::vector<std::string> sample_set_names();  // "volume", "opaque" ...
bool is_sample_set(std::string_view name);
// "visible surfaces" for opaque, "random points in the view" for volume.
std::string words_of_set(const std::string& set);
// "visible surfaces, fog froxels".
std::string words_of_sets(const std::vector<std::string>& sets);

// The counts of a case's set of samples; null if it has none.
const SampleSet* samples_of_set(const Case& result_case, const std::string& set);

// The sets that rank a case: those with a cost; if there are none, visible surfaces if requested, otherwise points of
// the whole view. Empty without samples.
std::vector<std::string> ranking_set_names(const Case& result_case);
std::vector<const SampleSet*> ranking_samples(const Case& result_case);

// A number of a set: number<&SampleSet::unlit>.
using SampleFigure = std::optional<double> (*)(const SampleSet& set);
// The ranking set with the largest value; null if none has one.
const SampleSet* most_at_sets(const Case& result_case, SampleFigure figure);
// A count summed over all ranking sets; 0 if they do not have it.
double sum_at_samples(const Case& result_case, SampleFigure count);
// A count per sample, mean over the samples of the ranking sets as a frame shades them. None without samples, or if a
// set does not have the count.
std::optional<double> mean_at_samples(const Case& result_case, SampleFigure count);
// A count per sample of one set; 0 without samples.
double mean_per_sample(const SampleSet& counts, SampleFigure count);
// Share of the needed lights that the samples miss, of the ranking set with the largest share. None if no sample needs
// a light.
std::optional<double> unlit_at_samples(const Case& result_case);

// The cost of a set by the model; null if the set is not part of the cost.
const SetCost* cost_of_set(const Cost& cost, const std::string& name);

}  // namespace clusterbench::result
