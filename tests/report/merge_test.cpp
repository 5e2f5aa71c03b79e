#include "report/results/merge.h"

#include <gtest/gtest.h>

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

TEST(Merge, a_case_of_two_parts_is_a_conflict_that_names_both) {
  const std::string said = refusal({shard("a.json", "slow"), shard("b.json", "fast"), shard("c.json", "fast")});
  EXPECT_NE(said.find("c.json: /cases: has id 'fast', and b.json has it, too"), std::string::npos) << said;
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

TEST(Merge, times_of_two_machines_are_refused_and_counts_are_not) {
  NamedPart part = shard("a.json", "slow"), other = shard("b.json", "fast");
  other.result.machine.cpu = "another";
  const std::string said = refusal({part, other});
  EXPECT_NE(said.find("b.json: /machine: is not that of a.json"), std::string::npos) << said;
  part.result.cases[0].timing.reset();
  other.result.cases[0].timing.reset();
  EXPECT_EQ(refusal({part, other}), "accepted");
}

}  // namespace
}  // namespace clusterbench::report
