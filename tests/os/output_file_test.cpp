#include "os/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>

#include "effort.h"
#include "os/locked_file.h"

namespace clusterbench::os {
namespace {

namespace fs = std::filesystem;

std::string text_in(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class OutputFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "clusterbench.XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    file_ = folder_ / "out.json";
  }
  void TearDown() override { fs::remove_all(folder_); }

  void put(const fs::path& path, const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }

  std::size_t names() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  // Of what write_file() is expected to throw.
  ExitCode refusal(const fs::path& name) const {
    try {
      write_file(name, "new");
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::ok;
  }

  fs::path folder_, file_;
};

TEST_F(OutputFiles, a_file_is_replaced_and_keeps_its_mode) {
  put(file_, "old");
  fs::permissions(file_, fs::perms(0640));
  write_file(file_, "new");
  EXPECT_EQ(text_in(file_), "new");
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms(0640));
  EXPECT_EQ(names(), 1u);
}

TEST_F(OutputFiles, names_that_are_taken_stay_as_they_are) {
  put(folder_ / "victim", "precious");
  put(folder_ / "out.json.new", "precious");
  fs::create_symlink("victim", folder_ / "out.json.new.1");
  fs::create_directory(folder_ / "out.json.new.2");
  write_file(file_, "new");
  EXPECT_EQ(text_in(file_), "new");
  EXPECT_EQ(text_in(folder_ / "victim"), "precious");
  EXPECT_EQ(text_in(folder_ / "out.json.new"), "precious");
  EXPECT_TRUE(fs::is_symlink(folder_ / "out.json.new.1"));
  EXPECT_EQ(names(), 5u);
}

TEST_F(OutputFiles, a_name_as_long_as_names_may_be_is_written) {
  const fs::path file = folder_ / std::string(255, 'x');
  write_file(file, "new");
  EXPECT_EQ(text_in(file), "new");
}

TEST_F(OutputFiles, a_link_stays_and_what_it_leads_to_is_replaced) {
  fs::create_directory(folder_ / "kept");
  fs::create_symlink("kept/target", folder_ / "second");
  fs::create_symlink("second", file_);
  for (const char* text : {"first", "again"}) {  // the target is missing, and then there
    write_file(file_, text);
    EXPECT_TRUE(fs::is_symlink(file_));
    EXPECT_EQ(text_in(folder_ / "kept" / "target"), text);
  }
  EXPECT_EQ(names(), 3u);
}

TEST_F(OutputFiles, what_cannot_be_written_is_the_fault_of_its_name) {
  fs::create_symlink("out.json", folder_ / "other");
  fs::create_symlink("other", file_);
  EXPECT_EQ(refusal(file_), ExitCode::usage) << "a circle";
  EXPECT_EQ(refusal(folder_), ExitCode::usage);
  EXPECT_EQ(refusal(folder_ / "none" / "x"), ExitCode::usage);
  EXPECT_EQ(names(), 2u);
}

TEST_F(OutputFiles, a_full_disk_leaves_the_old_file_and_no_other) {
  put(file_, "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{2, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const ExitCode code = refusal(file_), of_new = refusal(folder_ / "new");
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(code, ExitCode::internal);
  EXPECT_EQ(of_new, ExitCode::internal);
  EXPECT_EQ(text_in(file_), "old");
  EXPECT_EQ(names(), 1u);
}

TEST_F(OutputFiles, the_longest_that_a_file_may_be_is_of_each_alone) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const LockedFile journal(folder_ / "journal");
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_NO_THROW(journal.check_room(3000, 3000));
  EXPECT_THROW(journal.check_room(5000, 10), Error);
  EXPECT_THROW(journal.check_room(10, 5000), Error);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
}

TEST_F(OutputFiles, trying_one_changes_nothing) {
  OutputFile(file_).probe();
  EXPECT_EQ(names(), 0u);
  put(file_, "old");
  OutputFile(file_).probe();
  EXPECT_EQ(text_in(file_), "old");
  EXPECT_EQ(names(), 1u);
}

TEST_F(OutputFiles, a_pipe_waits_for_its_reader_and_stays_open) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string taken;
  std::thread reader([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    taken = text_in(pipe);
  });
  {
    OutputFile file(pipe);
    file.probe();
    file.write("new");
  }
  reader.join();
  EXPECT_EQ(taken, "new");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

// Another program that has the same pipe open can set it to that.
TEST_F(OutputFiles, a_full_pipe_that_does_not_block_is_waited_for) {
  int ends[2];
  ASSERT_EQ(pipe2(ends, O_CLOEXEC | O_NONBLOCK), 0);
  ASSERT_EQ(fcntl(ends[0], F_SETFL, 0), 0);
  std::size_t taken = 0;
  std::thread reader([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    char some[4096];
    for (ssize_t got = 0; (got = read(ends[0], some, sizeof some)) > 0;) taken += static_cast<std::size_t>(got);
  });
  const std::string text(1 << 20, 'x');
  EXPECT_NO_THROW(write_file("/dev/fd/" + std::to_string(ends[1]), text));
  close(ends[1]);
  reader.join();
  close(ends[0]);
  EXPECT_EQ(taken, text.size());
}

TEST_F(OutputFiles, names_of_open_descriptors_are_streams_also_through_a_link) {
  for (const char* name : {"-", "", "/dev/stdout", "/proc/self/fd/1", "/dev/../dev/fd/1"}) {
    EXPECT_TRUE(output_target(name).is_stream) << name;
    EXPECT_EQ(output_target(name).descriptor, STDOUT_FILENO) << name;
  }
  fs::create_symlink("/dev/stderr", file_);
  EXPECT_EQ(output_target(file_).descriptor, STDERR_FILENO);
  EXPECT_TRUE(output_target("/dev/null").is_stream);
  EXPECT_FALSE(output_target(folder_ / "none").is_stream);
}

// Whatever the moment.
TEST_F(OutputFiles, a_signal_leaves_the_old_text_or_the_new_one_and_no_other_file) {
  const std::string old(1 << 20, 'o'), fresh(1 << 20, 'n');
  std::mt19937 random(1);
  for (int i = 0; i < test::tries(60); ++i) {
    put(file_, old);
    const pid_t child = fork();
    if (child == 0) {
      for (;;) write_file(file_, fresh);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 20000));
    kill(child, SIGTERM);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
    const std::string text = text_in(file_);
    EXPECT_TRUE(text == old || text == fresh);
    EXPECT_EQ(names(), 1u);
  }
}

// Between the last two steps, a name and then the right one, a whole file can be left; no half one.
TEST_F(OutputFiles, a_killed_process_leaves_no_half_file) {
  const std::string old(1 << 20, 'o'), fresh(1 << 20, 'n');
  std::mt19937 random(2);
  for (int i = 0; i < test::tries(60); ++i) {
    put(file_, old);
    const pid_t child = fork();
    if (child == 0) {
      for (;;) write_file(file_, fresh);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 20000));
    kill(child, SIGKILL);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    const std::string text = text_in(file_);
    EXPECT_TRUE(text == old || text == fresh);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
      if (entry.path() == file_) continue;
      EXPECT_EQ(text_in(entry.path()).size(), fresh.size()) << entry.path();
      fs::remove(entry.path());
    }
  }
}

}  // namespace
}  // namespace clusterbench::os
