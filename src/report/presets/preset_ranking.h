#pragma once
// Compares the presets of a result: which of them suits a level, and why.

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// The presets of the cases and skipped combinations, in the order of config::presets(); empty without any.
std::vector<result::Preset> preset_facts(const std::vector<result::Case>& cases,
                                         const std::vector<result::Skipped>& skipped);

// Per scene, camera and viewport the cases of presets: first those whose samples miss no light, by GPU cost per frame
// (report/cases/case_costs.h); then the same for those whose samples search the structure; then those that miss lights,
// by their number. Cases whose costs the model cannot distinguish share a place. `origin`: the result with their
// configuration. Empty without presets.
std::vector<result::PresetRanking> preset_rankings(const std::vector<result::Scene>& scenes,
                                                   const std::vector<result::Case>& cases,
                                                   const result::Result& origin);

// The rankings as tables with a sentence for each preset; "" without any.
std::string preset_table(const result::Result& result);
// The recommendation of each ranking, a line each, printed last. "" without any.
std::string preset_conclusions(const result::Result& result);

}  // namespace clusterbench::report
