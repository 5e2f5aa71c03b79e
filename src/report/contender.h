#pragma once
// A case of a result file as what is judged beside other cases.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run/gate.h"

namespace clusterbench::report {

run::Contender contender_of(const nlohmann::ordered_json& result_case);

// The frame times of a case's rounds; empty where it has none.
std::vector<double> frame_rounds(const nlohmann::ordered_json& result_case);

// What resampling begins with.
std::uint64_t seed_of(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
