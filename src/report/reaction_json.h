#pragma once
// Tiles that react and storages whose room ends, in a result and as tables.

#include <nlohmann/json.hpp>
#include <string>

#include "run/reaction_meter.h"

namespace clusterbench::report {

nlohmann::ordered_json reaction_to_json(const run::ReactionResult& result);
nlohmann::ordered_json fallback_to_json(const run::FallbackResult& result);

// One line per case that reacts, or whose storage can run out of room; "" without any.
std::string reaction_table(const nlohmann::ordered_json& result);
std::string fallback_table(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
