#pragma once
// A ranking of presets in sentences.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/preset_cost.h"
#include "report/preset_losses.h"

namespace clusterbench::report {

// In which part of a ranking a case stands, best first.
enum class PresetStanding : std::uint8_t { lists, searched, lacks_lights, unknown };
const char* name_of(PresetStanding standing);  // "lists", "searched", "lacks_lights", "unknown"

struct RankedPreset {
  const nlohmann::ordered_json* result_case = nullptr;
  PresetStanding standing = PresetStanding::unknown;
  std::optional<PresetCost> cost;
  PresetLosses losses;
  int place = 0;  // in its part, from 1; those that the model cannot tell apart share the first one's
  const nlohmann::ordered_json* config = nullptr;  // that the case was measured by
};

// Of one sample; `what`: "evaluated", "needed", "read_bytes".
std::optional<double> per_sample(const nlohmann::ordered_json& result_case, const char* what);

// What speaks for and against a case. `first`: of its part.
std::string preset_reason(const RankedPreset& row, const RankedPreset& first);

// What to take, against what, by how much, and how sure that is. All rows of one view, best first.
std::string preset_conclusion(const std::vector<RankedPreset>& rows);

}  // namespace clusterbench::report
