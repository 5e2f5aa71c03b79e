#pragma once
// A case of a result file as a contender in a ranking.

#include <cstdint>
#include <string>
#include <vector>

#include "result/result.h"
#include "run/findings/gate.h"

namespace clusterbench::report {

// The quantity that ranks cases.
enum class RankBy : std::uint8_t { frame_time, frame_cost };
RankBy rank_by(const result::Result& result);  // from its configuration

// Whether a case can be recommended: it passes all gates, and ranking samples miss no more lights than rounding causes.
bool loses_nothing_seen(const result::Case& result_case);

// A case that loses lights, or whose samples search the structure, is not eligible: the cost of the search was not
// measured. Nor is one whose method runs on a device. Overshade is that of the ranking samples if there are any, else
// of points of the whole view. By cost, the time interval of a case is moved by the modelled cost; without timing it is
// the modelled cost alone. Overshade is part of the cost. A case without this cost is not eligible: if an engine makes
// its lists on a GPU, their time is unknown.
run::Contender contender_of(const result::Case& result_case, RankBy by = RankBy::frame_time);

// From the method (assign/contract/assigner.h).
int slowness_of(const result::Case& result_case);

// Whether the method draws lights and makes no lists.
bool draws_lights(const result::Case& result_case);

// Whether each sample searches the structure for lights: only the model prices that, so these cases rank separately.
bool samples_search(const result::Case& result_case);

// Whether the method runs on a device, whose times are not those of the processor: these cases rank separately.
bool runs_on_device(const result::Case& result_case);

// Whether a method's lists contain only lights of visible opaque surfaces.
bool is_at_surfaces(const std::string& assigner);
// The limitation of such a method, for users: "lights visible opaque surfaces alone: ..."; "" for others.
std::string at_surfaces_text(const std::string& assigner);

// True if the case's times on a device are a processor's (lavapipe, SwiftShader): they rank nothing.
bool is_on_software_device(const result::Result& result, const result::Case& result_case);

// The frame times of a case's rounds; empty without timing.
std::vector<double> frame_rounds(const result::Case& result_case);

// The seed of resampling.
std::uint64_t seed_of(const result::Result& result);

}  // namespace clusterbench::report
