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
Surroundings::Surroundings() : folder_(working_folder()), locale_(locale_name()) {}

std::vector<std::string> Surroundings::changes() const {
  std::vector<std::string> all;
  if (const std::string now = working_folder(); now != folder_) all.push_back("the working directory, to " + now);
  if (const std::string now = locale_name(); now != locale_) all.push_back("the locale, to " + now);
  return all;
}

// What a plug-in prints is not looked at.
CaughtOutput::CaughtOutput() : before_(-1) {}
CaughtOutput::~CaughtOutput() = default;

std::string CaughtOutput::text() const {
  return "";
}

}  // namespace clusterbench::os
