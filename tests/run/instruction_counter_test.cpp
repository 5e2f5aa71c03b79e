#include <gtest/gtest.h>
#include <linux/perf_event.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cmath>
#include <optional>

#include "core/error.h"
#include "run/counters/callgrind_counter.h"
#include "run/counters/perf_counter.h"

namespace clusterbench::run {
namespace {

// Touches fresh pages: a page fault each, and no more under a thread sanitizer, which touches pages of its own for each
// that it sees.
__attribute__((no_sanitize("thread"))) void touch_pages(std::size_t count) {
  constexpr std::size_t k_page_bytes = 4096;
  const std::size_t size = count * k_page_bytes;
  const long address = syscall(SYS_mmap, nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(address, -1);
  auto* const memory = reinterpret_cast<volatile char*>(address);
  syscall(SYS_madvise, address, size, MADV_NOHUGEPAGE);
  for (std::size_t page = 0; page < count; ++page) memory[page * k_page_bytes] = 1;
  syscall(SYS_munmap, address, size);
}

void loop(int rounds) {
  for (int i = 0; i < rounds; ++i) asm volatile("" : : "r"(i));
}

// A kernel counts its own events even where a virtual machine hides the processor's.
TEST(PerfCounter, counts_from_start_to_stop_and_begins_anew) {
  std::optional<PerfCounter> counter;
  try {
    counter.emplace(PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS);
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  touch_pages(1000);
  counter->start();
  touch_pages(100);
  const std::uint64_t first = counter->stop().instructions;
  touch_pages(1000);
  counter->start();
  touch_pages(200);
  const std::uint64_t second = counter->stop().instructions;
  EXPECT_GE(first, 100u);
  EXPECT_LT(first, 150u);
  EXPECT_GE(second, 200u);
  EXPECT_LT(second, 250u);
}

TEST(PerfCounter, instructions_of_a_loop_follow_its_length) {
  std::optional<PerfCounter> counter;
  try {
    counter.emplace();
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  constexpr int k_rounds = 1000000;
  const auto counted = [&](int rounds) {
    counter->start();
    loop(rounds);
    return static_cast<double>(counter->stop().instructions);
  };
  const double once = counted(k_rounds);
  EXPECT_GE(once, k_rounds);
  EXPECT_NEAR(counted(k_rounds) / once, 1.0, 1e-3);
  EXPECT_NEAR(counted(2 * k_rounds) / once, 2.0, 2e-2);
}

TEST(PerfCounter, a_refusal_names_the_flag_and_a_reason) {
  try {
    PerfCounter(PERF_TYPE_HARDWARE, 9999);
    FAIL() << "there is no such event";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "--count=perf");
    EXPECT_FALSE(error.message().empty());
    EXPECT_EQ(error.code(), ExitCode::usage);
  }
}

TEST(CallgrindCounter, outside_of_callgrind_nothing_is_counted_and_that_is_an_error) {
  try {
    CallgrindCounter("/nowhere/dump");
    FAIL() << "counted without callgrind";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/dump.1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace clusterbench::run
