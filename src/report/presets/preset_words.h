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

// Whether the model cannot tell two costs apart: they are nearly the same, or which is less turns with the prices.
bool are_alike(const measure::FrameCost& less, const measure::FrameCost& more);

// In which part of a ranking a case stands, best first.
enum class PresetStanding : std::uint8_t { lists, searched, lacks_lights, unknown };
const char* name_of(PresetStanding standing);  // "lists", "searched", "lacks_lights", "unknown"

struct RankedPreset {
  const result::Case* result_case = nullptr;
  PresetStanding standing = PresetStanding::unknown;
  std::optional<WholeFrame> frame;  // what it costs the GPU; none without samples
  PresetLosses losses;
  double gpu_ns() const { return frame ? frame->cost.gpu_ns() : 0.0; }
  int place = 0;  // in its part, from 1; those that the model cannot tell apart share the first one's
  const nlohmann::ordered_json* config = nullptr;  // that the case was measured by
  std::string unseen{};                            // why nothing is seen by which it could be ranked; "": something is
};

// The lists' rows that a conclusion takes, the cheapest first: those of the first place, but that what is known from
// memory alone is taken only where all is.
std::vector<const RankedPreset*> taken_presets(const std::vector<RankedPreset>& rows);

// What speaks for and against a case. `first`: of its part.
std::string preset_reason(const RankedPreset& row, const RankedPreset& first);

// What to take, against what, by how much, and how sure that is. All rows of one view, best first.
std::string preset_conclusion(const std::vector<RankedPreset>& rows);

}  // namespace clusterbench::report
