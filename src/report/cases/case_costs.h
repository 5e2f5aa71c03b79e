#pragma once
// Applies the cost model of a configuration (config.cost, measure/statistics/frame_cost.h) to the cases of a result.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "measure/samples/shading.h"
#include "measure/statistics/frame_cost.h"
#include "report/cases/case_samples.h"
#include "result/case.h"

namespace clusterbench::report {

// Computes the `cost` of each case that has samples with a weight, and replaces an older one. No effect if the
// configuration has no model (an older result). For a preset whose engine makes its lists on a GPU, upload is 0 and
// there is no time for making them: the time of this program's CPU method is not the engine's.
// The sets in `cost` record the returned and needed lights of the ranking sets: the basis of a rank by cost.
void add_costs(std::vector<result::Case>& cases, const nlohmann::ordered_json& config);

// The model with the constants of config.cost. In results older than the price of reads, reads cost 0.
measure::CostModel cost_model_of(const nlohmann::ordered_json& constants);
// Lights and reads per sample of a set; `samples`: their number per frame. Drawn lights have no reads, since their
// traffic is priced separately. `wave`: config.cost.wave.
measure::ShadedSamples shaded_samples(const result::Case& result_case, const result::SampleSet& counts, double samples,
                                      const std::string& wave);

// The modelled GPU cost of a frame.
struct WholeFrame {
  measure::FrameCost cost;         // without the time to make the lists
  bool has_random_depths = false;  // of samples that are not on surfaces
};
// From `cost`; if that is missing, from samples of the whole view, one per pixel of the picture. None without samples,
// and for a result without a model.
std::optional<WholeFrame> whole_frame(const result::Case& result_case, const nlohmann::ordered_json& config);

// Whether a case is of a preset whose engine makes its lists on a GPU, or its own method runs on a device.
bool makes_lists_on_gpu(const result::Case& result_case);

// Samples that need fewer lights cannot show that the missed share is at most k_most_unlit: a single missed light would
// exceed it. Their mean of lights per sample is also imprecise.
inline constexpr double k_least_needed_to_choose = 1.0 / measure::k_most_unlit;

}  // namespace clusterbench::report
