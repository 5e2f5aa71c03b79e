#pragma once
// A level before and after a change: which figures of its cases have moved, from what to what.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

class BaselineCases;

// Lights of each camera, then entries, bytes and the longest list of each case: those that differ from the baseline's,
// with frame and cell of the new ones where the result tells them. One line where nothing differs.
std::string baseline_changes_text(const result::Result& result, const BaselineCases& baseline);

}  // namespace clusterbench::report
