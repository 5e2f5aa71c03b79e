#pragma once
// Whether cases have any visible light, so that a choice between them has a basis.

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

// Whether samples (report/cases/case_samples.h) rank the cases.
enum class RankedBy : std::uint8_t { samples, no_samples };

inline constexpr const char* k_all_lights_dark = "all lights in view are dark (intensity 0 or black) in all frames";

// Number of points and spots of a result's scene that emit no light; 0 also for results older than this count.
std::uint64_t dark_lights(const result::Scene& scene);

// For cases of one scene and viewport: why there is no basis for a choice, such as "no light is in view in any frame":
// every case would be equally good, or better the more it leaves out. "" if a light is seen.
std::string why_nothing_is_seen(const std::vector<const result::Case*>& cases, RankedBy by);

// Why a figure of samples is not known in any case. "" if a case has samples of it, and for other figures.
std::string why_no_samples(const std::vector<const result::Case*>& cases, const std::string& figure);
// The same, only if no case has a set for the samples.
std::string why_no_sets(const std::vector<const result::Case*>& cases, const std::string& figure);

// The ids of the cases of a result that have no such basis.
std::set<std::string> ids_of_nothing_seen(const std::vector<result::Case>& cases);

// "level, camera walk: all lights in view are dark ..." for each such camera of the result.
std::vector<std::string> views_of_dark_lights(const result::Result& result);

}  // namespace clusterbench::report
