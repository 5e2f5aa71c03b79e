#include "os/environment.h"

#include <cstdlib>
#include <sstream>

extern "C" char** environ;  // NOLINT(readability-redundant-declaration): glibc has it in a header, POSIX in none

namespace clusterbench::os {

std::optional<std::string> variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::vector<std::string> environment_variables() {
  std::vector<std::string> all;
  for (char** one = environ; one != nullptr && *one != nullptr; ++one) all.emplace_back(*one);
  return all;
}

std::vector<std::string> folders_in_variable(const std::string& name) {
  std::istringstream list(variable(name).value_or(""));
  std::vector<std::string> folders;
  for (std::string folder; std::getline(list, folder, ':');)
    if (!folder.empty()) folders.push_back(folder);
  return folders;
}

void take_arguments(int&, char**&) {}

}  // namespace clusterbench::os
