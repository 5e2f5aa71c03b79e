// A level that loses its lights, budgets against a baseline, budgets of some cases: as a job in CI runs them.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/lamps.h"
#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

std::string corridor(int lights, double towards = -1.0, bool is_endless = false) {
  return level_of(row_of(lights, towards), is_endless);
}

struct Level {
  Folder folder;
  std::string result = (folder / "result.json").string(), base = (folder / "base.json").string();

  Outcome run(const std::string& gltf, const std::string& flags, const std::string& output = "") const {
    const std::string level = folder.write("level.gltf", gltf).string();
    return tool("run " + level + " -q --no-timing --grid frustum --tiles 16x9t --assigner aabb,exact-fast -o " +
                (output.empty() ? result : output) + " " + flags);
  }
  void measure_base(int lights, const std::string& flags = "") const {
    const Outcome done = run(corridor(lights), flags, base);
    ASSERT_EQ(done.code, 0) << done.err;
  }
};

bool says(const Outcome& outcome, const std::string& part) {
  return outcome.err.find(part) != std::string::npos;
}

TEST(Gates, a_level_without_lights_fails_where_there_is_a_budget) {
  const Level level;
  EXPECT_EQ(level.run(corridor(0), "").code, 0) << "nobody asks for anything";
  const Outcome gated = level.run(corridor(0), "--fail-if 'longest > 64'");
  EXPECT_EQ(gated.code, 1);
  EXPECT_TRUE(says(gated, "FAILED level: has no point or spot lights, so budgets say nothing of it")) << gated.err;
  EXPECT_EQ(level.run(corridor(0), "--fail-if 'longest > 64' --allow-no-lights").code, 0);
  EXPECT_EQ(level.run(corridor(0), "--fail-if 'longest > 64' --set limits.allow_no_lights=true").code, 0);
  const Outcome behind = level.run(corridor(8, 4.0), "--fail-if 'longest > 64'");
  EXPECT_EQ(behind.code, 1);
  EXPECT_TRUE(says(behind, "none of 8 lights is ever in view")) << behind.err;
}

TEST(Gates, a_level_without_lights_and_without_an_end_fails_beside_others_and_alone) {
  const Level level;
  const std::string empty = level.folder.write("empty.gltf", corridor(0, -1.0, true)).string();
  const std::string budgets = " --fail-if 'lights < 1' --fail-if 'longest > 10'";
  const Outcome beside = level.run(corridor(8), empty + budgets);
  EXPECT_EQ(beside.code, 1);
  EXPECT_TRUE(says(beside, "FAILED empty: has no point or spot lights, so budgets say nothing of it")) << beside.err;
  const Outcome alone = level.run(corridor(0, -1.0, true), "--fail-if 'longest > 10'");
  EXPECT_EQ(alone.code, 1);
  EXPECT_TRUE(says(alone, "FAILED level: has no point or spot lights, so budgets say nothing of it")) << alone.err;
  EXPECT_EQ(level.run(corridor(0, -1.0, true), "--fail-if 'longest > 10' --allow-no-lights").code, 0);
  level.measure_base(8);
  const Outcome lost = level.run(corridor(0, -1.0, true), "--allow-changed-lights --baseline " + level.base);
  EXPECT_EQ(lost.code, 1);
  EXPECT_TRUE(says(lost, "FAILED level: has no point or spot lights")) << lost.err;
}

TEST(Gates, a_level_of_the_baseline_that_is_not_there_fails_unless_the_filter_leaves_it_out) {
  const Level level;
  const std::string attic = level.folder.write("attic.gltf", corridor(3)).string();
  level.measure_base(8, attic);
  EXPECT_EQ(level.run(corridor(8), attic + " --baseline " + level.base).code, 0);
  const Outcome missing = level.run(corridor(8), "--fail-if 'longest > 100' --baseline " + level.base);
  EXPECT_EQ(missing.code, 1);
  EXPECT_TRUE(says(missing, "FAILED attic: was measured in " + level.base + ", and this result has no case of it"))
      << missing.err;
  EXPECT_EQ(level.run(corridor(8), "--filter '^level/' --baseline " + level.base).code, 0);
}

TEST(Gates, presets_of_a_level_without_lights_are_measured_to_the_end) {
  const Folder folder;
  const std::string empty = folder.write("empty.gltf", corridor(0, -1.0, true)).string();
  const Outcome all =
      tool("run " + empty + " --presets -q --no-timing --viewport 320x180 -o " + (folder / "result.json").string());
  EXPECT_EQ(all.code, 0) << all.err;
}

TEST(Gates, an_empty_word_is_no_commit_and_no_baseline) {
  const Level level;
  level.measure_base(8);
  const std::string history = (level.folder / "history.jsonl").string();
  const Outcome commit = tool("history add " + level.base + " " + history + " --commit ''");
  EXPECT_EQ(commit.code, 2);
  EXPECT_TRUE(says(commit, "--commit: takes a text that is not empty")) << commit.err;
  EXPECT_FALSE(std::filesystem::exists(history));
  for (const char* option : {"--baseline ''", "--baseline=", "--fail-if ''", "-o ''", "--export ''", "--filter ''"})
    EXPECT_EQ(level.run(corridor(8), option).code, 2) << option;
}

// The result would be lost, or be in one stream with what was exported.
TEST(Gates, two_outputs_in_one_file_are_refused_however_it_is_named) {
  const Level level;
  const std::string scene = level.folder.write("level.gltf", corridor(8)).string();
  std::filesystem::create_symlink(level.folder / "new.json", level.folder / "link.json");
  const auto run = [&](const std::string& outputs) {
    return tool_in(level.folder.path(),
                   "run " + scene + " -q --no-timing --grid frustum --tiles 16x9t --assigner exact-fast " + outputs);
  };
  for (const char* outputs :
       {"-o new.json --export csv=./new.json", "-o ./new.json --export csv=new.json",
        "-o new.json --export csv=link.json", "-o new.json --export csv=../$(basename $PWD)/new.json",
        "-o new.json --export csv=new.json.partial", "-o - --export csv=-", "--export csv=-",
        "-o /dev/stdout --export csv=-", "-o new.json --export csv=- --export markdown=-"}) {
    const Outcome refused = run(outputs);
    EXPECT_EQ(refused.code, 2) << outputs;
    EXPECT_TRUE(says(refused, "is to hold two outputs of this command")) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(level.folder / "new.json")) << outputs;
  }
  EXPECT_EQ(run("-o /dev/null --export csv=/dev/null").code, 0);
  EXPECT_EQ(run("-o new.json --export csv=-").code, 0);
}

TEST(Gates, a_level_whose_lights_are_switched_off_fails) {
  const Level level;
  level.measure_base(8);
  const std::string off = level_of(row_of(8, -1.0, 8));
  const Outcome budget = level.run(off, "--fail-if 'lights < 8'");
  EXPECT_EQ(budget.code, 1);
  EXPECT_TRUE(says(budget, "FAILED level: of 8 lights all are dark (intensity 0, black, or range 0)")) << budget.err;
  const Outcome base = level.run(off, "--allow-no-lights --baseline " + level.base);
  EXPECT_EQ(base.code, 1);
  EXPECT_TRUE(says(base, "8 points then, 8 points, 8 of them dark now")) << base.err;
  EXPECT_EQ(level.run(off, "").code, 0);
}

// The lower bounds of docs/ci.md.
TEST(Gates, a_level_most_of_whose_lights_are_switched_off_fails_by_the_lit_ones) {
  const Level level;
  level.measure_base(30);
  const std::string gate = "--allow-changed-lights --baseline " + level.base + " --fail-if 'lights < -10 %' " +
                           "--fail-if 'lights_in_view < -10 %' --fail-if 'index_entries < -10 %'";
  const std::string off = level_of(row_of(30, -1.0, 28));
  EXPECT_EQ(level.run(off, gate).code, 0) << "lists and these figures hold dark lights, too";
  const Outcome lit = level.run(off, gate + " --fail-if 'lights_lit < -10 %' --fail-if 'lights_seen < -10 %'");
  EXPECT_EQ(lit.code, 1);
  EXPECT_TRUE(says(lit, "lights_lit is 2, -93.3 % against 30 in " + level.base + ", and fails with lights_lit < -10 %"))
      << lit.err;
  EXPECT_TRUE(says(lit, "lights_seen is 2, -93.3 % against 30 in " + level.base)) << lit.err;
}

TEST(Gates, dark_lights_in_view_and_lit_ones_behind_the_camera_fail_where_there_is_a_budget) {
  const Level level;
  std::vector<Lamp> lamps = row_of(30, -1.0, 30);
  for (const Lamp& behind : row_of(30, 3.0)) lamps.push_back(behind);
  const Outcome gated = level.run(level_of(lamps), "--fail-if 'longest > 64'");
  EXPECT_EQ(gated.code, 1);
  EXPECT_TRUE(says(gated,
                   "FAILED level, camera camera: none of 30 lit lights is ever in view (of 60 lights 30 are "
                   "dark: intensity 0, black, or range 0), so budgets say nothing of it"))
      << gated.err;
  EXPECT_EQ(level.run(level_of(lamps), "--fail-if 'longest > 64' --allow-no-lights").code, 0);
  lamps.back().z_m = -5.0;
  EXPECT_EQ(level.run(level_of(lamps), "--fail-if 'longest > 64'").code, 0) << "one of them is in view";
}

TEST(Gates, numbers_of_lights_are_budgets) {
  const Level level;
  EXPECT_EQ(level.run(corridor(8), "--fail-if 'lights < 8' --fail-if 'lights_in_view 6..10'").code, 0);
  const Outcome fewer = level.run(corridor(5), "--fail-if 'lights < 8' --fail-if 'lights_in_view 6..10'");
  EXPECT_EQ(fewer.code, 1);
  EXPECT_TRUE(says(fewer, "lights is 5, and fails with lights < 8")) << fewer.err;
  EXPECT_TRUE(says(fewer, "lights_in_view is 5 (frame 0), and fails with lights_in_view outside 6..10")) << fewer.err;
}

TEST(Gates, a_level_that_lost_its_lights_fails_against_its_baseline_unless_that_is_allowed) {
  const Level level;
  level.measure_base(8);
  EXPECT_EQ(level.run(corridor(8), "--baseline " + level.base).code, 0);
  const Outcome fewer = level.run(corridor(5), "--baseline " + level.base + " --fail-if 'index_entries > +5 %'");
  EXPECT_EQ(fewer.code, 1);
  EXPECT_TRUE(says(fewer, "its lights are not those of " + level.base + ": 8 points then, 5 points now")) << fewer.err;
  EXPECT_TRUE(says(fewer, "changed since " + level.base +
                              " (2 cases): the scene itself (sha256), its lights (8 points, now 5 points)"))
      << fewer.err;
  EXPECT_EQ(level.run(corridor(5), "--allow-changed-lights --baseline " + level.base).code, 0);
}

TEST(Gates, a_budget_in_percent_holds_across_a_change_of_the_level) {
  const Level level;
  level.measure_base(8);
  const std::string gate = "--allow-changed-lights --baseline " + level.base + " --fail-if ";
  const Outcome more = level.run(corridor(16), gate + "'exact-fast: index_entries > +5 %'");
  EXPECT_EQ(more.code, 1);
  EXPECT_TRUE(says(more, "/exact-fast/packed: index_entries is ")) << more.err;
  EXPECT_TRUE(says(more, " in " + level.base + ", and fails with exact-fast: index_entries > +5 %")) << more.err;
  EXPECT_FALSE(says(more, "FAILED level/camera/frustum 16x9 x 16 exponential-first first 5/aabb")) << more.err;
  EXPECT_EQ(level.run(corridor(16), gate + "'index_entries > +900 %'").code, 0);
}

TEST(Gates, a_run_with_a_baseline_says_what_has_changed_without_any_budget) {
  const Level level;
  level.measure_base(8);
  const std::string gate = "--allow-changed-lights --baseline " + level.base;
  const Outcome same = level.run(corridor(8), gate);
  EXPECT_EQ(same.code, 0);
  EXPECT_TRUE(says(same, "changes since " + level.base + ": none in 2 cases")) << same.err;
  const Outcome more = level.run(corridor(16), gate);
  EXPECT_EQ(more.code, 0);
  EXPECT_TRUE(says(
      more,
      "  level, camera camera: lights 8 -> 16 (+100 %), lights_lit 8 -> 16 (+100 %), "
      "lights_seen 8 -> 16 (+100 %), lights_seen.mean 8 -> 16 (+100 %), lights_in_view 8 -> 16 (+100 %; frame 0)\n"))
      << more.err;
  EXPECT_TRUE(says(more, "/exact-fast/packed: index_entries ")) << more.err;
  EXPECT_EQ(level.run(corridor(8), "").err, "") << "nothing to hold it against";
}

// The bound of docs/ci.md at which additions pass.
TEST(Gates, one_light_less_fails_where_that_is_asked_and_more_do_not) {
  const Level level;
  level.measure_base(8);
  const std::string gate = "--allow-changed-lights --baseline " + level.base + " --fail-if 'lights_lit < -0 %'";
  EXPECT_EQ(level.run(corridor(9), gate).code, 0);
  EXPECT_EQ(level.run(corridor(8), gate).code, 0);
  const Outcome fewer = level.run(level_of(row_of(8, -1.0, 1)), gate);
  EXPECT_EQ(fewer.code, 1);
  EXPECT_TRUE(says(fewer, "lights_lit is 7, -12.5 % against 8 in " + level.base + ", and fails with lights_lit < -0 %"))
      << fewer.err;
}

TEST(Gates, what_cannot_be_held_against_a_baseline_is_said_before_anything_is_measured) {
  const Level level;
  const Outcome none = level.run(corridor(8), "--fail-if 'longest > +5 %'");
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(says(none, "'longest > +5 %' is against a baseline, and there is none: add --baseline FILE")) << none.err;
  EXPECT_EQ(level.run(corridor(8), "--baseline " + (level.folder / "no.json").string()).code, 2);
  const Outcome times = level.run(corridor(8), "--fail-if 'frame_us > +5 %'");
  EXPECT_EQ(times.code, 2);
  EXPECT_TRUE(says(times, "--baseline-binary")) << times.err;
  EXPECT_FALSE(std::filesystem::exists(level.result));
}

TEST(Gates, what_failed_stands_in_the_markdown_once_for_all_cases_that_it_is_of) {
  const Folder folder;
  const std::string level = folder.write("level.gltf", level_of(row_of(8))).string(),
                    table = (folder / "result.md").string();
  const Outcome run = tool("run " + level +
                           " --no-timing -q --viewport 320x180 --grid frustum --tiles 64,128 --assigner "
                           "exact-fast,aabb-fast --fail-if 'lights_seen < 300' --export markdown=" +
                           table + " -o " + (folder / "result.json").string());
  EXPECT_EQ(run.code, 1);
  const std::string text = file_text(table);
  EXPECT_TRUE(text.starts_with("**FAILED**\n\n- level/")) << text;
  EXPECT_NE(text.find(" and 3 other cases: lights\\_seen is 8, and fails with lights\\_seen \\< 300\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("fails with"), text.rfind("fails with")) << text;
}

TEST(Gates, what_matches_nothing_fails) {
  const Level level;
  level.measure_base(8, "--filter aabb");
  const Outcome other = level.run(corridor(8), "--baseline " + level.base + " --fail-if 'longest > +5 %'");
  EXPECT_EQ(other.code, 1);
  EXPECT_TRUE(says(other, "could not be checked for 1 case that " + level.base + " does not have")) << other.err;
  EXPECT_EQ(level.run(corridor(8), "--filter aabb --baseline " + level.base + " --fail-if 'longest > +5 %'").code, 0);
  const Outcome named = level.run(corridor(8), "--fail-if 'exact-fst: longest > 99'");
  EXPECT_EQ(named.code, 1);
  EXPECT_TRUE(says(named, "its 'exact-fst' matches no case's name")) << named.err;
}

// Names have parentheses and other characters that mean something in a regular expression.
TEST(Gates, every_option_that_selects_cases_takes_a_name_as_it_is_printed) {
  const Folder folder;
  const std::string level = folder.write("level.gltf", corridor(8)).string(),
                    result = (folder / "result.json").string(), out = " -o " + (folder / "out").string();
  const std::string run =
      "run " + level + " -q --no-timing --viewport 320x180 --preset filament --preset godot -o " + result;
  ASSERT_EQ(tool(run).code, 0);
  std::string name;
  const Json measured = Json::parse(file_text(result));
  for (const Json& one : measured["cases"])
    if (one["preset"] == "filament") name = one["name"];
  ASSERT_NE(name.find('('), std::string::npos) << name;
  const auto quoted = [](const std::string& text) { return "'" + text + "'"; };
  const Outcome budget = tool(run + " --fail-if " + quoted(name + ": longest > 0"));
  EXPECT_EQ(budget.code, 1);
  EXPECT_TRUE(says(budget, "FAILED " + name + ": longest is ")) << budget.err;
  EXPECT_FALSE(says(budget, "godot")) << budget.err;
  const std::string filter = " --filter " + quoted(name);
  EXPECT_EQ(tool(run + filter).code, 0);
  EXPECT_EQ(Json::parse(file_text(result))["cases"].size(), 1u);
  EXPECT_EQ(tool("compare " + result + " " + result + filter).code, 0);
  EXPECT_EQ(tool("export " + result + " --format csv" + out + filter).code, 0);
  EXPECT_EQ(tool("size " + result + filter).code, 0);
  const Outcome other = tool("size " + result + " --filter 'columns=(farthest)'");
  EXPECT_EQ(other.code, 2);
  const Outcome none = tool("export " + result + " --format csv" + out + " --filter 'columns=(farthest)'");
  EXPECT_TRUE(says(none,
                   "'columns=(farthest)' matches none of 1 case, neither as it stands nor as a regular expression, "
                   "in which \\ makes ( ) plain characters; one of them is '"))
      << none.err;
}

TEST(Gates, a_history_tells_and_fails_with_lights_that_changed) {
  const Level level;
  const std::string history = (level.folder / "history.jsonl").string();
  level.measure_base(8);
  ASSERT_EQ(tool("history add " + level.base + " " + history + " --commit a").code, 0);
  ASSERT_EQ(level.run(corridor(5), "").code, 0);
  const std::string add = "history add " + level.result + " " + history + " --commit b";
  const Outcome changed = tool(add);
  EXPECT_EQ(changed.code, 1);
  EXPECT_TRUE(says(changed, "FAILED the lights of level have changed: 8 points, now 5 points")) << changed.err;
  const Outcome again = tool(add);
  EXPECT_TRUE(says(again, "nothing was added")) << again.err;
  EXPECT_TRUE(says(again, "now 5 points (--allow-changed-lights if that is meant)")) << again.err;
  EXPECT_FALSE(says(again, "it was added")) << again.err;
  EXPECT_EQ(tool(add + " --allow-changed-lights").code, 0);
  const Outcome shown = tool("history show " + history);
  EXPECT_TRUE(shown.out.starts_with("at b: the lights of level have changed: 8 points, now 5 points")) << shown.out;
  EXPECT_EQ(shown.out.find("better"), std::string::npos) << shown.out;
}

// As docs/ci.md says of a history that stays, and of a cache that is dropped with the job that failed.
TEST(Gates, changed_lights_fail_once_in_a_history_that_stays_and_each_time_in_one_that_is_dropped) {
  const Level level;
  const std::string history = (level.folder / "history.jsonl").string(), add = "history add " + level.result + " ";
  level.measure_base(8);
  ASSERT_EQ(tool("history add " + level.base + " " + history + " --commit a").code, 0);
  const std::string cached = file_text(history);
  ASSERT_EQ(level.run(corridor(5), "").code, 0);
  EXPECT_EQ(tool(add + history + " --commit b").code, 1);
  EXPECT_EQ(tool(add + history + " --commit c").code, 0);
  for (const char* commit : {"b", "c"}) {
    level.folder.write("history.jsonl", cached);
    EXPECT_EQ(tool(add + history + " --commit " + commit).code, 1) << commit;
  }
}

TEST(Gates, a_history_has_series_of_the_lights_that_shine) {
  const Level level;
  const std::string history = (level.folder / "history.jsonl").string(), add = "history add " + level.result + " ";
  ASSERT_EQ(level.run(corridor(8), "").code, 0);
  ASSERT_EQ(tool(add + history + " --commit a").code, 0);
  ASSERT_EQ(level.run(level_of(row_of(8, -1.0, 6)), "").code, 0);
  EXPECT_EQ(tool(add + history + " --commit b").code, 1);
  const Outcome shown = tool("history show " + history);
  EXPECT_NE(shown.out.find("lights_lit (lights)\n  2 values, 8 to 2\n  at b: 8 to 2, -75 %"), std::string::npos)
      << shown.out;
  EXPECT_NE(shown.out.find("lights_seen (lights)"), std::string::npos) << shown.out;
  EXPECT_EQ(shown.out.find("lights (lights)"), std::string::npos) << shown.out;
}

}  // namespace
}  // namespace clusterbench::test
