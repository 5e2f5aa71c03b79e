#pragma once
// The text of `size --engine NAME`: an allocation in an engine's own settings, for engines with adjustable limits.

#include <span>
#include <string>
#include <vector>

#include "report/sizing/allocation.h"
#include "result/documents/size.h"

namespace clusterbench::report {

// Names for --engine: those of the presets that are measured for it.
std::vector<std::string> engines_with_settings();
// Throws Error (where = "--engine") for another name, with the valid names and, for an engine whose limits are
// constants, the reason.
void check_engine(const std::string& name);

// The measures that searches should maximise for its settings, each once, names of `worst-case --measure`.
std::vector<std::string> measures_of_engine(const std::string& name);

// The engine whose settings are printed, and the rules.
struct EngineRequest {
  std::string engine;             // of engines_with_settings()
  bool has_changed_grid = false;  // another grid than the engine's default, one that it can be set to
  AllocationRules rules;
};

// For each structure the settings: their names in the engine, its version, the value to set, its basis, and the losses
// beyond it. Then, for structures that share one setting of the engine, the value for all.
std::string engine_settings_text(const EngineRequest& request, std::span<const SizedStructure* const> structures);
// Of one of them, for the document of `size`.
result::EngineSettings engine_settings_of(const EngineRequest& request, const SizedStructure& structure,
                                          std::span<const SizedStructure* const> structures);

}  // namespace clusterbench::report
