#pragma once
// The sets of samples (result/sample_sets.h) in tables.

#include <set>
#include <string>
#include <vector>

#include "result/sample_sets.h"

namespace clusterbench::report {

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

}  // namespace clusterbench::report
