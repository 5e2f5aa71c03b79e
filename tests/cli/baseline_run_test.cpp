#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

// A configuration that is measured in no time, and programs to measure beside it.
struct Place {
  Folder folder;
  std::string config = write_config(3);
  std::string out = (folder / "r.json").string();

  std::string write_config(int rounds) const {
    return folder
        .write("c.json", R"({"scenes": [{"path": ")" + source_file("scenes/street.glb") + R"(", "frames": 2}],
           "viewport": [640, 360], "accuracy": {"check": false}, "shading": {"samples": 0},
           "grids": [{"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "linear", "count": 4}}],
           "assigners": ["aabb", "sphere-refinement"], "storages": ["packed", {"name": "fixed", "cap": 64}],
           "limits": {"dropped_pairs": null},
           "timing": {"sweep_mib": 4, "min_time_ms": 0.1, "frames": 2, "rounds": )" +
                             std::to_string(rounds) + "}}")
        .string();
  }

  std::string script(const std::string& body) const {
    const std::filesystem::path path = folder.write("other", "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path.string();
  }

  Outcome run(const std::string& baseline, const std::string& flags = "") const {
    return tool("run -q " + config + " -o " + out + " --baseline-launches 3 --baseline-binary " + baseline + " " +
                flags);
  }
};

const std::string k_greeting = R"(echo '{"clusterbench_rounds": 1, "tool": {"version": "9"}, "cases": ["x"]}')";
// No change of time is beyond this.
const std::string k_any_time = "--threshold 1000";

TEST(Baseline, both_programs_are_measured_and_the_result_carries_the_pairs) {
  const Place place;
  const Outcome done = place.run(test::program(), k_any_time);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("times of assignment side by side"), std::string::npos) << done.err;
  EXPECT_EQ(tool("validate " + place.out).code, 0) << tool("validate " + place.out).err;
  const Json result = Json::parse(file_text(place.out));
  EXPECT_EQ(result["baseline"]["tool"], result["tool"]);
  ASSERT_EQ(result["cases"].size(), 4u);
  for (const Json& entry : result["cases"]) {
    const Json& baseline = entry["timing"]["baseline"];
    ASSERT_EQ(baseline["launches"].size(), 3u);
    for (const Json& launch : baseline["launches"]) EXPECT_EQ(launch["base_ns"].size(), launch["new_ns"].size());
    EXPECT_GT(baseline["launches"][2]["base_ns"][3], 0.0);
    EXPECT_FALSE(baseline.contains("lists_differ"));
  }
  const Outcome compared = tool("compare " + place.out + " " + place.out + " " + k_any_time);
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_NE(compared.out.find("times of assignment side by side"), std::string::npos) << compared.out;
}

TEST(Baseline, the_same_program_is_no_difference_and_says_what_would_show) {
  const Place place;
  const Outcome done = place.run(test::program());
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(
      done.err.find("no difference: both are the same program, byte for byte, and beside itself its times differ by "
                    "at most "),
      std::string::npos)
      << done.err;
  EXPECT_EQ(done.err.find("inconclusive"), std::string::npos) << done.err;
  const Outcome wrapped = place.run(place.script("exec " + test::program() + " \"$@\""), "--threshold 0.01");
  EXPECT_EQ(wrapped.err.find("the same program"), std::string::npos) << "a script may do anything";
  const bool is_open = wrapped.err.find("inconclusive") != std::string::npos;
  EXPECT_EQ(wrapped.err.find("and the threshold is 0.01 %. ") != std::string::npos, is_open) << wrapped.err;
}

TEST(Baseline, flags_that_change_the_configuration_reach_both_programs) {
  const Place place;
  const Outcome done = place.run(test::program(), k_any_time + " --tiles 128 --set 'grids.*.slices.count=3'");
  ASSERT_EQ(done.code, 0) << done.err;
  const Json cases = Json::parse(file_text(place.out))["cases"];
  EXPECT_EQ(cases.size(), 4u);
  for (const Json& entry : cases) EXPECT_TRUE(entry["timing"].contains("baseline")) << entry["name"];
}

TEST(Baseline, budgets_are_held_here_and_not_asked_of_a_program_that_may_not_know_them) {
  const Place place;
  const std::string older = place.script("case \"$*\" in *fail-if*) echo 'unknown option' >&2; exit 2;; esac; exec " +
                                         test::program() + " \"$@\"");
  EXPECT_EQ(place.run(older, k_any_time + " --fail-if 'longest > 1e6'").code, 0);
  const Outcome broken = place.run(older, k_any_time + " --fail-if 'longest > 0'");
  EXPECT_EQ(broken.code, 1);
  EXPECT_NE(broken.err.find("FAILED "), std::string::npos) << broken.err;
}

TEST(Baseline, a_program_that_takes_several_times_as_long_fails_the_run) {
  const Place place;
  const std::string slowed = "CLUSTERBENCH_SLOWED_PERCENT=700 " + test::slowed_program() + " run -q " + place.config +
                             " -o " + place.out + " --baseline-most-launches 10 --baseline-binary " + test::program() +
                             " 2>" + (place.folder / "err").string();
  EXPECT_EQ(WEXITSTATUS(std::system(slowed.c_str())), 1) << file_text(place.folder / "err");
  EXPECT_NE(file_text(place.folder / "err").find("slower by"), std::string::npos);
  EXPECT_EQ(tool("compare " + place.out + " " + place.out).code, 1);
}

// No interval of three short rounds is that narrow.
TEST(Baseline, launches_go_on_until_intervals_are_narrow_or_there_were_the_most) {
  const Place place;
  const Outcome done = place.run(test::program(), "--threshold 0.01 --baseline-most-launches 5");
  ASSERT_NE(done.code, 2) << done.err;
  const Json result = Json::parse(file_text(place.out));
  ASSERT_EQ(result["cases"].size(), 4u);
  for (const Json& entry : result["cases"])
    EXPECT_EQ(entry["timing"]["baseline"]["launches"].size(), 5u) << entry["id"];
}

TEST(Baseline, lists_that_differ_are_named_and_fail) {
  const Place place;
  const std::string changed = place.script(
      test::program() + R"( "$@" | sed -u 's/"sha256":"[0-9a-f]*/"sha256":"0/g; s/"lights":\[\[/&999999,/')");
  const Outcome done = place.run(changed, k_any_time);
  EXPECT_EQ(done.code, 1) << done.err;
  EXPECT_NE(done.err.find("lists differ in 2 frames, first in frame 0, cell [0,0,0], light"), std::string::npos)
      << done.err;
  EXPECT_EQ(tool("validate " + place.out).code, 0);
}

TEST(Baseline, what_is_no_clusterbench_is_told_before_anything_is_measured) {
  const Place place;
  for (const std::string& other : {std::string("/bin/true"), std::string("/no/such/program"),
                                   place.script("echo 'The following argument was not expected' >&2; exit 2")}) {
    const Outcome done = place.run(other);
    EXPECT_EQ(done.code, 2) << other;
    EXPECT_NE(done.err.find(other), std::string::npos) << done.err;
    EXPECT_FALSE(std::filesystem::exists(place.out + ".partial")) << "measured first";
  }
  EXPECT_NE(place.run(place.script("echo hello")).err.find("greets otherwise"), std::string::npos);
  const Outcome newer = place.run(place.script(R"(echo '{"clusterbench_rounds": 2}')"));
  EXPECT_NE(newer.err.find("speaks version 2, this one 1"), std::string::npos) << newer.err;
}

TEST(Baseline, a_program_without_a_common_case_gives_code_3) {
  const Place place;
  EXPECT_EQ(place.run(place.script(k_greeting + "; exec sleep 100")).code, 3);
}

std::string killed_after_greeting() {
  // Takes the greeting from the true one, so that cases are known.
  return std::string("echo $$ >> $0.pid; ") + test::program() + R"( "$@" </dev/null; )";
}

// Every process that the script was has gone.
bool has_gone(const std::string& script) {
  std::istringstream pids(file_text(script + ".pid"));
  for (pid_t pid = 0; pids >> pid;)
    if (kill(pid, 0) == 0) return false;
  return true;
}

TEST(Baseline, a_program_that_dies_is_told_with_its_last_words) {
  const Place place;
  const Outcome done = place.run(place.script(killed_after_greeting() + "echo 'out of luck' >&2; kill -SEGV $$"));
  EXPECT_EQ(done.code, 70) << "as for a launch that dies";
  EXPECT_NE(done.err.find("ended (signal 11 (Segmentation fault)) at 'lists "), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("out of luck"), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("; what was measured is in " + place.out + ".partial, --resume goes on"), std::string::npos)
      << done.err;
}

TEST(Baseline, a_program_that_is_interrupted_or_gives_up_is_told_apart) {
  const Place place;
  EXPECT_EQ(place.run(place.script(killed_after_greeting() + "kill -INT $$")).code, 70);
  EXPECT_EQ(place.run(place.script(killed_after_greeting() + "exit 3")).code, 2);
}

TEST(Baseline, a_program_that_hangs_is_ended) {
  const Place place;
  const std::string other = place.script(killed_after_greeting() + "trap '' TERM INT; exec sleep 1000");
  const Outcome done = place.run(other, "--baseline-timeout 3");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("gave no answer to 'lists "), std::string::npos) << done.err;
  EXPECT_TRUE(has_gone(other));
}

TEST(Baseline, an_answer_that_is_none_is_an_error) {
  const Place place;
  const Outcome broken = place.run(place.script(killed_after_greeting() + "echo '{}'; exec sleep 1000"));
  EXPECT_EQ(broken.code, 2);
  EXPECT_NE(broken.err.find("answered what cannot be read"), std::string::npos) << broken.err;
  const Outcome nonsense = place.run(place.script(killed_after_greeting() + "echo nonsense; exec sleep 1000"));
  EXPECT_EQ(nonsense.code, 2);
  EXPECT_NE(nonsense.err.find("with 'nonsense'"), std::string::npos) << nonsense.err;
}

TEST(Baseline, a_termination_signal_ends_both_and_keeps_finished_cases) {
  const Place place;
  const std::string other = place.script(killed_after_greeting() + "echo yes > $0.waits; exec sleep 1000");
  const std::string run =
      test::program() + " run -q " + place.config + " -o " + place.out + " --baseline-binary " + other + " 2>/dev/null";
  // The first start is only asked for its greeting; wait for the second.
  const std::string wait = "while kill -0 $pid && { [ \"$(grep -c . " + other + ".pid)\" != 2 ] || [ ! -s " + other +
                           ".waits ]; }; do sleep 0.02; done 2>/dev/null";
  const int status = std::system((run + " & pid=$!; " + wait + "; kill -TERM $pid; wait $pid").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 75);
  EXPECT_TRUE(has_gone(other));
  EXPECT_TRUE(std::filesystem::exists(place.out + ".partial"));
}

TEST(Baseline, a_keyboard_interrupt_while_a_program_is_greeted_exits_130) {
  const Place place;
  const std::string other = place.script("echo $$ >> $0.pid; exec sleep 1000");
  const std::string run =
      test::program() + " run -q " + place.config + " -o " + place.out + " --baseline-binary " + other + " 2>/dev/null";
  const std::string wait = "while kill -0 $pid && [ ! -s " + other + ".pid ]; do sleep 0.02; done 2>/dev/null";
  const int status = std::system((run + " & pid=$!; " + wait + "; kill -INT $pid; wait $pid").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(has_gone(other));
}

TEST(Baseline, times_are_needed) {
  const Place place;
  EXPECT_EQ(place.run(test::program(), "--no-timing").code, 2);
}

}  // namespace
}  // namespace clusterbench::test
