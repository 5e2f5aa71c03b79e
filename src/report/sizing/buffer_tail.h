#pragma once
// The probability that a frame that was not recorded exceeds a buffer: words and figures of
// measure/statistics/peaks_over_threshold.h.

#include <optional>
#include <string>

#include "measure/statistics/peaks_over_threshold.h"
#include "report/sizing/sized_structure.h"
#include "result/documents/size.h"

namespace clusterbench::report {

// Over all cameras. None for a buffer that no frame can exceed, whose need is equal in all frames, or without frames.
std::optional<measure::TailEstimate> tail_of(const SizedBuffer& buffer);

// "indices: above 51398 in no frame, as far as the fit tells (at most 1 in 30000); 1 in 10^5 frames above 31000 (at
// most 35000)", and reasons to doubt it; or "indices: no estimate: 7 of the 20 independent peaks it needs ...". "" if
// no estimate is necessary.
std::string tail_text(const SizedBuffer& buffer);

// None if no estimate is necessary; only a refusal if none is possible.
std::optional<result::BeyondThePath> beyond_the_path(const SizedBuffer& buffer);

// "1 in 30000", "1 in 10^7", "never" for 0. One digit, so that it does not look too precise.
std::string one_in_text(double chance);

}  // namespace clusterbench::report
