#pragma once
// Whether cases see anything that a choice among them could rest on.

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// What cases are ranked by: the samples that rank them (report/cases/sample_sets.h), or nothing that a sample says.
enum class RankedBy : std::uint8_t { samples, no_samples };

inline constexpr const char* k_all_lights_dark = "all lights in view are dark (intensity 0 or black) in all frames";

// Of the points and spots of a result's scene those that light nothing; 0 also in results that are older than this
// count.
std::uint64_t dark_lights(const result::Scene& scene);

// Of cases on one scene and viewport: why nothing can be said of which of them to take, as "no light is in view in any
// frame": each would be as good as another, or better for what it leaves out. "" where something is seen.
std::string why_nothing_is_seen(const std::vector<const result::Case*>& cases, RankedBy by);

// The same of a result's cases: those on which nothing can be chosen.
std::set<std::string> ids_of_nothing_seen(const std::vector<result::Case>& cases);

// "level, camera walk: all lights in view are dark ..." of each camera of the result of which this is so.
std::vector<std::string> views_of_dark_lights(const result::Result& result);

}  // namespace clusterbench::report
