#pragma once
// Patterns in place of assigners' names: "*-fast".

#include <string>
#include <vector>

namespace clusterbench::config {

bool is_glob(const std::string& name);
// In the registry's order; patterns as in core/wildcards.h. Methods that run only if named (naive ones, and those that
// need depth) are matched only if the pattern matches no other method ("naive-*"). Throws Error with `file` and `where`
// if none matches.
std::vector<std::string> matching_assigners(const std::string& pattern, const std::string& file,
                                            const std::string& where);

}  // namespace clusterbench::config
