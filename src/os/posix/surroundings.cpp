#include "os/surroundings.h"

#include <fcntl.h>
#include <unistd.h>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "os/guarded_process.h"
#include "os/kept_files.h"

namespace clusterbench::os {
namespace {

const void* handler_of(int number) {
  struct sigaction action {};
  if (::sigaction(number, nullptr, &action) != 0) return nullptr;
  return reinterpret_cast<const void*>(action.sa_handler);
}

std::string working_folder() {
  std::error_code failed;
  return std::filesystem::current_path(failed).string();
}

std::string locale_name() {
  const char* name = std::setlocale(LC_ALL, nullptr);
  return name == nullptr ? "" : name;
}

}  // namespace

Surroundings::Surroundings() : folder_(working_folder()), locale_(locale_name()) {
  for (std::size_t i = 1; i < k_signals; ++i) handlers_[i] = handler_of(static_cast<int>(i));
}

std::vector<std::string> Surroundings::changes() const {
  std::vector<std::string> all;
  for (std::size_t i = 1; i < k_signals; ++i)
    if (handler_of(static_cast<int>(i)) != handlers_[i])
      all.push_back("the handler of " + signal_name(static_cast<int>(i)));
  if (const std::string now = working_folder(); now != folder_) all.push_back("the working directory, to " + now);
  if (const std::string now = locale_name(); now != locale_) all.push_back("the locale, to " + now);
  return all;
}

CaughtOutput::CaughtOutput() : before_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3)) {
  std::fflush(stdout);
  ::dup2(static_cast<int>(file_.descriptor()), STDOUT_FILENO);
  keep_standard_files();
}

CaughtOutput::~CaughtOutput() {
  const std::string printed = text();
  ::dup2(before_, STDOUT_FILENO);
  ::close(before_);
  keep_standard_files();
  if (!printed.empty()) std::fprintf(stderr, "%s\n", printed.c_str());
}

std::string CaughtOutput::text() const {
  std::fflush(stdout);
  return file_.tail();
}

}  // namespace clusterbench::os
