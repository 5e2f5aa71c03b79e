#pragma once
// Merges several results: shards of a configuration, several configurations, counts of several machines.

#include <string>
#include <vector>

#include "report/results/sweep.h"
#include "result/result.h"

namespace clusterbench::report {

// All cases in order of the parts; scenes once; fronts are recomputed. `tool` is the first part's, `machine` that of
// the first times, else the first part's; the configuration is theirs if all have the same, else {"allocation",
// "merged": [all of them]}. Times and instructions of several machines stay apart: each case names its own of
// `machines`, and is ranked among its own. Shards (`run --shard`) become the result of the undivided run, in whatever
// order they are given. Throws Error that names both files for a case that two parts have, for two scenes of one name,
// for different allocation rules, and for times or instructions of different programs; of shards also as order_shards()
// does (sweep.h). Exact counts do not depend on the machine.
result::Result merged(std::vector<NamedPart> parts);

}  // namespace clusterbench::report
