#pragma once
// In which settings two cases differ that have one name, or stand for one another before and after a change.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::report {

// Of a result and a case of it each. Empty: none that results tell.
std::vector<std::string> differing_settings(const nlohmann::ordered_json& base, const nlohmann::ordered_json& base_case,
                                            const nlohmann::ordered_json& next,
                                            const nlohmann::ordered_json& next_case);

}  // namespace clusterbench::report
