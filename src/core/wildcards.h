#pragma once
// Patterns of names, as shells have them.

#include <string_view>

namespace clusterbench {

// `*`: any text; `?`: any byte; `[a-f]` and `[!a-f]`: one byte that is, or is not, among these; `\`: the next byte as
// it is. A '[' without its ']' stands for itself. As fnmatch(3) without flags in the locale C, but for its named
// classes. Takes time in proportion to both lengths multiplied.
bool matches_wildcards(std::string_view pattern, std::string_view text);

}  // namespace clusterbench
