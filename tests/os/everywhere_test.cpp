// What every system has to do in the same way: names, files, locks and processes.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <thread>

#include "core/error.h"
#include "core/file_text.h"
#include "os/environment.h"
#include "os/file_access.h"
#include "os/locked_file.h"
#include "os/machine.h"
#include "os/output_file.h"
#include "os/process.h"
#include "os/process_memory.h"
#include "os/processor_time.h"
#include "os/temporary_folder.h"

namespace clusterbench::os {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string>& odd_names() {
  static const std::vector<std::string> names{"plain",
                                              "with space",
                                              "Stra\u00dfe gr\u00f6\u00dfer",
                                              "\u65e5\u672c\u8a9e",
                                              "\U0001F4A1 beyond 16 bits",
                                              "a'b(c)&d^e%f",
                                              std::string(200, 'x')};
  return names;
}

std::string refusal_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.message();
  }
  return "";
}

fs::path path_of(const TemporaryFolder& folder) {
  return (folder / "x").parent_path();
}

TEST(Everywhere, files_of_all_names_are_written_replaced_and_read) {
  const TemporaryFolder folder;
  for (const std::string& name : odd_names())
    for (const char* text : {"old\n", "new\r\n\n"}) {
      write_file(folder / name, text);
      EXPECT_EQ(file_text(folder / name), text) << name;
    }
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(path_of(folder))) {
    EXPECT_NE(std::ranges::find(odd_names(), entry.path().filename().string()), odd_names().end())
        << entry.path().filename().string();
    ++files;
  }
  EXPECT_EQ(files, odd_names().size());
}

TEST(Everywhere, a_path_longer_than_an_old_windows_allows_is_written) {
  const TemporaryFolder folder;
  fs::path deep = path_of(folder);
  for (int i = 0; i < 8; ++i) deep /= std::string(40, static_cast<char>('a' + i));
  fs::create_directories(deep);
  write_file(deep / "out.json", "text");
  EXPECT_EQ(file_text(deep / "out.json"), "text");
  EXPECT_TRUE(is_writable_folder(deep));
}

TEST(Everywhere, what_cannot_be_written_says_why) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal_of([&] { write_file(path_of(folder), "x"); }).find("is a folder"), std::string::npos);
  EXPECT_NE(refusal_of([&] { write_file((folder / "none") / "x", "x"); }).find("there is no folder"),
            std::string::npos);
  EXPECT_FALSE(is_writable_folder(folder / "none"));
  EXPECT_TRUE(is_writable_folder(path_of(folder)));
}

TEST(Everywhere, trying_an_output_leaves_no_file) {
  const TemporaryFolder folder;
  OutputFile(folder / "out").probe();
  EXPECT_TRUE(fs::is_empty(path_of(folder)));
}

TEST(Everywhere, a_locked_file_refuses_a_second_writer_and_lets_others_read) {
  const TemporaryFolder folder;
  LockedFile file(folder / "journal");
  file.append("one\n");
  EXPECT_EQ(file_text(folder / "journal"), "one\n");
  EXPECT_NE(refusal_of([&] { LockedFile(folder / "journal"); }).find("another run is writing here"), std::string::npos);
  file.append("two\n");
  EXPECT_EQ(file.text(), "one\ntwo\n");
  file.cut_to(4);
  file.append("three\n");
  EXPECT_EQ(file.text(), "one\nthree\n");
  file.check_room(1000, 500);
  EXPECT_EQ(file.text(), "one\nthree\n");
}

TEST(Everywhere, a_lock_ends_with_its_owner_and_an_empty_file_goes) {
  const TemporaryFolder folder;
  {
    const LockedFile file(folder / "journal");
    EXPECT_TRUE(fs::exists(folder / "journal"));
  }
  EXPECT_FALSE(fs::exists(folder / "journal"));
  { LockedFile(folder / "journal").append("kept"); }
  EXPECT_EQ(LockedFile(folder / "journal").text(), "kept");
}

TEST(Everywhere, a_second_writer_can_wait_for_the_first) {
  const TemporaryFolder folder;
  auto first = std::make_unique<LockedFile>(folder / "history");
  first->append("first\n");
  std::thread second([&] { LockedFile(folder / "history", LockedFile::Held::wait).append("second\n"); });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(first->text(), "first\n");
  first.reset();
  second.join();
  EXPECT_EQ(file_text(folder / "history"), "first\nsecond\n");
}

TEST(Everywhere, the_text_of_a_locked_file_is_set_aside_or_replaced) {
  const TemporaryFolder folder;
  LockedFile file(folder / "journal");
  file.append("old");
  const fs::path aside = file.move_text_beside();
  EXPECT_EQ(aside, folder / "journal.1");
  EXPECT_EQ(file_text(aside), "old");
  EXPECT_EQ(file.text(), "");
  file.append("new");
  file.replace("whole");
  EXPECT_EQ(file_text(folder / "journal"), "whole");
  LockedFile again(folder / "journal");
  again.remove();
  EXPECT_FALSE(fs::exists(folder / "journal"));
}

TEST(Everywhere, a_temporary_folder_goes_with_what_is_in_it) {
  fs::path path;
  {
    const TemporaryFolder folder;
    path = path_of(folder);
    write_file(folder / "\u65e5\u672c", "x");
  }
  EXPECT_FALSE(fs::exists(path));
}

// --- Processes: this program again, which runs one of the tests below ---

// The child is one test, whatever part of all tests this process runs.
void run_children_whole() {
  for (const char* name : {"GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX"})
#ifdef _WIN32
    _putenv_s(name, "");
#else
    ::unsetenv(name);
#endif
}

std::vector<std::string> child_command(const std::string& test, const std::vector<std::string>& words = {}) {
  run_children_whole();
  std::vector<std::string> command{this_program(), "--gtest_filter=Child.DISABLED_" + test,
                                   "--gtest_also_run_disabled_tests", "--gtest_brief=1", "--"};
  command.insert(command.end(), words.begin(), words.end());
  return command;
}

TEST(Child, DISABLED_prints_its_words) {
  const std::vector<std::string> words = own_command_line();
  for (auto word = std::ranges::find(words, "--") + 1; word != words.end(); ++word) std::cout << "[" << *word << "]\n";
  std::cout << std::flush;
  std::_Exit(0);
}

TEST(Child, DISABLED_answers_lines) {
  for (std::string line; std::getline(std::cin, line);) std::cout << "heard " << line << std::endl;
  std::cerr << "heard all\n";
  std::_Exit(3);
}

TEST(Child, DISABLED_waits) {
  std::cout << "waits" << std::endl;
  std::this_thread::sleep_for(std::chrono::minutes(1));
}

const std::atomic<bool> k_not_stopped{false};

std::string without_return(std::string line) {
  if (line.ends_with('\r')) line.pop_back();  // this program of GoogleTest leaves its standard output in text mode
  return line;
}

TEST(Everywhere, words_of_all_kinds_reach_a_program_as_they_are) {
  const std::vector<std::string> words{"a b",
                                       "c\"d",
                                       "e\\",
                                       "f\\\"g",
                                       "h\\\\",
                                       "",
                                       "\\\\server\\x y\\",
                                       "\"",
                                       "*",
                                       "%PATH%",
                                       "^&|<>",
                                       "'",
                                       "Stra\u00dfe \u65e5\u672c \U0001F4A1"};
  std::string expected, found;
  for (const std::string& word : words) expected += "[" + word + "]\n";
  const Ending ending = run_child(
      child_command("prints_its_words", words), "",
      [&](const std::string& line) {
        if (line.starts_with('[')) found += without_return(line) + "\n";
      },
      k_not_stopped);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(ending.how, "");
}

TEST(Everywhere, a_child_reads_its_input_and_its_end_is_told) {
  std::vector<std::string> lines;
  const Ending ending = run_child(
      child_command("answers_lines"), "one\ntwo\n",
      [&](const std::string& line) {
        if (line.starts_with("heard")) lines.push_back(without_return(line));
      },
      k_not_stopped);
  EXPECT_EQ(lines, (std::vector<std::string>{"heard one", "heard two"}));
  EXPECT_EQ(ending.how, "exit code 3");
  EXPECT_EQ(ending.exit_code, 3);
  EXPECT_EQ(ending.error_tail, "heard all");
}

TEST(Everywhere, a_program_that_is_not_there_is_told) {
  const Ending ending = run_child(
      {"/no/such/program"}, "", [](const std::string&) {}, k_not_stopped);
  EXPECT_EQ(ending.how, "cannot be started: No such file or directory");
  EXPECT_THROW(Conversation({"/no/such/program"}), Error);
}

TEST(Everywhere, a_conversation_goes_line_by_line) {
  Conversation child(child_command("answers_lines"));
  std::string line;
  for (int i = 0; i < 3; ++i) {
    child.send_line("line " + std::to_string(i));
    do ASSERT_EQ(child.receive_line(line, 60.0, k_not_stopped), Conversation::Received::line);
    while (!line.starts_with("heard"));
    EXPECT_EQ(without_return(line), "heard line " + std::to_string(i));
  }
  EXPECT_EQ(child.receive_line(line, 0.2, k_not_stopped), Conversation::Received::timeout);
  EXPECT_EQ(child.end().exit_code, 3);
  EXPECT_EQ(child.error_tail(), "heard all");
}

TEST(Everywhere, a_child_that_waits_is_ended) {
  std::atomic<bool> stop{false};
  const auto begin = std::chrono::steady_clock::now();
  const Ending ending = run_child(
      child_command("waits"), "", [&](const std::string& line) { stop = stop || line.starts_with("waits"); }, stop);
  EXPECT_NE(ending.how, "");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(50));
}

TEST(Everywhere, this_process_knows_itself) {
  EXPECT_TRUE(is_running(own_process()));
  EXPECT_GT(resident_bytes(own_process()), 100'000u);
  EXPECT_TRUE(fs::exists(this_program()));
  EXPECT_TRUE(is_executable(this_program()));
  EXPECT_GE(own_command_line().size(), 1u);
}

TEST(Everywhere, the_machine_is_known) {
  const Machine machine = this_machine();
  EXPECT_NE(machine.processor.name, "");
  EXPECT_GT(machine.cores, 0);
  EXPECT_GT(machine.ram_bytes, std::uint64_t{1} << 28);
  EXPECT_NE(machine.system.find(' '), std::string::npos);
  const std::string date = utc_now();
  ASSERT_EQ(date.size(), 20u);
  EXPECT_EQ(date.substr(0, 2), "20");
  EXPECT_EQ(std::string{date[4]} + date[7] + date[10] + date[13] + date[16] + date[19], "--T::Z");
}

TEST(Everywhere, processor_time_grows_with_work) {
  const double before_s = own_processor_s();
  volatile double sum = 0.0;
  while (own_processor_s() - before_s < 0.05) sum = sum + 1.0;
  EXPECT_GT(own_processor_s(), before_s);
}

TEST(Everywhere, variables_are_read_as_utf_8) {
  EXPECT_FALSE(variable("CLUSTERBENCH_NO_SUCH_VARIABLE"));
  EXPECT_TRUE(variable("PATH"));
  EXPECT_FALSE(folders_in_variable("PATH").empty());
  EXPECT_TRUE(folders_in_variable("CLUSTERBENCH_NO_SUCH_VARIABLE").empty());
}

}  // namespace
}  // namespace clusterbench::os
