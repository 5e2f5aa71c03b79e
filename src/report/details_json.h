#pragma once
// The details of a case as JSON. Rows of numbers stay text: see core/run_length_text.h.

#include <nlohmann/json.hpp>

#include "run/packed_details.h"

namespace clusterbench::report {

nlohmann::ordered_json details_to_json(const run::Details& details);

}  // namespace clusterbench::report
