#pragma once
// Two results side by side: what is counted must be equal or better, what is timed gets a verdict per case.
// docs/comparing.md says how a verdict is found.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"

namespace clusterbench::report {

// "machine.cpu: 'A' and 'B'" for each field in which two results differ and that their times or instructions depend on.
// None where neither are compared, and where times were measured side by side (run --baseline-binary).
std::vector<std::string> obstacles(const nlohmann::ordered_json& base, const nlohmann::ordered_json& next);

// As src/run/schemas/comparison.schema.json says. `threshold`: the smallest change of time that matters, 0.02 for 2 %.
// Times: of rounds side by side where the new result has them for this base ("data": "paired"), else of medians
// ("separate").
nlohmann::ordered_json compare_results(const nlohmann::ordered_json& base, const nlohmann::ordered_json& next,
                                       double threshold);

// ok, gate_failed (a failure), nothing_comparable (no case in common); with `is_strict` inconclusive where a verdict
// is, or a case of the base is missing.
ExitCode outcome(const nlohmann::ordered_json& comparison, bool is_strict);

// For people: the table, and the same for a pull request.
std::string comparison_text(const nlohmann::ordered_json& comparison);
std::string comparison_markdown(const nlohmann::ordered_json& comparison);

}  // namespace clusterbench::report
