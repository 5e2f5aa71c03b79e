#pragma once
// A level before and after a change: the figures of its cases that differ, with both values.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

class BaselineCases;

// Lights of each camera, then entries, bytes and the longest list of each case: those that differ from the baseline's,
// with the new frame and cell if known. One line if nothing differs.
std::string baseline_changes_text(const result::Result& result, const BaselineCases& baseline);

}  // namespace clusterbench::report
