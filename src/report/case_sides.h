#pragma once
// A case beside the same case without something, in tables.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// How much more it is than without, of what is saved: "+12.5 %"; "-" where nothing is known.
std::string against_other(const nlohmann::ordered_json& saved, const char* key);
// Lights that samples loop over: of the sets of samples the first one, which is that of the whole view where that is
// asked for.
std::string evaluated_against_other(const nlohmann::ordered_json& saved);

}  // namespace clusterbench::report
