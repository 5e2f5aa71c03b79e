// What a method leaves behind in its process, and around it.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>

#include "acceptance/acceptance_test.h"
#include "core/text.h"
#include "os/orphans.h"
#include "os/surroundings.h"

namespace clusterbench::acceptance {
namespace {

using std::chrono::milliseconds;

// Some end a moment after destroy() has asked them to.
template <class Left>
bool is_left_after_a_while(const Left& left) {
  constexpr int k_tries = 50;
  constexpr milliseconds k_wait{10};
  for (int i = 0; i < k_tries && left(); ++i) std::this_thread::sleep_for(k_wait);
  return left();
}

// The share of a processor that this process takes while it does nothing of its own.
double busy_share() {
  constexpr milliseconds k_span{200};
  const std::clock_t before = std::clock();
  std::this_thread::sleep_for(k_span);
  const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  return seconds / std::chrono::duration<double>(k_span).count();
}

// Whether another thread never waits for something; it may get little of a busy machine's processors.
bool is_a_thread_always_runnable() {
  constexpr int k_looks = 40;
  constexpr milliseconds k_wait{5};
  for (int i = 0; i < k_looks; ++i) {
    if (os::runnable_threads() == 0) return false;
    std::this_thread::sleep_for(k_wait);
  }
  return true;
}

// A library may keep threads that wait for work, as many as it likes: their number does not grow with instances.
void leave_nothing_running(const Subject& subject, Findings& findings) {
  constexpr int k_warm = 2, k_instances = 8;
  const std::vector<SubjectFrame> frames = frames_for(subject, 1);
  const auto run = [&](int times) {
    for (int i = 0; i < times; ++i)
      for (const SubjectFrame& frame : frames) lists_of(subject, frame);
  };
  const std::vector<int> children = os::child_processes();
  run(k_warm);
  const int threads = os::thread_count();
  run(k_instances);
  if (is_left_after_a_while([&] { return os::child_processes() != children; }))
    findings.fault("leaves a process running, or one that it did not wait for");
  if (is_left_after_a_while([&] { return os::thread_count() >= threads + k_instances; }))
    findings.fault("has " + std::to_string(os::thread_count() - threads) + " more threads after " +
                   std::to_string(k_instances * frames.size()) + " instances, which destroy() ended");
  constexpr int k_looks = 4;  // pools of threads look for more work for a while
  constexpr double k_idle_share = 0.2;
  double share = 1.0;
  for (int i = 0; i < k_looks && share > k_idle_share; ++i) share = busy_share();
  if (share > k_idle_share || is_a_thread_always_runnable())
    findings.fault("keeps " + std::to_string(static_cast<int>(100.0 * share)) +
                   " % of a processor busy after destroy(), and so disturbs the times of other methods");
  findings.detail = frames_text((k_warm + k_instances) * frames.size());
}

void leave_surroundings_alone(const Subject& subject, Findings& findings) {
  const std::vector<SubjectFrame> frames = frames_for(subject, 1);
  const os::Surroundings before;
  const os::CaughtOutput printed;
  for (const std::string& change : subject.changes_on_loading) findings.fault("changes " + change + " as it is loaded");
  for (const SubjectFrame& frame : frames) lists_of(subject, frame);
  for (const std::string& change : before.changes()) findings.fault("changes " + change);
  if (const std::string text = printed.text(); !text.empty())
    findings.fault("prints to standard output, which is for results: \"" + printable(text) + "\"");
  findings.detail = frames_text(frames.size());
}

}  // namespace

std::vector<AcceptanceTest> surrounding_tests() {
  return {
      {"processes", "does not fork, and leaves no process and no busy thread behind", false, leave_nothing_running},
      {"surroundings",
       "leaves signals, the working directory, the locale, the environment, limits and standard output alone", false,
       leave_surroundings_alone},
  };
}

}  // namespace clusterbench::acceptance
