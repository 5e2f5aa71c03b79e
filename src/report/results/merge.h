#pragma once
// Merges several results: shards of a configuration, several configurations, counts of several machines.

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

struct NamedPart {
  std::string file;
  result::Result result;
};

// All cases in order of the parts; scenes once; fronts are recomputed. `tool` and `machine` are the first part's, the
// configuration is theirs if all have the same, else {"allocation", "merged": [all of them]}. Throws Error that names
// both files for a case that two parts have, for two scenes of one name, for different allocation rules, and for times
// or instructions of different programs or machines; exact counts do not depend on the machine.
result::Result merged(const std::vector<NamedPart>& parts);

}  // namespace clusterbench::report
