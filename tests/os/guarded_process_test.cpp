#include "os/guarded_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/file_text.h"
#include "os/call_notes.h"
#include "os/kept_files.h"
#include "os/locked_file.h"
#include "os/orphans.h"
#include "os/process.h"
#include "os/process_memory.h"
#include "os/temporary_folder.h"

namespace clusterbench::os {
namespace {

using How = GuardedEnd::How;

const std::atomic<bool> k_never{false};

// The end of a guarded process that does this.
template <class Work>
GuardedEnd end_after(ProcessGuard& guard, const Work& work, const std::atomic<bool>& stop = k_never) {
  const std::optional<GuardedEnd> end = guard.run(stop);
  if (end) return *end;
  work();
  std::_Exit(0);
}

// A crash there is to look like one of a program, not of a test under a sanitizer.
void die_by(int number) {
  std::signal(number, SIG_DFL);
  std::raise(number);
}

Caller caller_of(const char* name, std::uint64_t label = 0) {
  return {note_code(name), label};
}

TEST(GuardedProcess, that_crashes_is_told_with_the_call_in_which_it_did) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    note_group("1234-5");
    note_pass("time");
    const ForeignCall call(caller_of("acme", 77), CallStep::assign, 12);
    die_by(SIGSEGV);
  });
  EXPECT_EQ(end.how, How::died);
  EXPECT_EQ(end.signal, SIGSEGV);
  EXPECT_TRUE(end.is_call_running);
  ASSERT_TRUE(end.call);
  EXPECT_EQ(end.call->code, "acme");
  EXPECT_EQ(end.call->label, 77u);
  EXPECT_EQ(end.call->step, CallStep::assign);
  EXPECT_EQ(end.call->frame, 12);
  EXPECT_EQ(end.call->group, "1234-5");
  EXPECT_EQ(end.call->pass, "time");
}

TEST(GuardedProcess, that_crashes_after_a_call_is_told_with_the_last_one) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    { const ForeignCall call(caller_of("first"), CallStep::build); }
    { const ForeignCall call(caller_of("second"), CallStep::assign, 3); }
    die_by(SIGABRT);
  });
  EXPECT_EQ(end.signal, SIGABRT);
  EXPECT_FALSE(end.is_call_running);
  ASSERT_TRUE(end.call);
  EXPECT_EQ(end.call->code, "second");
  EXPECT_EQ(end.call->frame, 3);
}

TEST(GuardedProcess, without_a_call_has_none_to_blame) {
  ProcessGuard guard({});
  EXPECT_FALSE(end_after(guard, [] { die_by(SIGSEGV); }).call);
}

TEST(GuardedProcess, of_several_threads_tells_the_call_of_the_one_that_crashed) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    std::atomic<int> waiting{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 6; ++i)
      threads.emplace_back([&, i] {
        note_setting("seed " + std::to_string(i));
        const ForeignCall call(caller_of("acme"), CallStep::assign, i);
        for (++waiting; waiting < 6;) std::this_thread::yield();
        if (i == 4) std::raise(SIGFPE);
        for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
      });
    for (std::thread& thread : threads) thread.join();
  });
  ASSERT_TRUE(end.call);
#ifndef CLUSTERBENCH_SANITIZED  // which handle the signal
  EXPECT_EQ(end.signal, SIGFPE);
  EXPECT_EQ(end.call->frame, 4);
  EXPECT_EQ(end.call->setting, "seed 4");
#endif
}

TEST(GuardedProcess, that_foreign_code_ends_by_exit_has_not_ended_by_itself) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    const ForeignCall call(caller_of("acme"), CallStep::create);
    std::_Exit(0);
  });
  EXPECT_EQ(end.how, How::died);
  EXPECT_EQ(end.signal, 0);
  ASSERT_TRUE(end.call);
  EXPECT_EQ(end.call->step, CallStep::create);
}

TEST(GuardedProcess, that_does_not_return_from_a_call_is_ended) {
  ProcessGuard guard({0.3, 1u << 30});
  const GuardedEnd end = end_after(guard, [] {
    const ForeignCall call(caller_of("acme"), CallStep::build);
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  });
  EXPECT_EQ(end.how, How::timed_out);
  ASSERT_TRUE(end.call);
  EXPECT_EQ(end.call->step, CallStep::build);
}

TEST(GuardedProcess, with_many_calls_may_take_longer_than_one_call_may) {
  ProcessGuard guard({0.3, 1u << 30});
  const GuardedEnd end = end_after(guard, [] {
    const Caller acme = caller_of("acme");
    for (int i = 0; i < 10; ++i) {
      const ForeignCall call(acme, CallStep::assign, i);
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // between calls
    note_done(5);
    std::_Exit(5);
  });
  EXPECT_EQ(end.how, How::done);
  EXPECT_EQ(end.exit_code, 5);
}

TEST(GuardedProcess, that_takes_more_memory_than_it_may_is_ended) {
  constexpr std::size_t k_mib = 1 << 20;
  ProcessGuard guard({60.0, 100 * k_mib});
  const GuardedEnd end = end_after(guard, [] {
    const ForeignCall call(caller_of("acme"), CallStep::assign, 1);
    std::vector<std::vector<char>> all;
    for (int i = 0; i < 300; ++i) {
      all.emplace_back(std::size_t{1} << 20, 'x');
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  });
  EXPECT_EQ(end.how, How::out_of_memory);
  ASSERT_TRUE(end.call);
  EXPECT_EQ(end.call->step, CallStep::assign);
}

TEST(GuardedProcess, takes_as_much_memory_as_it_likes_beside_calls) {
  constexpr std::size_t k_mib = 1 << 20;
  ProcessGuard guard({60.0, 50 * k_mib});
  const GuardedEnd end = end_after(guard, [] {
    { const ForeignCall call(caller_of("acme"), CallStep::create); }
    const std::vector<char> own(std::size_t{200} << 20, 'x');
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    note_done(own.back() == 'x' ? 0 : 1);
  });
  EXPECT_EQ(end.how, How::done);
}

TEST(GuardedProcess, that_crashes_as_it_ends_has_measured_nothing_worse_than_that) {
  ProcessGuard guard({});
  const GuardedEnd measured = end_after(guard, [] {
    { const ForeignCall call(caller_of("acme", 9), CallStep::assign, 4); }
    note_measured();
    die_by(SIGSEGV);
  });
  EXPECT_EQ(measured.how, How::died);
  ASSERT_TRUE(measured.call);
  EXPECT_EQ(measured.call->step, CallStep::unload);
  EXPECT_EQ(measured.call->label, 9u);
  EXPECT_EQ(measured.call->frame, -1);
  const GuardedEnd done = end_after(guard, [] {
    note_done(3);
    die_by(SIGSEGV);
  });
  EXPECT_EQ(done.how, How::done);
  EXPECT_EQ(done.exit_code, 3);
}

TEST(GuardedProcess, that_hangs_as_it_ends_is_ended) {
  ProcessGuard guard({0.3, 1u << 30});
  const GuardedEnd end = end_after(guard, [] {
    { const ForeignCall call(caller_of("acme"), CallStep::assign, 4); }
    note_measured();
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
  });
  EXPECT_EQ(end.how, How::timed_out);
  ASSERT_TRUE(end.call);
  EXPECT_EQ(end.call->step, CallStep::unload);
}

// The copy that comes back from the call ends at once, and its process with it; that it came is told with the call.
TEST(GuardedProcess, whose_call_comes_back_twice_is_told_with_that_call) {
  for (const int after_ms : {0, 300}) {
    ProcessGuard guard({});
    const std::vector<int> before = child_processes();
    const GuardedEnd end = end_after(guard, [&] {
      {
        const ForeignCall call(caller_of("acme", 77), CallStep::assign, 12);
        ::fork();
      }
      { const ForeignCall call(caller_of("other"), CallStep::build); }
      std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
      note_done(0);
    });
    EXPECT_TRUE(end.has_forked) << after_ms;
    EXPECT_EQ(end.how, How::died);
    ASSERT_TRUE(end.call);
    EXPECT_EQ(end.call->code, "acme");
    EXPECT_EQ(end.call->label, 77u);
    EXPECT_EQ(end.call->step, CallStep::assign);
    EXPECT_EQ(end.call->frame, 12);
    EXPECT_EQ(child_processes(), before);
  }
}

TEST(GuardedProcess, leaves_no_process_behind_that_a_call_has_started) {
  ProcessGuard guard({});
  const std::vector<int> before = child_processes();
  const GuardedEnd end = end_after(guard, [] {
    {
      const ForeignCall call(caller_of("acme"), CallStep::assign, 3);
      if (::fork() == 0) {
        if (::fork() == 0) ::setsid();  // beyond signals to a group of processes
        ::sleep(60);
        ::_exit(0);
      }
    }
    note_done(0);
  });
  EXPECT_EQ(end.how, How::done);
  EXPECT_FALSE(end.has_forked);
  EXPECT_EQ(end.orphans, 2);
  EXPECT_EQ(child_processes(), before);
}

TEST(GuardedProcess, with_a_process_that_a_call_has_waited_for_has_no_fault) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    {
      const ForeignCall call(caller_of("acme"), CallStep::assign, 3);
      const pid_t child = ::fork();
      if (child == 0) ::_exit(0);
      ::waitpid(child, nullptr, 0);
    }
    note_done(0);
  });
  EXPECT_EQ(end.how, How::done);
  EXPECT_EQ(end.orphans, 0);
}

TEST(GuardedProcess, of_which_a_call_closes_files_tells_that_call) {
  for (const bool is_replaced : {false, true}) {
    ProcessGuard guard({});
    const GuardedEnd end = end_after(guard, [&] {
      const int file = ::open("/proc/self/exe", O_RDONLY | O_CLOEXEC);
      keep_file(file);
      const ForeignCall call(caller_of("acme"), CallStep::build);
      end_if_files_are_lost();
      for (int i = STDIN_FILENO; i < 64 && !is_replaced; ++i) ::close(i);
      if (is_replaced) ::dup2(::open("/dev/null", O_RDONLY), file);
      end_if_files_are_lost();
      note_done(0);
    });
    EXPECT_EQ(end.how, How::died);
    EXPECT_GE(end.lost_descriptor, is_replaced ? 3 : 0);
    ASSERT_TRUE(end.call);
    EXPECT_EQ(end.call->step, CallStep::build);
  }
}

// The journal of a run: what was written behind it is cut off again.
TEST(GuardedProcess, of_which_a_call_writes_to_a_file_or_cuts_it_tells_that_call) {
  for (const bool is_cut : {false, true}) {
    const TemporaryFolder folder;
    const auto path = folder / "journal";
    ProcessGuard guard({});
    const GuardedEnd end = end_after(guard, [&] {
      LockedFile journal(path);
      journal.append("one\n");
      const ForeignCall call(caller_of("acme"), CallStep::assign, 3);
      for (int file = 3; file < 20; ++file)
        if (is_cut ? ::ftruncate(file, 0) == 0 : ::write(file, "JUNK\n", 5) == 5) continue;
      end_if_files_are_lost();
      note_done(0);
    });
    EXPECT_EQ(end.how, How::died);
    EXPECT_TRUE(end.is_file_changed);
    EXPECT_GE(end.lost_descriptor, 3);
    ASSERT_TRUE(end.call);
    EXPECT_EQ(end.call->step, CallStep::assign);
    EXPECT_EQ(file_text(path), is_cut ? "" : "one\n");
  }
}

TEST(GuardedProcess, may_write_to_its_own_journal_after_calls) {
  const TemporaryFolder folder;
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [&] {
    LockedFile journal(folder / "journal");
    for (int i = 0; i < 3; ++i) {
      { const ForeignCall call(caller_of("acme"), CallStep::assign, i); }
      journal.append("one\n");
      journal.check_room(1000, 0);
      end_if_files_are_lost();
    }
    journal.cut_to(4);
    journal.append("two\n");
    end_if_files_are_lost();
    note_done(0);
  });
  EXPECT_EQ(end.how, How::done);
  EXPECT_EQ(file_text(folder / "journal"), "one\ntwo\n");
}

TEST(GuardedProcess, has_no_descriptor_of_the_notes_that_a_child_can_still_join) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    for (int file = 3; file < 64; ++file)
      if (::ftruncate(file, 0) == 0) continue;
    join_notes(path_of_notes());
    const ForeignCall call(caller_of("acme", 5), CallStep::assign, 8);
    note_done(7);
  });
  EXPECT_EQ(end.how, How::done);
  EXPECT_EQ(end.exit_code, 7);
}

TEST(GuardedProcess, may_close_and_open_files_of_its_own) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    const int file = ::open("/proc/self/exe", O_RDONLY | O_CLOEXEC);
    keep_file(file);
    release_file(file);
    ::close(file);
    const ForeignCall call(caller_of("acme"), CallStep::build);
    ::close(::open("/dev/null", O_RDONLY));
    end_if_files_are_lost();
    note_done(0);
  });
  EXPECT_EQ(end.how, How::done);
}

TEST(GuardedProcess, leaves_a_message_for_the_next_one) {
  ProcessGuard guard({});
  end_after(guard, [] {
    leave_message("load 3");
    die_by(SIGSEGV);
  });
  EXPECT_EQ(guard.message(), "load 3");
  const GuardedEnd end = end_after(guard, [&] { note_done(guard.message() == "load 3" ? 1 : 2); });
  EXPECT_EQ(end.how, How::done);
}

TEST(GuardedProcess, blames_the_call_in_which_a_process_that_it_started_crashed) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    const std::string notes = path_of_notes();
    int status = 0;
    if (const pid_t child = ::fork(); child == 0) {
      join_notes(notes);
      const ForeignCall call(caller_of("acme", 5), CallStep::assign, 8);
      die_by(SIGBUS);
    } else {
      ::waitpid(child, &status, 0);
    }
    end_with_call(status);
  });
  EXPECT_EQ(end.how, How::died);
  EXPECT_EQ(end.signal, SIGBUS);
  ASSERT_TRUE(end.call);
  EXPECT_EQ(end.call->frame, 8);
  EXPECT_EQ(end.call->label, 5u);
}

TEST(CallNotes, of_many_codes_and_long_names_stay_in_their_room) {
  ProcessGuard guard({});
  const GuardedEnd end = end_after(guard, [] {
    for (int i = 0; i < 100; ++i) note_code(std::string(1000, 'x'));
    note_group(std::string(5000, 'g'));
    note_setting(std::string(5000, 's'));
    const ForeignCall call({note_code("late"), 0}, CallStep::assign);
    die_by(SIGSEGV);
  });
  ASSERT_TRUE(end.call);
  EXPECT_EQ(end.call->code, "one of more than 32 plug-ins");
  EXPECT_EQ(end.call->group, std::string(100, 'g'));
}

TEST(CallNotes, cannot_be_joined_where_there_are_none) {
  EXPECT_THROW(join_notes("/dev/null"), Error);
  EXPECT_THROW(join_notes("/proc/self/nothing"), Error);
}

TEST(ProcessMemory, grows_with_what_is_written) {
  const std::uint64_t before = resident_bytes(::getpid());
  const std::vector<char> more(64 << 20, 'x');
  EXPECT_GE(resident_bytes(::getpid()), before + (32 << 20)) << more.back();
  EXPECT_EQ(resident_bytes(-1), 0u);
}

}  // namespace
}  // namespace clusterbench::os
