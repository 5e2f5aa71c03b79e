#pragma once
// A case beside the same case without something, in tables.

#include <optional>
#include <string>

#include "result/frames.h"

namespace clusterbench::report {

// How much more it is than without, of the share that is saved: "+12.5 %"; "-" where nothing is known.
std::string against_other(const std::optional<double>& saved);
// Lights that samples loop over: of the sets of samples the first one, which is that of the whole view where that is
// asked for.
std::string evaluated_against_other(const result::Saved& saved);

}  // namespace clusterbench::report
