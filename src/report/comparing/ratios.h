#pragma once
// Ratios of times between methods. Cases of one scene, camera, viewport and grid are measured in the same rounds, so
// any two of them have a ratio, round by round, that is far more stable than their times. Cases of different grids have
// one launch by launch (measure/statistics/side_by_side.h).

#include <optional>
#include <string>
#include <vector>

#include "measure/statistics/time_statistics.h"
#include "report/cases/contender.h"
#include "result/documents/page.h"
#include "result/documents/ratios.h"

namespace clusterbench::report {

// Frame time (or cost) of `numerator` / that of `denominator`, two cases of a grid; nullopt if different launches
// measured them.
std::optional<measure::Ratio> ratio_of_cases(const result::Result& result, const result::Case& numerator,
                                             const result::Case& denominator, RankBy by = RankBy::frame_time);

// True only if that ratio is above 1 with 95 % certainty.
bool takes_longer(const result::Result& result, const result::Case& numerator, const result::Case& denominator,
                  RankBy by = RankBy::frame_time);

struct RatioRequest {
  std::string methods;        // a regular expression; empty: all
  bool across_grids = false;  // all grids of a scene, camera and viewport together
};

// For each grid (or view) the timed cases, the fastest first, and the ratio of any two, the slower divided by the
// faster: docs/results.md. No blocks without times.
result::Ratios ratios_of(const result::Result& result, const RatioRequest& request);

// For each timed case with lists its place in a ranking over all grids of its scene, camera and viewport, for the page.
std::vector<result::Ranked> ratio_rankings(const result::Result& result);

// `ratios`: of ratios_of(). A ranking that compares each case with the fastest one and the one before it, or with
// `all_pairs` with each faster one.
std::string ratio_table(const result::Ratios& ratios, bool all_pairs);
std::string ratio_markdown(const result::Ratios& ratios, bool all_pairs);
// All pairs, in both directions; an unknown interval is empty.
std::string ratio_csv(const result::Ratios& ratios);

}  // namespace clusterbench::report
