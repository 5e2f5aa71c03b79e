#pragma once
// What a preset costs the GPU in a frame by the model of config.cost: of its figures those that carry over to the
// engine. Lists of a GPU's shader or rasteriser are not uploaded; the time that the method takes here is not the
// engine's and is left out.

#include <nlohmann/json.hpp>
#include <optional>

namespace clusterbench::report {

struct PresetCost {
  double upload_ns = 0.0;          // of the lists, where the engine assigns on the CPU
  double read_ns = 0.0;            // of what samples read to know their lights
  double shade_ns = 0.0;           // of the lights that they loop over
  bool is_searched = false;        // samples search the structure: what they read is priced, and on no GPU measured
  bool has_random_depths = false;  // of samples at random depths, since there are no surfaces

  double sum_ns() const { return upload_ns + read_ns + shade_ns; }
};

// Of a case of a preset; none without samples.
std::optional<PresetCost> preset_cost(const nlohmann::ordered_json& result_case, const nlohmann::ordered_json& config);

// Beyond so many times another's cost a cost is a higher one, whatever the prices: samples of some frames tell no less.
inline constexpr double k_alike_ratio = 1.05;
// Prices of uploading, reading and looping, each of which can be so many times lower or higher on the GPU at hand.
inline constexpr double k_price_factor = 2.0;

// Whether the model cannot tell two costs apart: they are nearly the same, or which is less turns with the prices.
bool are_alike(const PresetCost& less, const PresetCost& more);

}  // namespace clusterbench::report
