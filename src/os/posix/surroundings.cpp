#include "os/surroundings.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <clocale>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "os/guarded_process.h"
#include "os/kept_files.h"
#include "os/posix/system_calls.h"

namespace clusterbench::os {
namespace {

constexpr int k_signals = 65;

std::string handler_of(int number) {
  struct sigaction action {};
  if (::sigaction(number, nullptr, &action) != 0) return "";
  return std::to_string(reinterpret_cast<std::uintptr_t>(action.sa_handler));
}

// Of this thread.
std::string blocked_signals() {
  sigset_t blocked;
  sigemptyset(&blocked);
  ::pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
  std::string text;
  for (int i = 1; i < k_signals; ++i)
    if (sigismember(&blocked, i) == 1) text += (text.empty() ? "" : " ") + signal_name(i);
  return text.empty() ? "none" : text;
}

std::string working_folder() {
  std::error_code failed;
  return std::filesystem::current_path(failed).string();
}

std::string locale_name() {
  const char* name = std::setlocale(LC_ALL, nullptr);
  return name == nullptr ? "" : name;
}

// It can only be read by setting it.
std::string mask_of_files() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  char text[16];
  std::snprintf(text, sizeof text, "%03o", static_cast<unsigned>(mask));
  return text;
}

constexpr std::pair<const char*, int> k_limits[] = {
    {"RLIMIT_AS", RLIMIT_AS},         {"RLIMIT_CORE", RLIMIT_CORE},   {"RLIMIT_CPU", RLIMIT_CPU},
    {"RLIMIT_DATA", RLIMIT_DATA},     {"RLIMIT_FSIZE", RLIMIT_FSIZE}, {"RLIMIT_MEMLOCK", RLIMIT_MEMLOCK},
    {"RLIMIT_NOFILE", RLIMIT_NOFILE}, {"RLIMIT_NPROC", RLIMIT_NPROC}, {"RLIMIT_STACK", RLIMIT_STACK},
};

std::string limit_of(int resource) {
  rlimit limit{};
  if (::getrlimit(static_cast<decltype(RLIMIT_AS)>(resource), &limit) != 0) return "";
  const auto text = [](rlim_t value) { return value == RLIM_INFINITY ? "no limit" : std::to_string(value); };
  return text(limit.rlim_cur) + " (at most " + text(limit.rlim_max) + ")";
}

}  // namespace

std::vector<Surroundings::Part> Surroundings::parts() {
  std::vector<Part> all;
  for (int i = 1; i < k_signals; ++i) all.push_back({"the handler of " + signal_name(i), handler_of(i), false});
  all.push_back({"the blocked signals", blocked_signals(), true});
  all.push_back({"the working directory", working_folder(), true});
  all.push_back({"the locale", locale_name(), true});
  all.push_back({"the mask of new files (umask)", mask_of_files(), true});
  for (const auto& [name, resource] : k_limits)
    all.push_back({"the limit " + std::string(name), limit_of(resource), true});
  all.push_back({"the group of processes", std::to_string(::getpgrp()), true});
  all.push_back({"the priority", std::to_string(::getpriority(PRIO_PROCESS, 0)), true});
  all.push_back({"the processors that it may run on", allowed_processors(), true});
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
