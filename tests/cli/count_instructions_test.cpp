#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

// A few cases that are counted in a moment, even under valgrind.
std::string tiny_config(const std::string& more = "") {
  return R"({"name": "tiny", "scenes": [{"path": ")" + source_file("scenes/street.glb") + R"(", "frames": 3}],
    "viewport": [640, 360],
    "grids": [{"kind": "frustum", "tiles": {"pixels": [160, 160]}, "slices": {"count": 4, "far": 100}}],
    "assigners": ["brute-force", "aabb", "exact-fast"], "storages": ["packed", "fixed"],
    "shading": {"samples": 0}, "accuracy": {"check": false},
    "timing": {"sweep_mib": 4, "rounds": 2, "min_time_ms": 0.1, "frames": 2})" +
         more + "}";
}

// Sets a variable for the programs that a test starts.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name), before_(std::getenv(name)) {
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { setenv(name_, before_.c_str(), 1); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::string before_;
};

// A folder with a configuration, and where a test wants one a program that calls itself valgrind.
struct CountPlace {
  Folder folder;
  std::string config = folder.write("tiny.json", tiny_config()).string();

  Outcome run(const std::string& arguments) const { return tool("run -q --no-timing " + config + " " + arguments); }

  // Why a way of counting cannot be had here; "" if it can.
  std::string obstacle(const std::string& way) const { return run("--dry-run --count=" + way).err; }

  void write_valgrind(const std::string& script) const {
    const auto file = folder.write("valgrind", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
};

#define SKIP_WITHOUT(place, way)                                                                         \
  if (const std::string obstacle = (place).obstacle(way); obstacle.find("--count") != std::string::npos) \
  GTEST_SKIP() << obstacle

TEST(Count, an_unknown_way_of_counting_is_answered_with_those_that_there_are) {
  const CountPlace place;
  const Outcome done = place.run("--count=prof");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("--count: found 'prof'; takes perf, callgrind or auto"), std::string::npos) << done.err;
}

TEST(Count, a_way_of_counting_that_is_not_joined_by_an_equals_sign_is_explained) {
  const CountPlace place;
  const Outcome done = place.run("--count callgrind");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("--count=callgrind"), std::string::npos) << done.err;
}

TEST(Count, without_the_flag_nothing_is_counted) {
  const CountPlace place;
  const Outcome done = place.run("");
  ASSERT_EQ(done.code, 0) << done.err;
  const Json cases = Json::parse(done.out)["cases"];
  EXPECT_EQ(cases.size(), 6u);
  for (const Json& entry : cases) EXPECT_FALSE(entry.contains("count"));
}

TEST(Count, without_valgrind_the_error_says_how_to_get_it) {
  const CountPlace place;
  const Environment path("PATH", place.folder.path().string());
  const Outcome done = place.run("--count=callgrind");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("--count=callgrind: "), std::string::npos) << done.err;
  const bool is_possible = done.err.find("sanitizers") == std::string::npos;
  EXPECT_NE(done.err.find(is_possible ? "apt-get install valgrind" : "use another build"), std::string::npos)
      << done.err;
}

TEST(Count, hardware_counters_count_or_the_error_says_what_refuses) {
  const CountPlace place;
  const Outcome done = place.run("--count=perf");
  if (done.code == 2) {
    EXPECT_NE(done.err.find("--count=perf: "), std::string::npos) << done.err;
    EXPECT_GT(done.err.size(), 50u) << done.err;
    EXPECT_EQ(done.out, "");
    GTEST_SKIP() << done.err;
  }
  ASSERT_EQ(done.code, 0) << done.err;
  const Json cases = Json::parse(done.out)["cases"];
  EXPECT_EQ(cases.size(), 6u);
  for (const Json& entry : cases) {
    EXPECT_EQ(entry["count"]["source"], "perf");
    EXPECT_GT(entry["count"]["instructions_per_frame"]["assign"], 0);
  }
}

TEST(Count, where_nothing_can_count_both_reasons_are_told) {
  const CountPlace place;
  if (place.obstacle("perf").find("--count") == std::string::npos) GTEST_SKIP() << "hardware counters work here";
  const Environment path("PATH", place.folder.path().string());
  const Outcome done = place.run("--count");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("perf: "), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("callgrind: "), std::string::npos) << done.err;
}

// Instructions per frame of every case: assign, convert, assign ...
std::vector<double> figures(const Json& result) {
  std::vector<double> out;
  for (const Json& entry : result["cases"]) {
    const Json& count = entry["count"];
    out.push_back(count["instructions_per_frame"]["assign"]);
    out.push_back(count["instructions_per_frame"]["convert"]);
  }
  return out;
}

TEST(Count, callgrind_gives_the_same_instructions_each_time) {
  const CountPlace place;
  SKIP_WITHOUT(place, "callgrind");
  const std::string first = (place.folder / "first.json").string(), second = (place.folder / "second.json").string();
  const Outcome done = place.run("--count=callgrind -o " + first);
  ASSERT_EQ(done.code, 0) << done.err;
  ASSERT_EQ(place.run("--count=callgrind -o " + second).code, 0);
  EXPECT_EQ(tool("validate " + first).code, 0);
  const Json result = Json::parse(file_text(first));
  const std::vector<double> once = figures(result), again = figures(Json::parse(file_text(second)));
  ASSERT_EQ(once.size(), 12u);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_GT(once[i], 0.0) << i;
    EXPECT_NEAR(again[i] / once[i], 1.0, 1e-3) << i;
  }
  for (const Json& entry : result["cases"]) {
    EXPECT_EQ(entry["count"]["source"], "callgrind");
    EXPECT_EQ(entry["count"]["frames"], 2);
    EXPECT_GT(entry["count"]["instructions_per_build"], 0);
    EXPECT_FALSE(entry["count"].contains("cycles_per_frame"));
    EXPECT_FALSE(entry.contains("timing"));
  }
}

TEST(Count, instructions_are_those_of_their_own_case) {
  const CountPlace place;
  SKIP_WITHOUT(place, "callgrind");
  const Outcome done = place.run("--count=callgrind");
  ASSERT_EQ(done.code, 0) << done.err;
  const Json cases = Json::parse(done.out)["cases"];
  ASSERT_EQ(cases.size(), 6u);
  const auto instructions = [&](std::size_t place_of, const char* stage) {
    return cases[place_of]["count"]["instructions_per_frame"][stage].get<double>();
  };
  constexpr std::size_t k_brute_force = 0, k_aabb = 2, k_exact_fast = 4;
  // Every light against every cell of 4 x 3 x 4 takes some instructions each, and no more than a few hundred.
  const double tests = cases[k_brute_force]["tests_done"].get<double>() / 3.0;
  EXPECT_GT(instructions(k_brute_force, "assign"), 5.0 * tests);
  EXPECT_LT(instructions(k_brute_force, "assign"), 500.0 * tests);
  EXPECT_LT(instructions(k_aabb, "assign"), instructions(k_brute_force, "assign"));
  EXPECT_NE(instructions(k_exact_fast, "assign"), instructions(k_aabb, "assign"));
  for (std::size_t packed = 0; packed < cases.size(); packed += 2) {
    EXPECT_EQ(instructions(packed, "assign"), instructions(packed + 1, "assign")) << "one method, two storages";
    EXPECT_NE(instructions(packed, "convert"), instructions(packed + 1, "convert"));
  }
}

TEST(Count, one_case_alone_counts_like_among_others) {
  const CountPlace place;
  SKIP_WITHOUT(place, "callgrind");
  const Outcome all = place.run("--count=callgrind"), alone = place.run("--count=callgrind --filter aabb/packed");
  ASSERT_EQ(all.code, 0) << all.err;
  ASSERT_EQ(alone.code, 0) << alone.err;
  const std::vector<double> one = figures(Json::parse(alone.out));
  ASSERT_EQ(one.size(), 2u);
  const std::vector<double> among = figures(Json::parse(all.out));
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(among[4 + i] / one[i], 1.0, 1e-3) << i;
}

TEST(Count, methods_on_a_device_are_left_out_of_it_and_measured_all_the_same) {
  const CountPlace place;
  SKIP_WITHOUT(place, "callgrind");
  const std::string out = (place.folder / "r.json").string();
  const Outcome done = place.run("--count=callgrind --assigner exact-fast,gpu-cells --filter packed -o " + out);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json result = Json::parse(file_text(out));
  if (!result["skipped"].empty()) GTEST_SKIP() << result["skipped"][0]["reason"];
  ASSERT_EQ(result["cases"].size(), 2u);
  for (const Json& counted : result["cases"])
    EXPECT_EQ(counted.contains("count"), counted["assigner"]["name"] == "exact-fast") << counted["name"];
}

TEST(Count, a_failure_under_valgrind_is_told_with_its_last_words) {
  const CountPlace place;
  place.write_valgrind("echo 'valgrind: no such tool' >&2; exit 3");
  const Environment path("PATH", place.folder.path().string());
  SKIP_WITHOUT(place, "callgrind");
  const Outcome done = place.run("--count=callgrind");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("failed (exit code 3): valgrind: no such tool"), std::string::npos) << done.err;
  EXPECT_EQ(done.out, "");
}

TEST(Count, a_valgrind_that_is_killed_is_told) {
  const CountPlace place;
  place.write_valgrind("kill -KILL $$");
  const Environment path("PATH", place.folder.path().string());
  SKIP_WITHOUT(place, "callgrind");
  const Outcome done = place.run("--count=callgrind");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("failed (signal 9 (killed"), std::string::npos) << done.err;
}

TEST(Count, a_case_that_was_not_counted_is_an_error) {
  const CountPlace place;
  place.write_valgrind("exit 0");
  const Environment path("PATH", place.folder.path().string());
  SKIP_WITHOUT(place, "callgrind");
  const Outcome done = place.run("--count=callgrind");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("was not counted"), std::string::npos) << done.err;
}

TEST(Count, output_that_is_no_count_is_an_error) {
  const CountPlace place;
  place.write_valgrind("echo 'abc AVX2 2 1 x 3'");
  const Environment path("PATH", place.folder.path().string());
  SKIP_WITHOUT(place, "callgrind");
  const Outcome done = place.run("--count=callgrind");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("printed 'abc AVX2 2 1 x 3'"), std::string::npos) << done.err;
}

TEST(Count, a_valgrind_that_does_not_count_is_an_error) {
  const CountPlace place;
  place.write_valgrind("while [ \"${1#--}\" != \"$1\" ]; do shift; done; exec \"$@\"");
  const Environment path("PATH", place.folder.path().string());
  SKIP_WITHOUT(place, "callgrind");
  const Outcome done = place.run("--count=callgrind");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("callgrind has written no count"), std::string::npos) << done.err;
}

TEST(Count, a_termination_signal_ends_valgrind_and_leaves_nothing_where_no_case_was_finished) {
  const CountPlace place;
  const std::string out = (place.folder / "r.json").string(), started = (place.folder / "started").string();
  const std::string ended = (place.folder / "ended").string();
  place.write_valgrind(
      "trap 'echo yes >" + ended + "; exit 1' TERM\necho yes >" + started +
      "\nfor i in 0 1 2 3 4 5 6 7 8 9; do for j in 0 1 2 3 4 5 6 7 8 9; do /bin/sleep 0.1; done; done");
  const Environment path("PATH", place.folder.path().string());
  SKIP_WITHOUT(place, "callgrind");
  const std::string run = test::program() + " run -q --count=callgrind " + place.config + " -o " + out + " 2>/dev/null";
  const std::string wait = "while [ ! -s " + started + " ]; do /bin/sleep 0.01; done";
  const int status = std::system((run + " & pid=$!; " + wait + "; kill -TERM $pid; wait $pid").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 75);
  EXPECT_FALSE(std::filesystem::exists(out + ".partial"));
  EXPECT_TRUE(std::filesystem::exists(ended)) << "valgrind went on";
}

TEST(Count, flags_that_change_the_configuration_reach_the_run_under_valgrind) {
  const CountPlace place;
  SKIP_WITHOUT(place, "callgrind");
  const Outcome done = place.run("--count=callgrind --viewport 320x180");
  ASSERT_EQ(done.code, 0) << done.err;
  const Json cases = Json::parse(done.out)["cases"];
  EXPECT_EQ(cases.size(), 6u);
  for (const Json& entry : cases) EXPECT_TRUE(entry.contains("count")) << entry["name"];
}

TEST(Count, a_resumed_run_counts_what_is_left) {
  const CountPlace place;
  SKIP_WITHOUT(place, "callgrind");
  const std::string whole = (place.folder / "whole.json").string(), cut = (place.folder / "cut.json").string();
  ASSERT_EQ(place.run("--count=callgrind -o " + whole).code, 0);
  const Json complete = Json::parse(file_text(whole));
  {
    place.write_valgrind("kill -KILL $PPID");  // leaves a journal without cases
    const Environment path("PATH", place.folder.path().string());
    ASSERT_EQ(place.run("--count=callgrind -o " + cut).code, 128 + 9);
  }
  Json kept = complete["cases"][0];
  kept["count"]["instructions_per_frame"]["assign"] = 12345;
  std::ofstream(cut + ".partial", std::ios::app) << journal_line(kept) << "\n";

  const Outcome without = place.run("--resume -o " + cut);
  EXPECT_EQ(without.code, 2) << "would mix cases with and without a count";
  const Outcome resumed = place.run("--resume --count=callgrind -o " + cut);
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  const std::vector<double> again = figures(Json::parse(file_text(cut))), once = figures(complete);
  ASSERT_EQ(again.size(), once.size());
  EXPECT_EQ(again[0], 12345.0) << "kept, not counted again";
  for (std::size_t i = 2; i < once.size(); ++i) EXPECT_NEAR(again[i] / once[i], 1.0, 1e-3) << i;
}

}  // namespace
}  // namespace clusterbench::test
