// What stands between this process and code of others: the look at a library's file, and guarded memory.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <future>
#include <random>
#include <thread>

#include "core/file_text.h"
#include "os/guarded_memory.h"
#include "os/orphans.h"
#include "os/shared_library.h"
#include "places.h"

namespace clusterbench::os {
namespace {

using Guard = GuardedMemory::Guard;

std::string this_program_file() {
  return file_text("/proc/self/exe");
}

TEST(LibraryObstacle, says_what_a_file_is_instead) {
  EXPECT_EQ(library_obstacle(""), "is no shared library (ELF file)");
  EXPECT_EQ(library_obstacle("#!/bin/sh"), "is no shared library (ELF file)");
  std::string program = this_program_file();  // a program that may lie anywhere has the form of a library
  EXPECT_EQ(library_obstacle(program), "");
  EXPECT_EQ(library_obstacle(program.substr(0, 20)), "is a shared library that was cut off");
  std::string other = program;
  other[18] = 8;  // e_machine: MIPS
  EXPECT_NE(library_obstacle(other).find("is made for another machine than this one"), std::string::npos);
  other = program;
  other[4] = 1;  // 32 bits
  EXPECT_NE(library_obstacle(other).find("is made for another machine than this one"), std::string::npos);
  other = program;
  other[16] = 1;  // e_type: an object file
  EXPECT_EQ(library_obstacle(other), "is an ELF file, but no shared library");
}

TEST(LibraryObstacle, finds_every_place_where_a_file_is_cut_off_in_what_is_loaded) {
  const std::string program = this_program_file();
  for (std::size_t kept = 64; kept < program.size() / 2; kept = kept * 3 / 2)
    EXPECT_EQ(library_obstacle(std::string_view(program).substr(0, kept)), "is a shared library that was cut off")
        << kept;
}

TEST(LibraryObstacle, reads_nothing_beside_a_header_of_any_numbers) {
  std::mt19937_64 random(7);
  const std::string program = this_program_file().substr(0, 4096);
  for (int i = 0; i < 20'000; ++i) {
    std::string changed = program;
    for (int k = 0; k < 4; ++k) changed[16 + random() % 200] = static_cast<char>(random());
    changed.resize(random() % changed.size());
    const std::vector<char> exact(changed.begin(), changed.end());  // sanitizers watch its end
    library_obstacle({exact.data(), exact.size()});
  }
}

TEST(GuardedMemory, holds_what_is_written_up_to_both_ends) {
  for (const Guard guard : {Guard::before, Guard::behind})
    for (const std::size_t bytes : {std::size_t{4}, std::size_t{4096}, std::size_t{10'000}}) {
      const GuardedMemory memory("array", bytes, guard);
      std::memset(memory.data(), 7, bytes);
      EXPECT_EQ(memory.data()[0], std::byte{7});
      EXPECT_EQ(memory.data()[bytes - 1], std::byte{7});
    }
}

TEST(GuardedMemory, many_can_be_made_one_after_the_other) {
  for (int i = 0; i < 1000; ++i) GuardedMemory("array", 4, Guard::behind);
}

#ifndef CLUSTERBENCH_SANITIZED  // which have a handler of their own
volatile std::byte* volatile touched = nullptr;

TEST(GuardedMemoryDeathTest, says_what_was_touched_and_ends_the_process) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const GuardedMemory behind("lights.x", 12, Guard::behind), before("lists.begin", 12, Guard::before),
      constant("grid", 8, Guard::behind), empty("lists.lights", 0, Guard::behind);
  constant.forbid_writing();
  const auto touch = [](const std::byte* at, bool writes) {
    report_guards();
    touched = const_cast<std::byte*>(at);
    if (writes)
      *touched = std::byte{1};
    else
      static_cast<void>(static_cast<unsigned char>(*touched));
  };
  const testing::KilledBySignal is_killed(SIGSEGV);
  EXPECT_EXIT(touch(behind.data() + 12, false), is_killed, "touched memory 0 bytes behind the end of `lights.x`");
  EXPECT_EXIT(touch(behind.data() + 100, true), is_killed, "touched memory 88 bytes behind the end of `lights.x`");
  EXPECT_EXIT(touch(before.data() - 4, false), is_killed, "touched memory 4 bytes before the begin of `lists.begin`");
  EXPECT_EXIT(touch(constant.data(), true), is_killed, "wrote to `grid`, which is to be read only");
  EXPECT_EXIT(touch(empty.data(), false), is_killed, "touched memory 0 bytes behind the end of `lists.lights`");
}
#endif

TEST(RunnableThreads, are_those_that_do_not_wait_however_busy_the_machine_is) {
  constexpr std::chrono::milliseconds k_step{2};
  std::atomic<bool> stop{false};
  std::thread busy([&] {
    while (!stop) continue;
  });
  for (int i = 0; i < 50; ++i, std::this_thread::sleep_for(k_step)) EXPECT_GE(runnable_threads(), 1);
  stop = true;
  busy.join();
  std::promise<void> end;
  std::thread waiting([&] { end.get_future().wait(); });
  int least = runnable_threads();
  for (int i = 0; i < 500 && least > 0; ++i, std::this_thread::sleep_for(k_step)) least = runnable_threads();
  EXPECT_EQ(least, 0);
  end.set_value();
  waiting.join();
}

TEST(HeapInUse, grows_by_what_is_kept) {
#ifndef CLUSTERBENCH_SANITIZED
  const std::size_t before = heap_in_use();
  const std::string kept(100'000, 'a');
  [[maybe_unused]] const char* const volatile seen = kept.data();  // or the compiler allocates nothing
  EXPECT_GE(heap_in_use(), before + kept.size());
#endif
}

}  // namespace
}  // namespace clusterbench::os
