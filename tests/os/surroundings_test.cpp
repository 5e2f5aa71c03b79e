// What foreign code may change in a process, and who sees it.

#include "os/surroundings.h"

#include <gtest/gtest.h>

#include <sched.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>

#include "core/text.h"

namespace clusterbench::os {
namespace {

struct SurroundingChange {
  std::string says;  // begins so
  std::function<void()> change;
};

void block_alarm(int how) {
  sigset_t some;
  sigemptyset(&some);
  sigaddset(&some, SIGALRM);
  ::sigprocmask(how, &some, nullptr);
}

// Each in a process of its own, which ends with 0 if it is told, and alone.
void expect_told(const SurroundingChange& one) {
  const auto look = [&one] {
    const Surroundings before;
    if (!before.changes().empty()) std::_Exit(2);
    one.change();
    const std::vector<std::string> told = before.changes();
    std::fprintf(stderr, "%s", joined(told, "; ").c_str());
    std::_Exit(told.size() == 1 && told.front().starts_with(one.says) ? 0 : 1);
  };
  EXPECT_EXIT(look(), ::testing::ExitedWithCode(0), "") << one.says;
}

TEST(Surroundings, tell_each_change_of_a_process) {
  expect_told({"the handler of SIGALRM", [] { std::signal(SIGALRM, [](int) {}); }});
  expect_told({"the blocked signals, to SIGALRM", [] { block_alarm(SIG_BLOCK); }});
  expect_told({"the working directory, to /", [] { EXPECT_EQ(::chdir("/"), 0); }});
  expect_told({"the mask of new files (umask), to 014", [] { ::umask(014); }});
  expect_told({"the limit RLIMIT_NOFILE, to 32 (at most 33)", [] {
                 const rlimit limit{32, 33};
                 ::setrlimit(RLIMIT_NOFILE, &limit);
               }});
  expect_told({"the environment (CLUSTERBENCH_NEW)", [] { ::setenv("CLUSTERBENCH_NEW", "1", 1); }});
  expect_told({"the environment (", [] { ::clearenv(); }});
  expect_told({"the priority, to 19", [] { ::setpriority(PRIO_PROCESS, 0, 19); }});
}

#ifdef __linux__
TEST(Surroundings, tell_the_processors_of_the_thread) {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0 || CPU_COUNT(&allowed) < 2) GTEST_SKIP();
  expect_told({"the processors that it may run on, to ", [&] {
                 int first = 0;
                 while (!CPU_ISSET(first, &allowed)) ++first;
                 CPU_CLR(first, &allowed);
                 ::sched_setaffinity(0, sizeof allowed, &allowed);
               }});
}
#endif

}  // namespace
}  // namespace clusterbench::os
