#pragma once
// A case compared with the same case without a feature, in tables.

#include <optional>
#include <string>

#include "result/frames.h"

namespace clusterbench::report {

// The relative increase by the feature, from the saved share: "+12.5 %"; "-" if unknown.
std::string against_other(const std::optional<double>& saved);
// The same for lights per sample, of the first set of samples; that is the whole view, if requested.
std::string evaluated_against_other(const result::Saved& saved);

}  // namespace clusterbench::report
