#pragma once
// A ranking of presets in sentences.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/cases/case_costs.h"
#include "report/presets/preset_losses.h"
#include "result/case.h"

namespace clusterbench::report {

// Whether the model cannot distinguish two costs: they are nearly equal, or their order depends on the prices.
bool are_alike(const measure::FrameCost& less, const measure::FrameCost& more);

// The part of a ranking that a case belongs to, best first.
enum class PresetStanding : std::uint8_t { lists, searched, lacks_lights, unknown };
const char* name_of(PresetStanding standing);  // "lists", "searched", "lacks_lights", "unknown"

struct RankedPreset {
  const result::Case* result_case = nullptr;
  PresetStanding standing = PresetStanding::unknown;
  std::optional<WholeFrame> frame;  // its GPU cost; none without samples
  PresetLosses losses;
  double gpu_ns() const { return frame ? frame->cost.gpu_ns() : 0.0; }
  int place = 0;  // in its part, from 1; rows that the model cannot distinguish share the first one's
  const nlohmann::ordered_json* config = nullptr;  // of the run that measured the case
  std::string unseen{};                            // why it sees no light that could rank it; "": it sees one
};

// The list rows that a conclusion recommends, by increasing cost: those in first place. Presets modelled from memory
// are recommended only if all are.
std::vector<const RankedPreset*> recommended_presets(const std::vector<RankedPreset>& rows);

// Reasons for and against a case. `first`: of its part.
std::string preset_reason(const RankedPreset& row, const RankedPreset& first);

// The recommendation: alternatives, cost difference, confidence. `rows`: all of one view, best first.
std::string preset_conclusion(const std::vector<RankedPreset>& rows);

}  // namespace clusterbench::report
