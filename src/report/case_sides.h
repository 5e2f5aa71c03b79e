#pragma once
// A case beside the same case without something, in a result and in tables.

#include <nlohmann/json.hpp>
#include <string>

#include "run/case_side.h"

namespace clusterbench::report {

nlohmann::ordered_json to_json(const run::Extremes& extremes);
nlohmann::ordered_json to_json(const run::CaseSide& side);

// Of what both sides have: 1 - with / without.
nlohmann::ordered_json saved(const nlohmann::ordered_json& with, const nlohmann::ordered_json& without);

// How much more it is than without, of what is saved: "+12.5 %"; "-" where nothing is known.
std::string against_other(const nlohmann::ordered_json& saved, const char* key);
// Lights that samples loop over: of the sets of samples the first one, which is that of the whole view where that is
// asked for.
std::string evaluated_against_other(const nlohmann::ordered_json& saved);

}  // namespace clusterbench::report
