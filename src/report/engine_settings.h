#pragma once
// What `size --engine NAME` prints: an allocation in an engine's own settings, for engines whose limits can be set.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/allocation.h"

namespace clusterbench::report {

// Names that --engine takes: those of the presets that are measured for it.
std::vector<std::string> engines_with_settings();
// Throws Error (where = "--engine") for a name that is none of them, with those that there are and with what is known
// of an engine whose limits are constants.
void check_engine(const std::string& name);

// What searches have to make large for its settings, each once, by its name in `worst-case --measure`.
std::vector<std::string> measures_of_engine(const std::string& name);

// Of each structure the settings: their names as the engine has them, its version, the value to set, what it comes of,
// and what the engine drops beyond it.
std::string engine_settings_text(const std::string& engine, const std::vector<SizedStructure>& structures,
                                 const AllocationRules& rules);
// Of one structure, for the JSON of `size`: {"engine", "version", "grid", "limits": [...]}.
nlohmann::ordered_json engine_settings_json(const std::string& engine, const SizedStructure& structure,
                                            const AllocationRules& rules);

}  // namespace clusterbench::report
