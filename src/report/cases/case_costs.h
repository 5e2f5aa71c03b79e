#pragma once
// The cost model of a configuration (config.cost) over the cases of a result: measure/statistics/frame_cost.h.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "measure/samples/shading.h"
#include "measure/statistics/frame_cost.h"
#include "report/cases/sample_sets.h"
#include "result/case.h"

namespace clusterbench::report {

// Gives each case with samples that have a weight its `cost`, anew where it has one. Nothing where the configuration
// has no model: an older result. Of a preset whose engine makes its lists on a GPU nothing is uploaded, and there is no
// time of making them: that of a stand-in here is not the engine's.
// Its sets say what samples are given and need, by the sets that cost something: what a rank by cost rests on.
void add_costs(std::vector<result::Case>& cases, const nlohmann::ordered_json& config);

// The model with the constants of config.cost. Results from before reading had a price have none for it: it is 0.
measure::CostModel cost_model_of(const nlohmann::ordered_json& constants);
// What a set's samples loop over and read, per sample; `samples`: how many of them a frame shades. Nothing is read
// where lights are drawn, whose traffic is paid by itself. `wave`: config.cost.wave.
measure::ShadedSamples shaded_samples(const result::Case& result_case, const result::SampleSet& counts, double samples,
                                      const std::string& wave);

// What a frame costs the GPU, by the model.
struct WholeFrame {
  measure::FrameCost cost;         // without the time to make the lists
  bool has_random_depths = false;  // of samples that no surface holds
};
// As `cost` has it; where that is not there, by samples of the whole view that stand for the picture's pixels. None
// without samples, and of a result without a model.
std::optional<WholeFrame> whole_frame(const result::Case& result_case, const nlohmann::ordered_json& config);

// Whether a case is of a preset whose engine makes its lists on a GPU.
bool makes_lists_on_gpu(const result::Case& result_case);

// Samples that need fewer lights cannot show that at most k_most_unlit of them are lacking, since one of them would be
// more; and what they loop over is a rough mean.
inline constexpr double k_least_needed_to_choose = 1.0 / measure::k_most_unlit;

}  // namespace clusterbench::report
