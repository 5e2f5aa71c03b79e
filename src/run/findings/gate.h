#pragma once
// The checks of a case: whether it fails its run, loses lights, or is on its scene's front.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/config.h"
#include "measure/statistics/front.h"
#include "measure/statistics/side_by_side.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

const char* name_of(Failure::Kind kind);  // "lost_pairs", ...
const char* name_of(Warning::Kind kind);  // "unlit", ...

// A conservative method that lost a light (in lists or, without cells, at samples); an exact one with any difference;
// more dropped pairs than the limits allow.
std::vector<Failure> failures_of(const CaseResult& result, const config::LimitsRequest& limits);

// Facts that a reader must know before trusting a case's figures; they fail nothing.
std::vector<Warning> warnings_of(const CaseResult& result);

// Whether a shader that loops over the case's lists misses lights: pairs that are not listed or were dropped, missed
// lights at samples of a structure without cells, or more than measure::k_most_unlit of the lights that visible
// surfaces need; without surfaces, of those that random points in the view need.
bool loses_lights(const CaseResult& result);

// Whether a case that loses nothing here loses nothing anywhere: its method is conservative, exact, or an engine's
// method as in its preset, whose losses are the engine's own.
bool is_sound(const CaseResult& result);

// Whether a case may be on a front and be the best case for comparisons: it fails nothing, loses no lights, and not by
// luck (is_sound). Otherwise short lists would count as an advantage.
bool is_eligible(const CaseResult& result);

// The figures of a case for comparison with other cases. Results are also continued and merged from files, so this is
// separate from CaseResult.
struct Contender {
  std::string id;
  // Only cases with the same view can beat each other: an empty view is cheaper than a full one in every respect.
  std::string scene, view;
  measure::Costs costs;
  bool is_eligible = true;
  // Cases of one session are measured by the same launches, and those of one grid in the same rounds.
  std::string grid, session;
  std::vector<double> rounds_ns;  // frame times, launch after launch; empty without timing
  int launches = 1;
  bool is_cold = false;
};

// Frame time of `numerator` / that of `denominator`, for cases of one scene and view: from common rounds if they have
// them, else from common launches. nullopt for two sessions: their times cannot be compared.
std::optional<measure::Ratio> ratio_between(const Contender& numerator, const Contender& denominator,
                                            std::uint64_t seed);

// Ids of the cases that no other case of their scene and view beats in time, bytes and overshade together. Times are
// compared by their ratio, as in `clusterbench ratio`, and without a ratio by their intervals.
std::vector<std::string> on_front(std::span<const Contender> cases, std::uint64_t seed);

}  // namespace clusterbench::run
