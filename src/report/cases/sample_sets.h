#pragma once
// Of which samples a figure is: a case has several sets of them, and is ranked by those that cost something
// (case_costs.h). Tables, budgets and sentences name the sets in the same words.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "result/case.h"

namespace clusterbench::report {

// "visible surfaces" of opaque, "random points in the view" of volume.
std::string words_of_set(const std::string& set);
// "visible surfaces, fog froxels".
std::string words_of_sets(const std::vector<std::string>& sets);

// The counts of a case's set of samples; null without them.
const result::SampleSet* samples_of_set(const result::Case& result_case, const std::string& set);

// The sets that a case is ranked by: those that cost something; without any, visible surfaces if they are asked for,
// else points of the whole view. Empty without samples.
std::vector<std::string> ranking_set_names(const result::Case& result_case);

// Cases that have no samples while others of their scene, camera and viewport have some: of what they leave unlit
// nothing is known.
std::set<std::string> ids_without_samples(const std::vector<result::Case>& cases);

// Of points of the view, where no surface is, and of no surfaces beside.
bool ranks_at_random_depths(const result::Case& result_case);

// Behind a column's heading: " (opaque)", of several sets " (weighted)"; "" of points of the whole view where the case
// has no other samples.
std::string heading_of_sets(const result::Case& result_case);
// " (opaque)", of several sets " (weighted)", of none "".
std::string heading_of_sets(const std::vector<std::string>& sets);

// A number of a set: result::number<&result::SampleSet::unlit>.
using SampleFigure = std::optional<double> (*)(const result::SampleSet& set);
// Of the sets that a case is ranked by the one with the largest number of a kind; null where none has one.
const result::SampleSet* most_at_sets(const result::Case& result_case, SampleFigure figure);

}  // namespace clusterbench::report
