#pragma once
// Presets (config/presets.h) of a result beside each other: which suits a level, and why.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// What is known of the presets that cases and skipped combinations are of, in the order of config::presets(); empty
// without any.
nlohmann::ordered_json preset_facts(const nlohmann::ordered_json& cases, const nlohmann::ordered_json& skipped);

// Per scene, camera and viewport the cases of presets: those whose samples lack no light, by what a frame costs the GPU
// (report/frame_cost.h); then those of them that samples search, among themselves; then those that lack lights, by how
// many. Cases whose costs the model cannot tell apart share a place. `origin`: the result whose configuration they
// have. Empty without presets.
nlohmann::ordered_json preset_rankings(const nlohmann::ordered_json& scenes, const nlohmann::ordered_json& cases,
                                       const nlohmann::ordered_json& origin);

// The rankings as tables with a sentence for each preset; "" without any.
std::string preset_table(const nlohmann::ordered_json& result);
// What to take by each, a line each: what a reader sees last. "" without any.
std::string preset_conclusions(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
