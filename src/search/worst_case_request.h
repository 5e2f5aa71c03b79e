#pragma once
// What may be asked for.

#include "search/worst_case.h"

namespace clusterbench::search {

// Throws Error with the flag, or the scene, that does not go with the others.
void check_request(const run::SceneData& data, const WorstCaseRequest& request);

}  // namespace clusterbench::search
