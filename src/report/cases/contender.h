#pragma once
// A case of a result file as what is judged beside other cases.

#include <cstdint>
#include <string>
#include <vector>

#include "result/result.h"
#include "run/findings/gate.h"

namespace clusterbench::report {

// What cases are ranked by.
enum class RankBy : std::uint8_t { frame_time, frame_cost };
RankBy rank_by(const result::Result& result);  // as its configuration says

// Whether it may be the answer: no gate holds it back, and samples that cost something lack no more lights than
// rounding leaves out.
bool loses_nothing_seen(const result::Case& result_case);

// A case that loses something, or that samples search, is never eligible: what the search costs was not measured.
// Overshade is that of samples that cost something, where there are any, else of points of the whole view. By its cost
// a case takes its time and, with certainty, what the model adds; overshade is in it. Where nothing is timed that is
// all. One without that cost is not eligible: an engine's time is not known where its lists are a GPU's.
run::Contender contender_of(const result::Case& result_case, RankBy by = RankBy::frame_time);

// Of its method (assign/contract/assigner.h).
int slowness_of(const result::Case& result_case);

// Whether its method draws lights, and leaves no lists.
bool draws_lights(const result::Case& result_case);

// Whether each sample searches its structure for lights: priced by the model only, and so ranked apart.
bool samples_search(const result::Case& result_case);

// Whether a method's lists hold the lights of visible opaque surfaces alone.
bool is_at_surfaces(const std::string& assigner);
// What to know of a method before it is taken whose lists are such: "lights visible opaque surfaces alone: ..."; "" of
// others.
std::string at_surfaces_text(const std::string& assigner);

// The frame times of a case's rounds; empty where it has none.
std::vector<double> frame_rounds(const result::Case& result_case);

// What resampling begins with.
std::uint64_t seed_of(const result::Result& result);

}  // namespace clusterbench::report
