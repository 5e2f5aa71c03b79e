#include "os/orphans.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>

namespace clusterbench::os {
namespace {

constexpr const char* k_tasks = "/proc/self/task";

}  // namespace

std::vector<int> child_processes() {
  std::vector<int> children;
  std::error_code failed;
  for (const std::filesystem::directory_entry& task : std::filesystem::directory_iterator(k_tasks, failed)) {
    std::ifstream list(task.path() / "children");
    for (int child = 0; list >> child;) children.push_back(child);
  }
  std::ranges::sort(children);
  return children;
}

int thread_count() {
  std::error_code failed;
  return static_cast<int>(
      std::distance(std::filesystem::directory_iterator(k_tasks, failed), std::filesystem::directory_iterator()));
}

int runnable_threads() {
  int count = 0;
  std::error_code failed;
  for (const std::filesystem::directory_entry& task : std::filesystem::directory_iterator(k_tasks, failed)) {
    if (task.path().filename() == std::to_string(::gettid())) continue;
    std::string stat;
    std::getline(std::ifstream(task.path() / "stat"), stat);
    const std::size_t name_end = stat.rfind(')');  // the state follows the name
    if (name_end != std::string::npos && stat.substr(name_end, 3) == ") R") ++count;
  }
  return count;
}

Orphans::Orphans() {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  others_ = child_processes();
}

int Orphans::end_all() const {
  constexpr int k_patient_tries = 100, k_most_tries = 1000, k_wait_ms = 2;  // some are about to end by themselves
  std::set<int> running;
  for (int tries = 0; tries < k_most_tries; ++tries) {
    bool is_left = false;
    for (const int child : child_processes()) {
      if (std::ranges::binary_search(others_, child) || ::waitpid(child, nullptr, WNOHANG) == child) continue;
      is_left = true;
      if (tries < k_patient_tries) continue;
      running.insert(child);
      ::kill(child, SIGKILL);
    }
    if (!is_left) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(k_wait_ms));
  }
  return static_cast<int>(running.size());
}

}  // namespace clusterbench::os
