#pragma once
// What a result's reader has to know before believing it.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

// Lines that begin with "note: ": where lights end that have no range. "" where all have one.
std::string notes_text(const result::Result& result);

// Lines that begin with "warning: ": of scenes (cameras not measured ...), then of cases (dropped, undecided and unlit
// lights). "" where there are none.
std::string warnings_text(const result::Result& result);

}  // namespace clusterbench::report
