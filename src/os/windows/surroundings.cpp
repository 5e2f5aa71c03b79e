#include "os/surroundings.h"

#include <clocale>
#include <filesystem>

namespace clusterbench::os {
namespace {

std::string working_folder() {
  std::error_code failed;
  return std::filesystem::current_path(failed).string();
}

std::string locale_name() {
  const char* name = std::setlocale(LC_ALL, nullptr);
  return name == nullptr ? "" : name;
}

}  // namespace

// Handlers of signals cannot be asked for.
std::vector<Surroundings::Part> Surroundings::parts() {
  return {{"the working directory", working_folder(), true}, {"the locale", locale_name(), true}};
}

// What a plug-in prints is not looked at.
CaughtOutput::CaughtOutput() : before_(-1) {}
CaughtOutput::~CaughtOutput() = default;

std::string CaughtOutput::text() const {
  return "";
}

}  // namespace clusterbench::os
