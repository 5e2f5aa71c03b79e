#pragma once
// The cost model of a configuration (config.cost) over the cases of a result: measure/frame_cost.h.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "measure/frame_cost.h"

namespace clusterbench::report {

// Gives each case with samples that have a weight its `cost`, anew where it has one. Nothing where the configuration
// has no model: an older result.
// Its sets say what samples are given and need, by the sets that cost something: what a rank by cost rests on.
void add_costs(nlohmann::ordered_json& cases, const nlohmann::ordered_json& config);

// The model with the constants of config.cost. Results from before reading had a price have none for it: it is 0.
measure::CostModel cost_model_of(const nlohmann::ordered_json& constants);
// What a set's samples loop over and read, per sample; `samples`: how many of them a frame shades. Nothing is read
// where lights are drawn, whose traffic is paid by itself. `wave`: config.cost.wave.
measure::ShadedSamples shaded_samples(const nlohmann::ordered_json& result_case, const nlohmann::ordered_json& counts,
                                      double samples, const std::string& wave);

// What a frame pays beside its frame time, by the model.
struct WholeFrame {
  double gpu_ns = 0.0;
  bool has_random_depths = false;  // of samples that no surface holds
};
// As `cost` has it; where that is not there, by samples of the whole view that stand for the picture's pixels. None
// without samples, and of a result without a model.
std::optional<WholeFrame> whole_frame(const nlohmann::ordered_json& result_case, const nlohmann::ordered_json& config);

}  // namespace clusterbench::report
