#pragma once
// The methods of this program on the frame of a dump, beside the lists that are judged.

#include <string>
#include <vector>

#include "dump/dump_frame.h"
#include "result/documents/check.h"

namespace clusterbench::dump {

struct MethodChoice {
  enum class Which : std::uint8_t { none, quick, all, named } which = Which::none;
  std::vector<std::string> names{};  // where they are named
};
// Cells and true pairs of a frame, together, on which quick runs the methods: about a second each at the most. The
// choice does not depend on times, so that it is the same on every machine.
inline constexpr std::uint64_t k_most_quick_steps = 4'000'000;

// "none", "quick", "all", or names with commas. Throws Error ("", "--methods") for a name that no method has.
MethodChoice method_choice(const std::string& text);

// Fills `methods` and `methods_left_out`. Throws Error ("", "--methods") for a named method that makes no lists of this
// grid.
void add_methods(const DumpFrame& frame, const assign::Lists& truth, const MethodChoice& choice,
                 result::CheckedDump& out);

}  // namespace clusterbench::dump
