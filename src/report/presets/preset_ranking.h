#pragma once
// Presets (config/presets.h) of a result beside each other: which suits a level, and why.

#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// What is known of the presets that cases and skipped combinations are of, in the order of config::presets(); empty
// without any.
std::vector<result::Preset> preset_facts(const std::vector<result::Case>& cases,
                                         const std::vector<result::Skipped>& skipped);

// Per scene, camera and viewport the cases of presets: those whose samples lack no light, by what a frame costs the GPU
// (report/cases/case_costs.h); then those of them that samples search, among themselves; then those that lack lights,
// by how many. Cases whose costs the model cannot tell apart share a place. `origin`: the result whose configuration
// they have. Empty without presets.
std::vector<result::PresetRanking> preset_rankings(const std::vector<result::Scene>& scenes,
                                                   const std::vector<result::Case>& cases,
                                                   const result::Result& origin);

// The rankings as tables with a sentence for each preset; "" without any.
std::string preset_table(const result::Result& result);
// What to take by each, a line each: what a reader sees last. "" without any.
std::string preset_conclusions(const result::Result& result);

}  // namespace clusterbench::report
