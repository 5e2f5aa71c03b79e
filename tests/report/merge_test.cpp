#include "report/results/merge.h"

#include <gtest/gtest.h>

#include <set>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// The shard of the result by hand that has this case alone.
NamedPart shard(const std::string& file, const std::string& id) {
  result::Result result = record_of(testing::result_by_hand(), {});
  std::erase_if(result.cases, [&](const result::Case& result_case) { return result_case.id != id; });
  return {file, result};
}

Json whole_by_hand() {
  return result::to_json(record_of(testing::result_by_hand(), {}));
}

std::string refusal(const std::vector<NamedPart>& parts) {
  try {
    merged(parts);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Merge, shards_become_the_whole_result_again) {
  EXPECT_EQ(result::to_json(merged({shard("a", "slow"), shard("b", "fast")})), whole_by_hand());
}

TEST(Merge, what_a_part_failed_for_the_whole_failed_for) {
  NamedPart failed = shard("b", "fast");
  failed.result.failed = std::vector<std::string>{"hall: too many"};
  const result::Result all = merged({shard("a", "slow"), failed});
  EXPECT_EQ(all.failed, std::vector<std::string>{"hall: too many"});
  EXPECT_FALSE(all.conclusions->front().take);
}

TEST(Merge, different_configurations_are_all_kept_and_fit_the_schema) {
  NamedPart other = shard("b", "fast");
  other.result.config["seed"] = 2;
  other.result.name = "other";
  const Json all = result::to_json(merged({shard("a", "slow"), other}));
  EXPECT_EQ(config::schema_violations(config::result_schema(), all), std::vector<std::string>{});
  EXPECT_EQ(all["name"], "by hand + other");
  EXPECT_EQ(all["config"]["merged"][1]["seed"], 2);
  EXPECT_EQ(all["config"]["allocation"], other.result.config["allocation"]);
}

TEST(Merge, costs_of_other_models_are_refused_and_the_model_stays_with_the_front_that_it_drew) {
  NamedPart part = shard("a.json", "slow"), other = shard("b.json", "fast");
  for (NamedPart* one : {&part, &other}) {
    one->result.config["cost"] = {{"ns_per_light", 0.02}};
    one->result.config["rank_by"] = "frame_cost";
  }
  other.result.config["seed"] = 2;
  const Json all = result::to_json(merged({part, other}));
  EXPECT_EQ(all["config"]["cost"], part.result.config["cost"]);
  EXPECT_EQ(all["config"]["rank_by"], "frame_cost");
  other.result.config["cost"]["ns_per_light"] = 20;
  EXPECT_NE(refusal({part, other}).find("b.json: /config/cost: is not that of a.json"), std::string::npos);
  other.result.config = part.result.config;
  other.result.config["rank_by"] = "frame_time";
  EXPECT_NE(refusal({part, other}).find("b.json: /config/rank_by: is not that of a.json"), std::string::npos);
}

TEST(Merge, cold_times_after_sweeps_of_two_sizes_are_refused) {
  const auto part = [](const std::string& id, const char* caches, const Json& mib) {
    NamedPart out = shard(id + ".json", id);
    out.result.cases[0].timing->caches = caches;
    out.result.config["timing"]["sweep_mib"] = mib;
    return out;
  };
  EXPECT_EQ(refusal({part("slow", "cold", 64), part("fast", "cold", 64)}), "accepted");
  EXPECT_EQ(refusal({part("slow", "warm", 64), part("fast", "cold", 128)}), "accepted") << "one is swept";
  EXPECT_NE(refusal({part("slow", "cold", 64), part("fast", "cold", 128)})
                .find("fast.json: /config/timing/sweep_mib: is 128, and that of slow.json is 64"),
            std::string::npos);
  EXPECT_NE(refusal({part("slow", "cold", Json()), part("fast", "cold", 128)}).find("slow.json is null"),
            std::string::npos);
  NamedPart counted = shard("counted.json", "slow");
  counted.result.cases.clear();
  EXPECT_NE(refusal({counted, part("slow", "cold", 64), part("fast", "cold", 128)}).find("slow.json is 64"),
            std::string::npos)
      << "beside a part without times, too";
}

TEST(Merge, a_case_of_two_parts_is_a_conflict_that_names_both) {
  const std::string said = refusal({shard("a.json", "slow"), shard("b.json", "fast"), shard("c.json", "fast")});
  EXPECT_NE(said.find("c.json: /cases: has id 'fast' (hall/walk/frustum 64px/aabb/packed), and b.json has it, too; a "
                      "merged result has each case once: clusterbench report shows both"),
            std::string::npos)
      << said;
}

TEST(Merge, two_scenes_of_one_name_are_a_conflict) {
  NamedPart other = shard("b.json", "fast");
  other.result.scenes[0].sha256 = std::string(64, 'b');
  const std::string said = refusal({shard("a.json", "slow"), other});
  EXPECT_NE(said.find("b.json: /scenes: has name 'hall', and a.json has it, too, but it is another"), std::string::npos)
      << said;
}

TEST(Merge, shards_of_one_machine_are_merged_however_busy_it_was) {
  NamedPart part = shard("a.json", "slow"), other = shard("b.json", "fast");
  part.result.machine.load = {0.1, 0.2};
  other.result.machine.clock_mhz = {2000.0, {}};
  part.result.date = "2026-01-02T03:04:05Z";
  EXPECT_EQ(result::to_json(merged({part, other})), whole_by_hand());
}

TEST(Merge, times_of_two_programs_are_refused_and_counts_are_not) {
  NamedPart part = shard("a.json", "slow"), other = shard("b.json", "fast");
  other.result.tool.version = "another";
  const std::string said = refusal({part, other});
  EXPECT_NE(said.find("b.json: /tool: is not that of a.json"), std::string::npos) << said;
  part.result.cases[0].timing.reset();
  other.result.cases[0].timing.reset();
  EXPECT_EQ(refusal({part, other}), "accepted");
}

// Parts of two machines, whose second has another instruction set, too.
std::vector<NamedPart> of_two_machines() {
  NamedPart part = shard("a.json", "slow"), other = shard("b.json", "fast");
  other.result.machine.cpu = "another";
  other.result.tool.simd_target = "SCALAR";
  return {part, other};
}

TEST(Merge, times_of_two_machines_stay_with_their_machine) {
  const result::Result all = merged(of_two_machines());
  EXPECT_EQ(config::schema_violations(config::result_schema(), result::to_json(all)), std::vector<std::string>{});
  ASSERT_TRUE(all.machines);
  ASSERT_EQ(all.machines->size(), 2u);
  EXPECT_EQ((*all.machines)[1].name, "machine 2");
  EXPECT_EQ((*all.machines)[1].machine.cpu, "another");
  EXPECT_EQ((*all.machines)[1].simd_target, "SCALAR");
  for (const result::Case& one : all.cases) EXPECT_EQ(one.machine, one.id == "slow" ? "machine 1" : "machine 2");
}

TEST(Merge, no_star_and_no_conclusion_compares_two_machines) {
  const result::Result one = merged({shard("a.json", "slow"), shard("b.json", "fast")}),
                       two = merged(of_two_machines());
  ASSERT_EQ(one.conclusions->size(), 1u);
  EXPECT_EQ(one.pareto_front[0].ids, std::vector<std::string>{"fast"});
  ASSERT_EQ(two.conclusions->size(), 2u);
  EXPECT_EQ(two.pareto_front[0].ids, (std::vector<std::string>{"slow", "fast"}));
  for (const result::Conclusion& conclusion : *two.conclusions) {
    EXPECT_TRUE(conclusion.machine);
    EXPECT_FALSE(conclusion.against);
    EXPECT_TRUE(conclusion.alike.empty());
    EXPECT_NE(conclusion.text.find(", " + *conclusion.machine + ": "), std::string::npos) << conclusion.text;
  }
}

TEST(Merge, a_merged_result_of_two_machines_is_merged_on_with_those_of_a_third) {
  std::vector<NamedPart> parts = of_two_machines();
  const NamedPart both{"both.json", merged({parts[0], parts[1]})};
  NamedPart third = shard("c.json", "fast");
  third.result.cases[0].id = "third";
  third.result.cases[0].name = "hall/look/grid/third";
  third.result.machine.cores = 1234;
  const result::Result all = merged({third, both});
  ASSERT_EQ(all.machines->size(), 3u);
  EXPECT_EQ(all.machines->front().machine.cores, 1234u);
  std::set<std::string> names;
  for (const result::Case& one : all.cases) names.insert(one.machine.value_or("none"));
  EXPECT_EQ(names, (std::set<std::string>{"machine 1", "machine 2", "machine 3"}));
}

TEST(Merge, two_hosts_of_one_kind_are_two_machines) {
  const auto part = [](const std::string& file, const std::string& id, const std::string& host) {
    NamedPart out = shard(file, id);
    out.result.machine.host = host;
    return out;
  };
  const auto numbered = [](NamedPart out, std::uint64_t index) {
    out.result.shard = {index, 2, std::string(64, '0'), {}, {}, out.result.cases.size(), {}};
    return out;
  };
  const NamedPart slow = part("a", "slow", "aa"), near = part("b", "fast", "aa"), far = part("b", "fast", "bb");
  for (const auto& [first, second] : {std::pair(slow, far), std::pair(numbered(slow, 1), numbered(far, 2))}) {
    const result::Result all = merged({first, second});
    ASSERT_TRUE(all.machines);
    EXPECT_EQ((*all.machines)[1].host, "bb");
    EXPECT_FALSE(all.machine.host);
    ASSERT_EQ(all.conclusions->size(), 2u);
    for (const result::Conclusion& one : *all.conclusions)
      EXPECT_EQ(one.text.find("this machine"), std::string::npos) << one.text;
  }
  for (const auto& [first, second] : {std::pair(slow, near), std::pair(numbered(slow, 1), numbered(near, 2))}) {
    const result::Result all = merged({first, second});
    EXPECT_FALSE(all.machines);
    EXPECT_EQ(all.machine.host, "aa");
  }
}

TEST(Merge, hosts_that_earlier_builds_wrote_into_shards_count) {
  std::vector<NamedPart> parts{shard("a.json", "slow"), shard("b.json", "fast")};
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i].result.shard = {i + 1, 2, std::string(64, '0'), {}, i == 0 ? "aa" : "bb", parts[i].result.cases.size(),
                             {}};
  EXPECT_TRUE(merged(parts).machines);
}

TEST(Merge, a_merged_result_of_one_host_is_merged_on_with_others_of_it) {
  NamedPart slow = shard("a.json", "slow"), fast = shard("b.json", "fast"), third = shard("c.json", "fast");
  third.result.cases[0].id = "third";
  third.result.cases[0].name = "hall/look/grid/third";
  for (NamedPart* part : {&slow, &fast, &third}) part->result.machine.host = "aa";
  EXPECT_FALSE(merged({{"both.json", merged({slow, fast})}, third}).machines);
}

}  // namespace
}  // namespace clusterbench::report
