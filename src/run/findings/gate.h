#pragma once
// What a case is judged by: whether it fails its run, loses lights, and stands on its scene's front.

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

// A conservative method that lost a light, in lists or, without cells, at samples; an exact one with any difference;
// more dropped pairs than the limits allow.
std::vector<Failure> failures_of(const CaseResult& result, const config::LimitsRequest& limits);

// What is to be known of a case before its figures are believed, and fails nothing.
std::vector<Warning> warnings_of(const CaseResult& result);

// Whether a shader that loops over what the case gives lacks lights: pairs that are not listed or were dropped, lights
// that are missed at samples though the structure has no cells to look up, or more than measure::k_most_unlit of those
// that visible surfaces need; without surfaces, of those that random points in the view need.
bool loses_lights(const CaseResult& result);

// Whether what a case does not lose here it loses nowhere: its method is conservative, exact, or an engine's as a
// preset has it, whose losses are the engine's own.
bool is_sound(const CaseResult& result);

// Whether a case may stand on a front, and be the best that others are measured by: it fails nothing and loses no
// lights, and not by luck (is_sound). Short lists are no merit else.
bool is_eligible(const CaseResult& result);

// A case beside others. Results are continued and merged from files, so this is apart from CaseResult.
struct Contender {
  std::string id;
  // Only cases that see the same can beat each other: an empty view costs less than a full one in every respect.
  std::string scene, view;
  measure::Costs costs;
  bool is_eligible = true;
  // Cases of one session are measured by the same launches, and those of one grid among them in the same rounds.
  std::string grid, session;
  std::vector<double> rounds_ns;  // frame times, launch after launch; empty where nothing is timed
  int launches = 1;
  bool is_cold = false;
};

// Frame time of `numerator` / that of `denominator`, of cases of one scene and view: of their rounds where those are
// the same, else of their launches. nullopt where neither can be: of two sessions nothing is known side by side.
std::optional<measure::Ratio> ratio_between(const Contender& numerator, const Contender& denominator,
                                            std::uint64_t seed);

// Ids of the cases that no other case of their scene and view beats in time, bytes and overshade together. Times are
// told apart by their ratio, as `clusterbench ratio` has it, and where there is none by their intervals.
std::vector<std::string> on_front(std::span<const Contender> cases, std::uint64_t seed);

}  // namespace clusterbench::run
