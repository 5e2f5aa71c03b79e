// Runs with plug-ins that crash, hang, take too much memory or fail: that costs their cases, and not the run.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/plugin_files.h"
#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

// Cases of one group: two methods of the program, and the plug-in's, each time with other parameters.
std::string guarded_config(const std::vector<std::string>& faults, const std::string& timing = R"(, "launches": 1)") {
  std::string assigners = R"("aabb", "bounds")";
  for (const std::string& fault : faults) assigners += R"(, {"name": "guard.faulty")" + fault + "}";
  return R"({"name": "guarded", "scenes": [{"path": ")" + source_file("scenes/street.glb") + R"(", "frames": 3}],
    "viewport": [320, 180],
    "grids": [{"kind": "frustum", "tiles": {"pixels": [64, 64]},
               "slices": {"scheme": "exponential", "count": 4, "near": 0.5, "far": 200}}],
    "plugins": [")" +
         plugin_file("faulty") + R"("], "assigners": [)" + assigners +
         R"(], "timing": {"sweep_mib": 4, "rounds": 3, "min_time_ms": 0.5, "frames": 2)" + timing + "}}";
}

struct GuardedPlace {
  Folder folder;
  std::string out = (folder / "r.json").string();

  std::string config(const std::vector<std::string>& faults, const std::string& timing = R"(, "launches": 1)") const {
    return folder.write("c.json", guarded_config(faults, timing)).string();
  }
  Outcome run(const std::vector<std::string>& faults, const std::string& flags = "",
              const std::string& timing = R"(, "launches": 1)") {
    return tool("run -q " + flags + " " + config(faults, timing) + " -o " + out);
  }
  Json result() const { return Json::parse(file_text(out)); }
};

// The same whenever it is made.
Json counts_of(const Json& result_case) {
  Json counts = result_case;
  for (const char* key : {"timing", "cost", "eligible"}) counts.erase(key);
  return counts;
}

Json case_of(const Json& result, const std::string& method) {
  for (const Json& one : result["cases"])
    if (one["assigner"]["name"] == method) return one;
  return nullptr;
}

// Its methods are measured, and timed, as without the plug-in's.
void expect_others_measured(const Json& result) {
  for (const char* name : {"aabb", "bounds"}) {
    const Json measured = case_of(result, name);
    ASSERT_TRUE(measured.is_object()) << name;
    EXPECT_GE(measured["timing"]["frame_ns"]["samples"].size(), 1u);  // with cold caches, of which large ones allow one
    EXPECT_GE(measured["timing"]["warm"]["frame_ns"]["samples"].size(), 3u);  // of each launch two at least
    EXPECT_EQ(measured["failures"].size(), 0u);
  }
}

TEST(GuardedRun, of_a_plug_in_without_a_fault_has_all_cases) {
  GuardedPlace place;
  const Outcome done = place.run({""});
  EXPECT_EQ(done.code, 0) << done.err;
  const Json result = place.result();
  EXPECT_EQ(result["cases"].size(), 3u);
  EXPECT_FALSE(result.contains("broken"));
  EXPECT_EQ(result["command"].get<std::string>().find("clusterbench run -q"), 0u);
  EXPECT_TRUE(result["machine"]["load"].is_object());
  expect_others_measured(result);
}

TEST(GuardedRun, loses_only_the_case_in_which_the_plug_in_crashes) {
  GuardedPlace place;
  const Outcome done = place.run({R"(, "fault": "segv", "call": 3)", ""});
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = place.result();
  ASSERT_EQ(result["broken"].size(), 1u);
  const Json broken = result["broken"][0];
  EXPECT_EQ(broken["kind"], "crashed");
  EXPECT_EQ(broken["signal"], "SIGSEGV");
  EXPECT_EQ(broken["step"], "assign");
  EXPECT_EQ(broken["plugin"], "guard");
  EXPECT_EQ(broken["method"], "guard.faulty");
  EXPECT_EQ(broken["pass"], "truth and counts");
  EXPECT_TRUE(broken["frame"].is_number_unsigned());
  const std::string reason = broken["reason"];
  EXPECT_EQ(reason.find("the plug-in guard crashed (SIGSEGV) in assign, frame "), 0u) << reason;
  EXPECT_NE(done.err.find("FAILED " + broken["name"].get<std::string>() + ": " + reason), std::string::npos)
      << done.err;
  EXPECT_EQ(result["cases"].size(), 3u) << "two methods, and the plug-in's with other parameters";
  expect_others_measured(result);
  EXPECT_FALSE(std::filesystem::exists(place.out + ".partial"));
  EXPECT_TRUE(result["conclusions"][0]["take"].is_null());
}

TEST(GuardedRun, tells_every_way_to_crash) {
  const std::pair<const char*, const char*> k_ways[] = {{"segv", "crashed (SIGSEGV)"},
                                                        {"fpe", "crashed (SIGFPE)"},
                                                        {"ill", "crashed (SIGILL)"},
                                                        {"abort", "crashed (SIGABRT)"},
#ifndef CLUSTERBENCH_SANITIZED  // which handle it
                                                        {"overflow", "crashed (SIGSEGV)"},
#endif
                                                        {"exit", "ended the process (exit code 0)"}};
  for (const auto& [fault, told] : k_ways) {
    GuardedPlace place;
    const Outcome done = place.run({std::string(R"(, "fault": ")") + fault + "\""}, "--no-timing");
    EXPECT_EQ(done.code, 1) << done.err;
    const Json result = place.result();
    ASSERT_EQ(result["broken"].size(), 1u) << fault;
    EXPECT_EQ(result["broken"][0]["kind"], "crashed");
    EXPECT_NE(result["broken"][0]["reason"].get<std::string>().find(told), std::string::npos) << result["broken"];
    EXPECT_EQ(result["cases"].size(), 2u);
  }
}

TEST(GuardedRun, tells_in_which_function_the_plug_in_crashed) {
  for (const char* step : {"create", "build", "destroy"}) {
    GuardedPlace place;
    const Outcome done = place.run({std::string(R"(, "fault": "abort", "at": ")") + step + "\""}, "--no-timing");
    EXPECT_EQ(done.code, 1) << done.err;
    const Json result = place.result();
    ASSERT_EQ(result["broken"].size(), 1u) << step;
    EXPECT_EQ(result["broken"][0]["step"], step);
    EXPECT_FALSE(result["broken"][0].contains("frame"));
    EXPECT_EQ(result["cases"].size(), 2u);
  }
}

// Processes of that command line.
std::vector<std::string> processes_with(const std::string& text) {
  std::vector<std::string> found;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", failed))
    if (file_text(entry.path() / "cmdline").find(text) != std::string::npos)
      found.push_back(entry.path().filename().string());
  return found;
}

// A copy of the measuring process that went on would hold the result's journal, and measure, too.
TEST(GuardedRun, loses_only_the_case_of_a_plug_in_that_forks) {
  for (const char* step : {"create", "build", "assign"})
    for (const char* timing : {R"(, "launches": 1)", R"(, "launches": 2)"}) {
      GuardedPlace place;
      const Outcome done = place.run({std::string(R"(, "fault": "fork", "at": ")") + step + "\""}, "", timing);
      EXPECT_EQ(done.code, 1) << done.err;
      const Json result = place.result();
      ASSERT_EQ(result["broken"].size(), 1u) << done.err;
      EXPECT_EQ(result["broken"][0]["kind"], "crashed");
      const std::string reason = result["broken"][0]["reason"];
      EXPECT_EQ(reason.find("the plug-in guard came back twice (it forked) from " + std::string(step)), 0u) << reason;
      expect_others_measured(result);
      EXPECT_TRUE(processes_with(place.out).empty());
    }
}

TEST(GuardedRun, in_its_own_process_loses_only_the_case_of_a_plug_in_that_forks) {
  GuardedPlace place;
  const Outcome done = place.run({R"(, "fault": "fork", "nap": 20)"}, "--plugin-in-process --no-timing");
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = place.result();
  ASSERT_EQ(result["broken"].size(), 1u) << done.err;
  EXPECT_NE(result["broken"][0]["reason"].get<std::string>().find("came back twice from assign: it forked"),
            std::string::npos);
  EXPECT_EQ(result["cases"].size(), 2u);
  EXPECT_TRUE(processes_with(place.out).empty());
}

TEST(GuardedRun, loses_only_the_case_of_a_plug_in_that_closes_files_of_the_program) {
  for (const char* timing : {R"(, "launches": 1)", R"(, "launches": 2)"}) {
    GuardedPlace place;
    const Outcome done = place.run({R"(, "fault": "close")"}, "", timing);
    EXPECT_EQ(done.code, 1) << done.err;
    const Json result = place.result();
    ASSERT_EQ(result["broken"].size(), 1u) << done.err;
    const std::string reason = result["broken"][0]["reason"];
    EXPECT_EQ(reason.find("the plug-in guard closed a file of the program, or put another in its place (descriptor "),
              0u)
        << reason;
    EXPECT_NE(reason.find(") in assign, frame "), std::string::npos) << reason;
    expect_others_measured(result);
  }
}

TEST(GuardedRun, of_a_search_says_which_plug_in_closed_files_of_the_program) {
  const Outcome done = tool("stress -q --cases '^H1$' --threads 1 --tries 0 --methods hostile.closes --plugin " +
                            plugin_folder() + "/hostile.so");
  EXPECT_EQ(done.code, 1) << done.out;
  EXPECT_NE(done.err.find("the plug-in hostile closed a file of the program"), std::string::npos) << done.err;
}

TEST(GuardedRun, names_the_other_plug_ins_where_memory_can_be_theirs) {
  GuardedPlace place;
  std::string text = guarded_config({R"(, "fault": "abort")", R"(, "fault": "twice")", R"(, "fault": "throw")"});
  text.insert(text.find(R"("aabb", "bounds")"), R"("example.cell-boxes", )");
  const std::string config = place.folder.write("two.json", text).string();
  const Outcome done =
      tool("run -q --no-timing --plugin " + plugin_folder() + "/example.so " + config + " -o " + place.out);
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = place.result();
  ASSERT_EQ(result["broken"].size(), 3u) << done.err;
  for (const Json& one : result["broken"]) {
    const std::string reason = one["reason"];
    const bool is_thrown = reason.find("cannot go on") != std::string::npos;
    EXPECT_EQ(reason.find("; the plug-in example ran in the same process") != std::string::npos, !is_thrown) << reason;
  }
}

TEST(GuardedRun, of_a_search_for_the_best_names_the_frame_and_the_way_without_the_plug_in) {
  for (const char* fault : {"throw", "abort"}) {
    GuardedPlace place;
    const Outcome done =
        tool("recommend -q --no-timing " + place.config({std::string(R"(, "fault": ")") + fault + "\""}));
    EXPECT_EQ(done.code, 1) << done.err;
    EXPECT_NE(done.err.find("frame "), std::string::npos) << done.err;
    EXPECT_NE(done.err.find("; recommend ends where a method fails: name the others by --assigner"), std::string::npos)
        << done.err;
  }
}

TEST(GuardedRun, keeps_the_figures_of_a_case_whose_plug_in_crashes_as_it_is_unloaded) {
  for (const auto& [fault, kind] : {std::pair{"segv", "crashed"}, std::pair{"hang", "timed_out"}}) {
    GuardedPlace place;
    const Outcome done =
        place.run({std::string(R"(, "at": "unload", "fault": ")") + fault + "\""}, "--plugin-timeout 1 --no-timing");
    EXPECT_EQ(done.code, 1) << done.err;
    const Json result = place.result();
    EXPECT_FALSE(result.contains("broken"));
    ASSERT_EQ(result["cases"].size(), 3u);
    const Json broken = case_of(result, "guard.faulty");
    ASSERT_EQ(broken["failures"].size(), 1u);
    EXPECT_EQ(broken["failures"][0]["kind"], kind);
    EXPECT_NE(broken["failures"][0]["text"].get<std::string>().find("in unload"), std::string::npos);
    EXPECT_EQ(broken["eligible"], false);
    EXPECT_EQ(case_of(result, "aabb")["failures"].size(), 0u);
  }
}

TEST(GuardedRun, ends_a_call_that_does_not_return) {
  GuardedPlace place;
  const Outcome done = place.run({R"(, "fault": "hang", "call": 2)"}, "--plugin-timeout 0.7");
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = place.result();
  ASSERT_EQ(result["broken"].size(), 1u);
  EXPECT_EQ(result["broken"][0]["kind"], "timed_out");
  EXPECT_NE(result["broken"][0]["reason"].get<std::string>().find("did not return within 0.7 s in assign"),
            std::string::npos);
  expect_others_measured(result);
}

TEST(GuardedRun, ends_a_call_that_takes_more_memory_than_it_may) {
  GuardedPlace place;
  const Outcome done = place.run({R"(, "fault": "eat")"}, "--plugin-memory 300");
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = place.result();
  ASSERT_EQ(result["broken"].size(), 1u);
  EXPECT_EQ(result["broken"][0]["kind"], "out_of_memory");
  EXPECT_NE(result["broken"][0]["reason"].get<std::string>().find("took more than 300 MiB of memory in assign"),
            std::string::npos);
  expect_others_measured(result);
}

TEST(GuardedRun, loses_a_case_that_fails_or_whose_lists_are_none_in_the_same_process) {
  GuardedPlace place;
  const Outcome done = place.run({R"(, "fault": "throw", "call": 2)", R"(, "fault": "twice", "call": 2)", ""});
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = place.result();
  ASSERT_EQ(result["broken"].size(), 2u) << done.err;
  EXPECT_EQ(result["broken"][0]["kind"], "failed");
  EXPECT_NE(result["broken"][0]["reason"].get<std::string>().find("cannot go on"), std::string::npos);
  EXPECT_EQ(result["broken"][1]["kind"], "failed");
  EXPECT_EQ(result["cases"].size(), 3u);
  expect_others_measured(result);
}

TEST(GuardedRun, measures_the_others_again_if_a_plug_in_crashes_among_their_rounds) {
  GuardedPlace place;
  const Outcome done = place.run({R"(, "fault": "segv", "call": 40)"});
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = place.result();
  ASSERT_EQ(result["broken"].size(), 1u);
  EXPECT_EQ(result["broken"][0]["pass"], "time");
  expect_others_measured(result);
  const Json session = case_of(result, "aabb")["timing"]["session"];
  EXPECT_EQ(case_of(result, "bounds")["timing"]["session"], session);
}

TEST(GuardedRun, of_several_launches_loses_the_case_that_crashes_in_one_of_them) {
  for (const char* fault : {"segv", "throw", "hang"}) {
    GuardedPlace place;
    const Outcome done = place.run({std::string(R"(, "call": 12, "fault": ")") + fault + "\"", ""},
                                   "--plugin-timeout 2", R"(, "launches": 3)");
    EXPECT_EQ(done.code, 1) << done.err;
    const Json result = place.result();
    ASSERT_EQ(result["broken"].size(), 1u) << fault << done.err;
    EXPECT_EQ(result["broken"][0]["pass"], "time, launch 1 of 3");
    EXPECT_EQ(result["cases"].size(), 3u);
    expect_others_measured(result);
  }
}

TEST(GuardedRun, has_the_counts_of_a_run_without_the_plug_in) {
  GuardedPlace with, without;
  ASSERT_EQ(with.run({R"(, "fault": "segv", "call": 2)", R"(, "fault": "abort", "at": "build")"}, "--no-timing").code,
            1);
  ASSERT_EQ(without.run({}, "--no-timing").code, 0);
  for (const char* name : {"aabb", "bounds"})
    EXPECT_EQ(counts_of(case_of(with.result(), name)), counts_of(case_of(without.result(), name)));
}

TEST(GuardedRun, writes_to_a_pipe_what_it_writes_to_a_file) {
  GuardedPlace place;
  const std::string config = place.config({R"(, "fault": "segv", "call": 2)"});
  const Outcome piped = tool("run -q --no-timing " + config),
                filed = place.run({R"(, "fault": "segv", "call": 2)"}, "--no-timing");
  EXPECT_EQ(piped.code, 1) << piped.err;
  EXPECT_EQ(Json::parse(piped.out), place.result());
  EXPECT_EQ(filed.code, 1);
}

TEST(GuardedRun, refuses_by_its_name_a_plug_in_that_crashes_as_it_is_loaded) {
  GuardedPlace place;
  const Outcome refused = tool("run -q " + source_file("scenes/street.glb") + " --plugin " +
                               plugin_file("faulty_entry") + " -o " + place.out);
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err, "clusterbench: the plug-in faulty_entry.so crashed (SIGSEGV) in load\n");
  EXPECT_FALSE(std::filesystem::exists(place.out));
}

// A run that is signalled once its journal has a case: of a group before that of the slow plug-in.
struct SlowPlace : GuardedPlace {
  pid_t pid = -1;

  SlowPlace() {
    std::string text = guarded_config({R"(, "nap": 100)"}, R"(, "measure": false)");
    const std::string grids = R"("grids": [)";
    text.insert(text.find(grids) + grids.size(), R"({"kind": "world", "cells": [4, 2, 4]}, )");
    text.insert(text.find(R"("aabb", "bounds")"), R"("world-grid", )");
    const std::string config = folder.write("slow.json", text).string();
    pid = fork();
    if (pid == 0) {
      execl(
          "/bin/sh", "sh", "-c",
          ("exec " + test::program() + " run -q " + config + " -o " + out + " 2>" + (folder / "err").string()).c_str(),
          nullptr);
      _exit(127);
    }
    for (int i = 0; i < 3000 && file_text(out + ".partial").find("\"case\"") == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  int end_by(int number) const {
    kill(pid, number);
    int status = 0;
    waitpid(pid, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  Outcome resumed() const { return tool("run -q --resume " + (folder / "slow.json").string() + " -o " + out); }
};

TEST(GuardedRun, that_is_interrupted_goes_on_with_resume) {
  const SlowPlace place;
  EXPECT_EQ(place.end_by(SIGTERM), 75);
  EXPECT_NE(file_text(place.folder / "err").find("--resume goes on"), std::string::npos);
  const Outcome resumed = place.resumed();
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(place.result()["cases"].size(), 4u);
}

TEST(GuardedRun, that_is_interrupted_in_a_call_that_hangs_ends_within_seconds) {
  const GuardedPlace place;
  const std::string command = "exec " + test::program() + " run -q --no-timing --plugin-timeout 60 " +
                              place.config({R"(, "fault": "hang")"}) + " -o " + place.out + " 2>" +
                              (place.folder / "err").string();
  const pid_t pid = fork();
  if (pid == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  std::this_thread::sleep_for(std::chrono::seconds(3));
  const auto start = std::chrono::steady_clock::now();
  kill(pid, SIGTERM);
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(WEXITSTATUS(status), 75);
  const std::string told = file_text(place.folder / "err");
  EXPECT_NE(told.find("interrupted; the plug-in guard was ended in assign"), std::string::npos) << told;
  EXPECT_NE(told.find("; no case was finished"), std::string::npos) << told;
}

TEST(GuardedRun, that_is_killed_leaves_no_process_and_goes_on_with_resume) {
  const SlowPlace place;
  EXPECT_EQ(place.end_by(SIGKILL), 128 + 9);
  Outcome resumed = place.resumed();
  for (int i = 0; i < 100 && resumed.code == 2; ++i) {  // the journal is free once the measuring process is gone
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    resumed = place.resumed();
  }
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(place.result()["cases"].size(), 4u);
}

TEST(GuardedRun, that_crashed_is_a_regression_of_one_that_did_not) {
  GuardedPlace good, bad;
  ASSERT_EQ(good.run({R"(, "fault": "segv", "call": 1000000)"}, "--no-timing").code, 0);
  ASSERT_EQ(bad.run({R"(, "fault": "segv", "call": 1000000)"}, "--no-timing").code, 0);
  Json broken = bad.result();
  const Json lost = case_of(broken, "guard.faulty");
  std::erase_if(broken["cases"].get_ref<Json::array_t&>(), [&](const Json& one) { return one["id"] == lost["id"]; });
  Json record{{"kind", "crashed"},
              {"reason", "the plug-in guard crashed (SIGSEGV) in assign"},
              {"step", "assign"},
              {"method", "guard.faulty"},
              {"plugin", "guard"}};
  for (const char* key : {"id", "settings", "name", "scene", "camera"}) record[key] = lost[key];
  broken["broken"] = {record};
  for (Json& front : broken["pareto_front"]) front["ids"] = Json::array();
  bad.folder.write("r.json", broken.dump());
  const std::string told = (bad.folder / "compared.json").string();
  const Outcome compared = tool("compare " + good.out + " " + bad.out + " --json " + told);
  EXPECT_EQ(compared.code, 1) << compared.err << compared.out;
  const std::string name = lost["name"];
  EXPECT_NE(file_text(told).find("the base has figures of it"), std::string::npos) << file_text(told);
  EXPECT_EQ(Json::parse(file_text(told))["broken"][0]["name"], name);
  EXPECT_EQ(tool("compare " + good.out + " " + good.out).code, 0);
}

TEST(GuardedRun, beside_another_program_loses_the_comparison_of_the_case_at_which_one_of_them_crashes) {
  GuardedPlace place;
  const Outcome done =
      place.run({R"(, "fault": "segv", "at": "rounds")"},
                "--baseline-launches 2 --baseline-most-launches 2 --baseline-binary " + test::program());
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = place.result();
  ASSERT_EQ(result["cases"].size(), 3u);
  const Json lost = case_of(result, "guard.faulty");
  ASSERT_EQ(lost["failures"].size(), 1u);
  EXPECT_EQ(lost["failures"][0]["kind"], "crashed");
  EXPECT_EQ(lost["failures"][0]["text"].get<std::string>().find("not compared: "), 0u);
  EXPECT_FALSE(lost["timing"].contains("baseline"));
  EXPECT_TRUE(case_of(result, "aabb")["timing"].contains("baseline"));
}

TEST(GuardedRun, is_merged_and_shown_with_its_broken_case) {
  GuardedPlace place;
  const std::vector<std::string> faults{R"(, "fault": "segv", "call": 2)"};
  ASSERT_EQ(place.run(faults, "--no-timing --filter faulty").code, 1);
  EXPECT_EQ(place.result()["cases"].size(), 0u);
  const std::string rest = (place.folder / "rest.json").string(), all = (place.folder / "all.json").string();
  ASSERT_EQ(tool("run -q --no-timing --filter 'aabb|bounds' " + place.config(faults) + " -o " + rest).code, 0);
  EXPECT_EQ(tool("merge " + place.out + " " + rest + " -o " + all).code, 0);
  const Json merged = Json::parse(file_text(all));
  EXPECT_EQ(merged["cases"].size(), 2u);
  ASSERT_EQ(merged["broken"], place.result()["broken"]);
  const std::string reason = merged["broken"][0]["reason"];
  const Outcome shown = tool("report " + all + " -o " + (place.folder / "all.html").string());
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_NE(file_text(place.folder / "all.html").find(reason), std::string::npos);
  const Outcome exported = tool("export " + all + " --format markdown");
  EXPECT_NE(exported.out.find(reason), std::string::npos) << exported.out << exported.err;
}

TEST(GuardedRun, of_stress_tells_the_setting_at_which_the_plug_in_crashed) {
  const Outcome random =
      tool("stress -q --random 3 --seed 7 --threads 1 --methods faulty --plugin " + plugin_file("faulty_always"));
  EXPECT_EQ(random.code, 1) << random.err;
  EXPECT_EQ(random.err,
            "clusterbench: the plug-in always crashed (SIGSEGV) in assign, frame 0; with --random 1 --seed 7\n");
  const Outcome hard =
      tool("stress -q --cases '^H1$' --threads 1 --methods faulty --tries 0 --plugin " + plugin_file("faulty_always"));
  EXPECT_EQ(hard.code, 1) << hard.err;
  EXPECT_NE(hard.err.find("; with --cases '^H1$', method always.faulty"), std::string::npos) << hard.err;
}

TEST(GuardedRun, draws_pictures_of_the_cases_that_were_measured) {
  GuardedPlace place;
  const std::string folder = (place.folder / "pictures").string();
  EXPECT_EQ(place.run({R"(, "fault": "segv", "call": 2)", ""}, "--no-timing --images " + folder).code, 1);
  const std::string index = file_text(folder + "/pictures.json");
  EXPECT_EQ(index.find(place.result()["broken"][0]["id"].get<std::string>()), std::string::npos);
  EXPECT_NE(index.find(case_of(place.result(), "guard.faulty")["id"].get<std::string>()), std::string::npos) << index;
}

TEST(GuardedRun, told_in_a_process_of_the_user_takes_no_other) {
  GuardedPlace place;
  const Outcome crashed = place.run({R"(, "fault": "segv")"}, "--plugin-in-process");
  EXPECT_EQ(crashed.code, 128 + SIGSEGV) << crashed.err;  // as the shell tells it
  GuardedPlace good;
  EXPECT_EQ(good.run({""}, "--plugin-in-process").code, 0);
  EXPECT_EQ(good.result()["cases"].size(), 3u);
}

TEST(GuardedRun, that_only_plans_tells_a_crash) {
  GuardedPlace place;
  const Outcome planned = tool("run --dry-run " + place.config({R"(, "fault": "segv")"}));
  EXPECT_EQ(planned.code, 1) << planned.err;
  EXPECT_NE(planned.err.find("the plug-in guard crashed (SIGSEGV) in assign"), std::string::npos) << planned.err;
}

TEST(GuardedRun, takes_a_configuration_through_a_pipe_if_a_flag_names_the_plug_in) {
  GuardedPlace place;
  const std::string config = place.config({R"(, "fault": "segv")"});
  const std::string run = test::program() + " run -q --no-timing /dev/stdin -o " + place.out;
  EXPECT_EQ(WEXITSTATUS(std::system(
                ("cat " + config + " | " + run + " --plugin " + plugin_file("faulty") + " 2>/dev/null").c_str())),
            1);
  EXPECT_EQ(place.result()["broken"].size(), 1u);
  EXPECT_EQ(WEXITSTATUS(std::system(("cat " + config + " | " + run + " 2>/dev/null").c_str())), 2);
}

}  // namespace
}  // namespace clusterbench::test
