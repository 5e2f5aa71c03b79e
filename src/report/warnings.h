#pragma once
// What a result's reader has to know before believing it.

#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::report {

// Lines that begin with "note: ": where lights end that have no range. "" where all have one.
std::string notes_text(const nlohmann::ordered_json& result);

// Lines that begin with "warning: ": of scenes (cameras not measured ...), then of cases (dropped, undecided and unlit
// lights). "" where there are none.
std::string warnings_text(const nlohmann::ordered_json& result);

}  // namespace clusterbench::report
