#pragma once
// Patterns in place of assigners' names: "*-fast".

#include <string>
#include <vector>

namespace clusterbench::config {

bool is_glob(const std::string& name);
// In the registry's order; as fnmatch does it. Methods that run only where they are named (naive ones, and those that
// need depth) only where the pattern matches nothing else ("naive-*"). Throws Error with `file` and `where` if none
// match.
std::vector<std::string> matching_assigners(const std::string& pattern, const std::string& file,
                                            const std::string& where);

}  // namespace clusterbench::config
