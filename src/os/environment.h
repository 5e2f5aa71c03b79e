#pragma once
// Variables of the environment, in UTF-8.

#include <optional>
#include <string>
#include <vector>

namespace clusterbench::os {

// nullopt if it is not set.
std::optional<std::string> variable(const std::string& name);

// All of them, as "NAME=VALUE".
std::vector<std::string> environment_variables();

// The folders in a variable like PATH, without empty ones; none if it is not set.
std::vector<std::string> folders_in_variable(const std::string& name);

// The arguments of main() in UTF-8, in which Windows does not hand them over.
void take_arguments(int& count, char**& arguments);

}  // namespace clusterbench::os
