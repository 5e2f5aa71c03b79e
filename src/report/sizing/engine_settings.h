#pragma once
// What `size --engine NAME` prints: an allocation in an engine's own settings, for engines whose limits can be set.

#include <span>
#include <string>
#include <vector>

#include "report/sizing/allocation.h"
#include "result/documents/size.h"

namespace clusterbench::report {

// Names that --engine takes: those of the presets that are measured for it.
std::vector<std::string> engines_with_settings();
// Throws Error (where = "--engine") for a name that is none of them, with those that there are and with what is known
// of an engine whose limits are constants.
void check_engine(const std::string& name);

// What searches have to make large for its settings, each once, by its name in `worst-case --measure`.
std::vector<std::string> measures_of_engine(const std::string& name);

// Whose settings are told, and by which rules.
struct EngineRequest {
  std::string engine;             // of engines_with_settings()
  bool has_changed_grid = false;  // another grid than the engine's own: one that it can be set to
  AllocationRules rules;
};

// Of each structure the settings: their names as the engine has them, its version, the value to set, what it comes of,
// and what the engine drops beyond it. Then, of several that the engine has one setting for, the value for all.
std::string engine_settings_text(const EngineRequest& request, std::span<const SizedStructure* const> structures);
// Of one of them, for the document of `size`.
result::EngineSettings engine_settings_of(const EngineRequest& request, const SizedStructure& structure,
                                          std::span<const SizedStructure* const> structures);

}  // namespace clusterbench::report
