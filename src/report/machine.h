#pragma once
// The machine of a result, as JSON and by a name that no other kind of processor has.

#include <nlohmann/json.hpp>
#include <string>

#include "run/result.h"

namespace clusterbench::report {

nlohmann::ordered_json machine_to_json(const run::MachineFacts& machine);

// What it is, without how it was just then: clock and load.
nlohmann::ordered_json without_state(nlohmann::ordered_json machine);

// "AMD EPYC (family 26, model 2, stepping 1; L1d 48 KiB, L1i 32 KiB, L2 1 MiB, L3 32 MiB)" of a result's `machine`; of
// an older one, which does not know all of that, less.
std::string machine_name(const nlohmann::ordered_json& machine);

}  // namespace clusterbench::report
