// A run and the processes that it starts: what they share, how they end, what is left of them.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

// Two groups of a scene of its own, in launches that take a moment each.
struct LaunchPlace {
  Folder folder;
  std::string scene = copied("street.glb", "level.glb");
  std::string config = written("c.json", "level.glb");
  std::string out = (folder / "r.json").string(), partial = out + ".partial";

  std::string copied(const std::string& from, const std::string& to) const {
    std::filesystem::copy_file(source_file("scenes/" + from), folder / to,
                               std::filesystem::copy_options::overwrite_existing);
    return (folder / to).string();
  }
  std::string written(const std::string& name, const std::string& path) const {
    return folder
        .write(name, R"({"name": "c", "scenes": [{"path": ")" + path + R"(", "frames": 2}],
           "grids": [{"kind": "world", "cells": [16, 4, 16]}, {"kind": "world", "cells": [8, 4, 8]}],
           "assigners": ["world-grid", "world-grid-fast"],
           "timing": {"sweep_mib": 4, "rounds": 8, "launches": 4, "min_time_ms": 0.5, "frames": 2}})")
        .string();
  }
};

// A command of the shell, which can use $run for the program, from within a folder.
Outcome shell(const Folder& folder, const std::string& command) {
  const std::string whole = "cd " + folder.path().string() + " && run=" + test::program() + " && { " + command +
                            "; } >" + (folder / "out").string() + " 2>" + (folder / "err").string();
  const int status = std::system(whole.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, file_text(folder / "out"), file_text(folder / "err")};
}

bool comes_true(const std::function<bool()>& condition) {
  for (int tries = 0; tries < 3000; ++tries) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

// Not even as one that nobody has waited for.
bool is_at_work(pid_t pid) {
  const std::string facts = file_text("/proc/" + std::to_string(pid) + "/stat");
  return !facts.empty() && facts.substr(facts.rfind(')') + 2, 1) != "Z";
}

// The program, while it runs.
class Running {
 public:
  // As a shell would take them, from within the folder.
  Running(const Folder& folder, const std::string& arguments, const std::string& binary = test::program(),
          const std::string& before = "") {
    const std::string command =
        "cd " + folder.path().string() + " && " + before + " exec " + binary + " " + arguments + " 2>err </dev/null";
    pid_ = fork();
    if (pid_ == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
  }
  ~Running() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void send(int number) const { kill(pid_, number); }
  // The exit code; of one that died by a signal 128 and its number.
  int end() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  // Waits until one of its launches has answered.
  bool has_answered(const std::string& journal) const {
    bool has_ended = false;
    const auto has_answer = [&] { return file_text(journal).find("\"answer\"") != std::string::npos; };
    return comes_true([&] { return has_answer() || (has_ended = !is_at_work(pid_)); }) && !has_ended;
  }
  // Waits for a process that it starts. False if it ends before, or if this system does not tell.
  bool has_child(pid_t& child) const {
    const std::string pid = std::to_string(pid_), children = "/proc/" + pid + "/task/" + pid + "/children";
    if (!std::filesystem::exists(children)) return false;
    return comes_true([&] { return (child = std::atoi(file_text(children).c_str())) > 0 || !is_at_work(pid_); }) &&
           child > 0;
  }

 private:
  pid_t pid_ = -1;
};

TEST(RunInLaunches, a_configuration_through_a_pipe_is_measured_with_paths_from_the_current_folder) {
  const LaunchPlace place;
  for (const char* command :
       {"cat c.json | $run run -q /dev/stdin -o r.json", "$run run -q /dev/stdin -o r.json <c.json",
        "mkfifo pipe && { cat c.json >pipe & } && $run run -q pipe -o r.json"}) {
    const Outcome done = shell(place.folder, command);
    EXPECT_EQ(done.code, 0) << command << done.err;
    EXPECT_EQ(Json::parse(file_text(place.out))["cases"].size(), 4u) << command;
    std::filesystem::remove(place.out);
  }
}

TEST(RunInLaunches, a_scene_that_is_redirected_is_measured_and_one_from_a_pipe_is_refused) {
  const LaunchPlace place;
  place.written("s.json", "/dev/stdin");
  EXPECT_EQ(shell(place.folder, "$run run -q s.json -o r.json <level.glb").code, 0);
  const Outcome refused = shell(place.folder, "cat level.glb | $run run -q s.json -o r.json");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("is not a regular file"), std::string::npos) << refused.err;
}

TEST(RunInLaunches, later_launches_measure_the_configuration_that_the_run_began_with) {
  const LaunchPlace place;
  Running run(place.folder, "run -q c.json -o r.json");
  ASSERT_TRUE(run.has_answered(place.partial));
  place.folder.write("c.json", "{");
  EXPECT_EQ(run.end(), 0) << file_text(place.folder / "err");
}

TEST(RunInLaunches, a_scene_that_changes_meanwhile_ends_the_run_and_is_named) {
  const LaunchPlace place;
  Running run(place.folder, "run -q c.json -o r.json");
  ASSERT_TRUE(run.has_answered(place.partial));
  place.copied("mirror.glb", "other.glb");
  std::filesystem::rename(place.folder / "other.glb", place.scene);
  EXPECT_EQ(run.end(), 2);
  const std::string err = file_text(place.folder / "err");
  EXPECT_NE(err.find("level.glb: has changed since the run began"), std::string::npos) << err;
}

TEST(RunInLaunches, a_scene_that_is_removed_meanwhile_is_named_without_a_place_in_another_text) {
  const LaunchPlace place;
  Running run(place.folder, "run -q c.json -o r.json");
  ASSERT_TRUE(run.has_answered(place.partial));
  std::filesystem::remove(place.scene);
  EXPECT_EQ(run.end(), 2);
  const std::string err = file_text(place.folder / "err");
  EXPECT_NE(err.find("level.glb: has been removed since the run began"), std::string::npos) << err;
  EXPECT_EQ(err.find("c.json: 1:"), std::string::npos) << err;
  EXPECT_NE(err.find("--resume goes on with the same scenes, configuration and program"), std::string::npos) << err;
}

TEST(RunInLaunches, a_program_that_is_removed_meanwhile_goes_on) {
  const LaunchPlace place;
  const std::filesystem::path binary = place.folder / "clusterbench";
  std::filesystem::copy_file(test::program(), binary);
  Running run(place.folder, "run -q c.json -o r.json", binary.string());
  ASSERT_TRUE(run.has_answered(place.partial));
  std::filesystem::remove(binary);
  EXPECT_EQ(run.end(), 0) << file_text(place.folder / "err");
}

TEST(RunInLaunches, nothing_is_left_of_a_run_that_is_killed) {
  const LaunchPlace place;
  std::filesystem::create_directory(place.folder / "tmp");
  Running run(place.folder, "run -q c.json --rounds 4000 -o r.json", test::program(), "TMPDIR=$PWD/tmp");
  pid_t child = 0;
  if (!run.has_child(child)) GTEST_SKIP() << "this system tells of no children";
  run.send(SIGKILL);
  EXPECT_EQ(run.end(), 128 + SIGKILL);
  EXPECT_TRUE(comes_true([&] { return !is_at_work(child); }));
  EXPECT_TRUE(std::filesystem::is_empty(place.folder / "tmp"));
}

TEST(RunInLaunches, a_process_that_dies_ends_the_run_and_what_was_measured_is_kept) {
  const LaunchPlace place;
  Running run(place.folder, "run -q c.json --rounds 400 -o r.json");
  ASSERT_TRUE(run.has_answered(place.partial));
  pid_t child = 0;
  if (!run.has_child(child)) GTEST_SKIP() << "this system tells of no children";
  kill(child, SIGKILL);
  EXPECT_EQ(run.end(), 70);
  const std::string err = file_text(place.folder / "err");
  EXPECT_NE(err.find("a process that was to measure ended (signal 9"), std::string::npos) << err;
  EXPECT_NE(err.find("what was measured is in r.json.partial, --resume goes on"), std::string::npos) << err;
}

TEST(RunInLaunches, too_few_files_that_may_be_open_are_one_error_that_says_how_many_to_allow) {
  const LaunchPlace place;
  std::size_t refused = 0;
  for (int files = 4; files <= 12; ++files) {
    const Outcome done =
        shell(place.folder, "ulimit -n " + std::to_string(files) + " && $run run -q c.json --rounds 4 -o r.json");
    if (done.code == 0) break;
    if (done.err.find("shared libraries") != std::string::npos) continue;  // not yet this program
    ++refused;
    EXPECT_EQ(done.code, 70) << files << ": " << done.err;
    EXPECT_NE(done.err.find("Too many open files; allow more of them (ulimit -n 256)"), std::string::npos) << done.err;
    EXPECT_EQ(done.err.find("/proc/self"), std::string::npos) << done.err;
  }
  EXPECT_GE(refused, 3u);
}

TEST(RunInLaunches, resumed_it_measures_what_no_launch_has_measured) {
  const LaunchPlace place;
  Running run(place.folder, "run -q c.json --rounds 40 -o r.json");
  ASSERT_TRUE(run.has_answered(place.partial));
  run.send(SIGTERM);
  EXPECT_EQ(run.end(), 75);
  EXPECT_NE(file_text(place.folder / "err").find("what was measured is in r.json.partial"), std::string::npos);
  std::istringstream lines(file_text(place.partial));
  std::string line;
  for (int i = 0; i < 2; ++i) std::getline(lines, line);
  const Json first = Json::parse(line);
  ASSERT_TRUE(first.contains("answer")) << line;

  const Outcome resumed = shell(place.folder, "$run run -q --resume c.json --rounds 40 -o r.json");
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(resumed.err.find("clusterbench: "), std::string::npos) << resumed.err;  // warnings of times may be
  const Json entry = Json::parse(file_text(place.out))["cases"][0];
  EXPECT_EQ(entry["id"], first["request"]["ids"][0]);
  const Json& before = first["answer"]["methods"][0]["build_ns"];
  const Json& now = entry["timing"]["build_ns"]["samples"];
  ASSERT_EQ(now.size(), 40u);
  ASSERT_EQ(before.size(), 10u);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(now[i].get<double>() / before[i].get<double>(), 1.0, 1e-5) << i;
}

TEST(RunInLaunches, a_changed_answer_in_an_interrupted_run_is_refused) {
  const LaunchPlace place;
  Running run(place.folder, "run -q c.json --rounds 40 -o r.json");
  ASSERT_TRUE(run.has_answered(place.partial));
  run.send(SIGTERM);
  ASSERT_EQ(run.end(), 75);
  std::string text = file_text(place.partial);
  text.replace(text.find("\"pairs\":[") + 9, 0, "1,");
  place.folder.write("r.json.partial", text);
  const Outcome refused = shell(place.folder, "$run run -q --resume c.json --rounds 40 -o r.json");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("line 2: is not what a run writes"), std::string::npos) << refused.err;
}

TEST(RunInLaunches, a_terminal_that_closes_interrupts_a_run_unless_it_is_to_be_ignored) {
  const LaunchPlace place;
  Running run(place.folder, "run -q c.json --rounds 400 -o r.json");
  ASSERT_TRUE(run.has_answered(place.partial));
  run.send(SIGHUP);
  EXPECT_EQ(run.end(), 75);
  EXPECT_TRUE(std::filesystem::exists(place.partial));

  Running deaf(place.folder, "run -q c.json -o d.json", test::program(), "trap '' HUP;");
  ASSERT_TRUE(deaf.has_answered((place.folder / "d.json.partial").string()));
  deaf.send(SIGHUP);
  EXPECT_EQ(deaf.end(), 0) << file_text(place.folder / "err");
}

TEST(RunInLaunches, a_missing_folder_for_temporary_files_is_named_by_what_needs_one) {
  const LaunchPlace place;
  const std::string run = "TMPDIR=/no/such/folder $run run -q c.json -o r.json";
  EXPECT_EQ(shell(place.folder, run).code, 0);
  const Outcome counted = shell(place.folder, run + " --count=callgrind");
  EXPECT_EQ(counted.code, 2);
  if (counted.err.find("--count=callgrind") != std::string::npos) GTEST_SKIP() << counted.err;
  EXPECT_NE(counted.err.find("/no/such/folder: TMPDIR: is not a folder"), std::string::npos) << counted.err;
}

TEST(RunInLaunches, another_program_beside_this_one_needs_a_file_that_both_can_read) {
  const LaunchPlace place;
  const Outcome refused = shell(place.folder, "$run run -q /dev/stdin --baseline-binary $run -o r.json <c.json");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("is no file that the other program could read"), std::string::npos) << refused.err;
}

TEST(RunInLaunches, names_that_are_not_utf8_are_taken_or_refused_before_measuring) {
  const LaunchPlace place;
  const std::string odd = "\"$(printf 'a\\377')\"";
  EXPECT_EQ(shell(place.folder, "$run run -q c.json -o " + odd + "r.json").code, 0);
  EXPECT_EQ(shell(place.folder, "cp c.json " + odd + ".json && $run run -q " + odd + ".json -o r.json").code, 0);
  EXPECT_EQ(Json::parse(file_text(place.out))["name"], "c");
  const Outcome refused = shell(place.folder, "cp level.glb " + odd + ".glb && $run run -q " + odd + ".glb -o r.json");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("clusterbench: 'a?.glb' is not UTF-8"), std::string::npos) << refused.err;
  EXPECT_EQ(shell(place.folder, "$run run -q c.json --set name=" + odd + " -o r.json").code, 2);
}

}  // namespace
}  // namespace clusterbench::test
