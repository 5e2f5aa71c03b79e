// `run --shard I/N` and `merge`: several machines measure what one would.

#include <gtest/gtest.h>

#include <algorithm>

#include "cli/small_config.h"
#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

// Two scenes, five grids, presets, and lights in half precision beside float32.
std::string sweep_config(const std::string& more = "") {
  return R"({"name": "sweep", "scenes": [{"path": ")" + source_file("scenes/street.glb") +
         R"(", "frames": 2}, {"path": ")" + source_file("scenes/mirror.glb") + R"(", "frames": 1}],
    "viewport": [320, 180], "precision": [{"packing": "float32"}, {"packing": "half"}],
    "grids": [{"kind": "frustum", "tiles": {"pixels": [[64, 64], [32, 32]]}, "slices": {"count": [8, 16], "far": 200}},
              {"kind": "world", "cells": [16, 4, 16]}],
    "assigners": ["aabb", "exact", "bvh", "world-grid"], "presets": ["godot"])" +
         more + "}";
}

class ShardedRun : public ::testing::Test {
 protected:
  std::string config(const std::string& more = "") { return folder_.write("sweep.json", sweep_config(more)).string(); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  Outcome run(const std::string& config, const std::string& flags, const std::string& name) const {
    return tool("run " + config + " --no-timing -q " + flags + " -o " + path(name));
  }

  // Their files, the last one first.
  std::string run_shards(const std::string& config, int count, const std::string& flags = "") const {
    std::string files;
    for (int i = 1; i <= count; ++i) {
      const std::string number = std::to_string(i) + "/" + std::to_string(count),
                        name = std::to_string(count) + "-" + std::to_string(i) + ".json";
      const Outcome done = run(config, flags + " --shard " + number, name);
      EXPECT_EQ(done.code, 0) << done.err;
      files.insert(0, " " + path(name));
    }
    return files;
  }

  Json read(const std::string& name) const { return Json::parse(file_text(folder_ / name)); }

  const Folder folder_;
};

TEST_F(ShardedRun, is_merged_to_the_bytes_of_the_whole_run_for_any_number_of_shards_in_any_order) {
  const std::string sweep = config();
  ASSERT_EQ(run(sweep, "", "whole.json").code, 0);
  for (const int count : {1, 2, 3, 7}) {
    const Outcome merged = tool("merge" + run_shards(sweep, count) + " -o " + path("merged.json"));
    ASSERT_EQ(merged.code, 0) << merged.err;
    EXPECT_EQ(file_text(folder_ / "merged.json"), file_text(folder_ / "whole.json")) << count;
  }
}

TEST_F(ShardedRun, has_each_case_once_and_says_which_part_it_is) {
  const std::string sweep = config();
  run_shards(sweep, 3);
  std::vector<std::string> ids;
  for (int i = 1; i <= 3; ++i) {
    const std::string name = "3-" + std::to_string(i) + ".json";
    EXPECT_EQ(tool("validate " + path(name)).code, 0);
    const Json shard = read(name);
    EXPECT_EQ(shard["shard"]["index"], i);
    EXPECT_EQ(shard["shard"]["count"], 3);
    EXPECT_FALSE(shard["machine"].contains("host"));  // nothing is timed
    EXPECT_FALSE(shard.contains("conclusions"));
    EXPECT_FALSE(shard["cases"].empty());
    for (const Json& one : shard["cases"]) ids.push_back(one["id"]);
  }
  std::ranges::sort(ids);
  EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
}

TEST_F(ShardedRun, may_have_more_shards_than_work) {
  const std::string sweep = folder_.write("small.json", small_config()).string();
  ASSERT_EQ(run(sweep, "", "whole.json").code, 0);
  const std::string files = run_shards(sweep, 4);
  const Json last = read("4-4.json");
  EXPECT_TRUE(last["cases"].empty());
  for (const char* command : {"validate ", "report -o /dev/null ", "export --format csv "})
    EXPECT_EQ(tool(command + path("4-4.json")).code, 0) << command;
  ASSERT_EQ(tool("merge" + files + " -o " + path("merged.json")).code, 0);
  EXPECT_EQ(file_text(folder_ / "merged.json"), file_text(folder_ / "whole.json"));
}

TEST_F(ShardedRun, is_sized_with_a_warning_that_other_shards_can_need_more) {
  const std::string sweep = folder_.write("small.json", small_config()).string();
  run_shards(sweep, 4);
  const std::string of_all = "other shards can need more: size the result that `clusterbench merge` makes of all\n";
  const Outcome one = tool("size " + path("4-1.json")), none = tool("size " + path("4-4.json"));
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(one.err, "clusterbench: warning: " + path("4-1.json") + " is shard 1 of 4 of a run; " + of_all);
  EXPECT_EQ(none.code, 1);
  EXPECT_EQ(none.err,
            "clusterbench: warning: " + path("4-4.json") + " is shard 4 of 4 of a run and has no cases; " + of_all);
}

TEST_F(ShardedRun, takes_the_cases_that_a_filter_selects) {
  const std::string sweep = config();
  ASSERT_EQ(run(sweep, "--filter /exact/", "whole.json").code, 0);
  ASSERT_EQ(tool("merge" + run_shards(sweep, 2, "--filter /exact/") + " -o " + path("merged.json")).code, 0);
  EXPECT_EQ(file_text(folder_ / "merged.json"), file_text(folder_ / "whole.json"));
}

TEST_F(ShardedRun, does_not_care_where_a_machine_keeps_its_scenes) {
  const Folder other;
  for (const Folder* place : {&folder_, &other}) {
    std::filesystem::copy_file(source_file("scenes/mirror.glb"), *place / "mirror.glb");
    const Outcome done =
        tool_in(place->path(),
                std::string("run mirror.glb --grid frustum --tiles 64,32 --assigner aabb --no-timing -q --shard ") +
                    (place == &folder_ ? "1/2" : "2/2") + " -o shard.json");
    ASSERT_EQ(done.code, 0) << done.err;
  }
  ASSERT_EQ(run(path("mirror.glb"), "--grid frustum --tiles 64,32 --assigner aabb", "whole.json").code, 0);
  const Outcome merged = tool("merge " + path("shard.json") + " " + (other / "shard.json").string());
  ASSERT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(Json::parse(merged.out)["cases"], read("whole.json")["cases"]);
}

TEST_F(ShardedRun, refuses_shards_of_another_scene_and_a_missing_one) {
  const std::string sweep = config();
  run_shards(sweep, 2);
  const Outcome alone = tool("merge " + path("2-2.json"));
  EXPECT_EQ(alone.code, 2);
  EXPECT_NE(alone.err.find("2-2.json: shard 1 of 2 is missing"), std::string::npos) << alone.err;
  ASSERT_EQ(run(source_file("scenes/mirror.glb"), "--grid frustum --assigner aabb --shard 1/2", "other.json").code, 0);
  const Outcome other = tool("merge " + path("2-2.json") + " " + path("other.json"));
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("other.json: /config/"), std::string::npos) << other.err;
}

TEST_F(ShardedRun, leaves_budgets_to_the_merge_which_fails_as_the_whole_run_does) {
  const std::string sweep = config(), budget = "--fail-if 'longest > 3' --fail-if 'pairs > 100'";
  const Outcome whole = run(sweep, budget, "whole.json");
  ASSERT_EQ(whole.code, 1);
  const Outcome merged = tool("merge" + run_shards(sweep, 3, budget) + " -o " + path("merged.json"));
  EXPECT_EQ(merged.code, 1) << merged.err;
  EXPECT_NE(merged.err.find("FAILED "), std::string::npos) << merged.err;
  EXPECT_EQ(file_text(folder_ / "merged.json"), file_text(folder_ / "whole.json"));
}

TEST_F(ShardedRun, holds_its_cases_against_a_baseline_at_the_merge) {
  const std::string sweep = config();
  ASSERT_EQ(run(sweep, "", "base.json").code, 0);
  const std::string against = "--baseline " + path("base.json") + " --fail-if 'longest > +5 %'";
  ASSERT_EQ(run(sweep, against, "whole.json").code, 0);
  const Outcome merged = tool("merge" + run_shards(sweep, 3, against) + " -o " + path("merged.json"));
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(file_text(folder_ / "merged.json"), file_text(folder_ / "whole.json"));
  EXPECT_EQ(run(sweep, "--fail-if 'longest > +5 %' --shard 1/2", "s.json").code, 2);  // told before it measures
}

// conf/sweep.json, r/ for the shards, and two baselines: of these cases, and of the same with short lists.
class ShardsAgainstBaseline : public ShardedRun {
 protected:
  ShardsAgainstBaseline() {
    for (const char* name : {"conf", "r"}) std::filesystem::create_directory(folder_ / name);
    set_limits("");
    EXPECT_EQ(in_folder("run conf/sweep.json --no-timing -q -o same.json").code, 0);
    Json low = read("same.json");
    for (Json& one : low["cases"]) one["occupancy"]["lights_per_cell"]["max"] = 1;
    folder_.write("low.json", low.dump());
  }

  void set_limits(const std::string& limits) const { folder_.write("conf/sweep.json", small_config(limits)); }
  Outcome in_folder(const std::string& arguments) const { return tool_in(folder_.path(), arguments); }
  void copy(const std::string& from, const std::string& to) const {
    std::filesystem::copy_file(folder_ / from, folder_ / to, std::filesystem::copy_options::overwrite_existing);
  }

  // whole.json, and r/1.json and r/2.json.
  void run_all(const std::string& flags) const {
    const std::string run = "run conf/sweep.json --no-timing -q " + flags;
    EXPECT_EQ(in_folder(run + " -o whole.json").code, 1);
    for (const char* shard : {"1", "2"})
      EXPECT_EQ(in_folder(run + " --shard " + shard + "/2 -o r/" + shard + ".json").code, 0) << shard;
  }

  void expect_as_whole(const Outcome& merged) const {
    EXPECT_EQ(merged.code, 1) << merged.err;
    EXPECT_EQ(file_text(folder_ / "merged.json"), file_text(folder_ / "whole.json"));
  }
};

TEST_F(ShardsAgainstBaseline, finds_that_of_the_flag_in_the_working_folder_and_not_beside_the_shards) {
  copy("low.json", "base.json");
  copy("same.json", "r/base.json");
  run_all("--baseline base.json --fail-if 'longest > +5 %'");
  for (const char* shards : {"r/1.json r/2.json", "r/2.json r/1.json"})
    expect_as_whole(in_folder(std::string("merge ") + shards + " -o merged.json"));
}

TEST_F(ShardsAgainstBaseline, finds_that_of_the_configuration_beside_the_configuration) {
  copy("low.json", "conf/base.json");
  copy("same.json", "base.json");
  set_limits(R"(, "limits": {"baseline": "base.json", "fail_if": ["longest > +5 %"]})");
  run_all("");
  expect_as_whole(in_folder("merge r/1.json r/2.json -o merged.json"));
}

TEST_F(ShardsAgainstBaseline, takes_the_same_file_from_elsewhere_and_no_other) {
  copy("low.json", "base.json");
  run_all("--baseline base.json --fail-if 'longest > +5 %'");
  std::filesystem::rename(folder_ / "base.json", folder_ / "moved.json");
  const Outcome gone = in_folder("merge r/1.json r/2.json -o merged.json");
  EXPECT_EQ(gone.code, 2);
  EXPECT_EQ(gone.err.find("clusterbench: base.json: --baseline: "), 0u) << gone.err;
  EXPECT_NE(gone.err.find("name that file with --baseline FILE"), std::string::npos) << gone.err;
  copy("same.json", "base.json");
  const Outcome other = in_folder("merge r/1.json r/2.json -o merged.json");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("base.json: --baseline: is another file: the shards were measured against base.json"),
            std::string::npos)
      << other.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "merged.json"));
  expect_as_whole(in_folder("merge r/1.json r/2.json --baseline moved.json -o merged.json"));
}

TEST_F(ShardsAgainstBaseline, is_named_only_for_shards_that_have_one) {
  for (const char* shard : {"1", "2"})
    ASSERT_EQ(
        in_folder(std::string("run conf/sweep.json --no-timing -q --shard ") + shard + "/2 -o r/" + shard + ".json")
            .code,
        0);
  const Outcome none = in_folder("merge r/1.json r/2.json --baseline low.json");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("names where the baseline of the shards lies, and r/1.json has none"), std::string::npos)
      << none.err;
  const Outcome whole = in_folder("merge same.json --baseline low.json");
  EXPECT_EQ(whole.code, 2);
  EXPECT_NE(whole.err.find("--baseline: goes with shards"), std::string::npos) << whole.err;
}

TEST_F(ShardsAgainstBaseline, refuses_a_whole_result_before_shards_and_names_both) {
  ASSERT_EQ(in_folder("run conf/sweep.json --no-timing -q --shard 2/2 -o r/2.json").code, 0);
  for (const char* files : {"same.json r/2.json", "r/2.json same.json"}) {
    const Outcome mixed = in_folder(std::string("merge ") + files);
    EXPECT_EQ(mixed.code, 2);
    EXPECT_NE(mixed.err.find("same.json: /shard: is missing: it is a whole result, and r/2.json is shard 2 of 2"),
              std::string::npos)
        << mixed.err;
  }
}

TEST_F(ShardedRun, is_merged_with_the_warnings_of_the_whole_run) {
  const std::string sweep =
      folder_.write("dropping.json", small_config(R"(, "storages": [{"name": "fixed", "cap": 1}])")).string();
  const Outcome whole = run(sweep, "", "whole.json");
  ASSERT_NE(whole.err.find("warning: "), std::string::npos) << whole.err;
  for (const char* shard : {"1", "2"}) run(sweep, std::string("--shard ") + shard + "/2", std::string(shard) + ".json");
  const Outcome merged = tool("merge " + path("1.json") + " " + path("2.json") + " -o " + path("merged.json"));
  EXPECT_EQ(merged.err, whole.err);
}

TEST_F(ShardedRun, without_cases_writes_no_dumps_and_says_so) {
  const std::string sweep = folder_.write("small.json", small_config()).string();
  const Outcome empty = tool("run " + sweep + " --write-dump " + path("dumps") + " --shard 4/4");
  EXPECT_EQ(empty.code, 0) << empty.err;
  EXPECT_NE(empty.err.find("no dump: shard 4 of 4 has no cases"), std::string::npos) << empty.err;
}

TEST_F(ShardedRun, fails_for_cases_of_its_own_that_lose_lights) {
  const std::string sweep =
      folder_.write("naive.json", small_config(R"(, "storages": [{"name": "fixed", "cap": 1}])")).string();
  EXPECT_EQ(run(sweep, "", "whole.json").code, 1);
  EXPECT_EQ(run(sweep, "--shard 1/2", "1.json").code, 1);
  EXPECT_EQ(run(sweep, "--shard 2/2", "2.json").code, 1);
  EXPECT_EQ(tool("merge " + path("1.json") + " " + path("2.json") + " -o " + path("merged.json")).code, 1);
  EXPECT_EQ(file_text(folder_ / "merged.json"), file_text(folder_ / "whole.json"));
}

TEST_F(ShardedRun, does_not_replace_the_result_of_another_shard) {
  const std::string sweep = config();
  ASSERT_EQ(run(sweep, "--shard 1/3", "one.json").code, 0);
  const std::string before = file_text(folder_ / "one.json");
  const Outcome refused = run(sweep, "--shard 2/3", "one.json");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("one.json: /shard: holds shard 1 of 3 of this run, which shard 2 of 3 would replace; give "
                             "each shard a file of its own"),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(file_text(folder_ / "one.json"), before);
  EXPECT_EQ(run(sweep, "--shard 1/2", "one.json").code, 2) << "the first of two is another than the first of three";
  EXPECT_EQ(file_text(folder_ / "one.json"), before);
  EXPECT_EQ(run(sweep, "--shard 1/3", "one.json").code, 0);
  EXPECT_EQ(file_text(folder_ / "one.json"), before);
}

TEST_F(ShardedRun, resumes_what_it_had_begun_and_no_other_shard) {
  const std::string sweep = config();
  ASSERT_EQ(run(sweep, "--shard 1/2", "s.json").code, 0);
  const std::string done = file_text(folder_ / "s.json");
  tool("run " + sweep + " --no-timing -q --shard 1/2 -o " + path("t.json") + " & pid=$!; while [ $(cat " +
       path("t.json.partial") +
       " 2>/dev/null | wc -l) -lt 3 ] && kill -0 $pid 2>/dev/null; do :; done; kill -9 $pid; wait $pid");
  if (std::filesystem::exists(folder_ / "t.json.partial")) {
    const Outcome other = run(sweep, "--shard 2/2 --resume", "t.json");
    EXPECT_EQ(other.code, 2);
    EXPECT_NE(other.err.find("is an interrupted run of another --shard; "), std::string::npos) << other.err;
    EXPECT_EQ(run(sweep, "--shard 1/2 --resume", "t.json").code, 0);
  }
  EXPECT_EQ(file_text(folder_ / "t.json"), done);
}

TEST_F(ShardedRun, says_also_when_quiet_that_budgets_wait_for_the_merge) {
  const Outcome done = run(config(), "--shard 1/2 --fail-if 'longest > 0'", "1.json");
  EXPECT_EQ(done.code, 0);
  EXPECT_NE(done.err.find("note: 1 budget (--fail-if) not decided in a shard; clusterbench merge decides"),
            std::string::npos)
      << done.err;
}

TEST_F(ShardedRun, tells_beforehand_what_each_shard_takes) {
  const std::string sweep = config();
  const Outcome dry = tool("run " + sweep + " --no-timing --dry-run --shard 2/3");
  ASSERT_EQ(dry.code, 0) << dry.err;
  for (const char* line :
       {"  shard 1 of 3: ", "* shard 2 of 3: ", "  shard 3 of 3: ", "  on 3 machines like this one: "})
    EXPECT_NE(dry.err.find(line), std::string::npos) << dry.err;
  ASSERT_EQ(run(sweep, "--shard 2/3", "2.json").code, 0);
  const Json cases = read("2.json")["cases"];
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(dry.out.substr(0, dry.out.find("skipped")), '\n')),
            cases.size());
  for (const Json& one : cases) EXPECT_NE(dry.out.find(one["id"]), std::string::npos);
  const Outcome many = tool("run " + sweep + " --no-timing --dry-run --shard 1/1000");
  EXPECT_NE(many.err.find("on: no case is left"), std::string::npos) << many.err;
}

TEST_F(ShardedRun, of_times_says_its_host_and_is_merged_on_one_machine_as_a_whole_run) {
  const std::string sweep = folder_.write("small.json", small_config()).string();
  std::string files;
  for (const char* shard : {"1", "2"}) {
    const std::string file = path(std::string(shard) + ".json");
    ASSERT_EQ(tool("run " + sweep + " -q --shard " + shard + "/2 -o " + file).code, 0);
    files += " " + file;
  }
  EXPECT_EQ(read("1.json")["machine"]["host"].get<std::string>().size(), 12u);
  ASSERT_EQ(tool("merge" + files + " -o " + path("merged.json")).code, 0);
  const Json merged = read("merged.json");
  EXPECT_FALSE(merged.contains("machines"));
  EXPECT_FALSE(merged.contains("shard"));
  EXPECT_EQ(merged["conclusions"].size(), 1u);
}

TEST_F(ShardedRun, does_not_go_with_a_program_beside_it) {
  const Outcome refused =
      tool("run " + source_file("scenes/mirror.glb") + " --shard 1/2 --baseline-binary " + program());
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--shard: does not go with --baseline-binary"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace clusterbench::test
