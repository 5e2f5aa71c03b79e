#pragma once
// The sets of samples (result/sample_sets.h) in tables.

#include <set>
#include <string>
#include <vector>

#include "result/sample_sets.h"

namespace clusterbench::report {

// Cases without samples while others of their scene, camera and viewport have some: their missed lights are unknown.
std::set<std::string> ids_without_samples(const std::vector<result::Case>& cases);

// Whether only points of the view, not on surfaces, rank the case.
bool ranks_at_random_depths(const result::Case& result_case);

// Suffix of a column's heading: " (opaque)", or " (weighted)" for several sets; "" for points of the whole view if the
// case has no other samples.
std::string heading_of_sets(const result::Case& result_case);
// " (opaque)", " (weighted)" for several sets, "" for none.
std::string heading_of_sets(const std::vector<std::string>& sets);

}  // namespace clusterbench::report
