#pragma once
// Notes and warnings for the reader of a result.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Lines that begin with "note: ": the computed end of lights without a range. "" if all have one.
std::string notes_text(const result::Result& result);

// Lines that begin with "warning: ": on scenes (cameras not measured ...), then on cases (dropped, undecided and unlit
// lights). "" without any.
std::string warnings_text(const result::Result& result);

// Lines that begin with "warning: ": methods that cannot run on this machine, once for each reason. "" without any.
std::string unable_text(const std::vector<result::Skipped>& skipped);

}  // namespace clusterbench::report
