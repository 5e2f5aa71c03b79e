#pragma once
// What speaks against the times of a result, and what to try.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// A line for each kind of doubt, with the worst of the cases: intervals wider than 10 % on either side, times in two
// groups, other programs or guests at work, processors that were too hot. "" without a doubt.
std::string timing_warnings(const nlohmann::ordered_json& cases);

}  // namespace clusterbench::report
