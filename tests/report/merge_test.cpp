#include "report/merge.h"

#include <gtest/gtest.h>

#include "config/schema_text.h"
#include "config/schema_verdict.h"
#include "core/error.h"
#include "report/result_by_hand.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// The shard of the result by hand that has this case alone.
NamedPart shard(const std::string& file, const std::string& id) {
  Json result = result_to_json(testing::result_by_hand(), {});
  Json kept = Json::array();
  for (const Json& entry : result["cases"])
    if (entry["id"] == id) kept.push_back(entry);
  result["cases"] = kept;
  return {file, result};
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
  EXPECT_EQ(merged({shard("a", "slow"), shard("b", "fast")}), result_to_json(testing::result_by_hand(), {}));
}

TEST(Merge, what_a_part_failed_for_the_whole_failed_for) {
  NamedPart failed = shard("b", "fast");
  failed.result["failed"] = {"hall: too many"};
  const Json all = merged({shard("a", "slow"), failed});
  EXPECT_EQ(all["failed"], Json({"hall: too many"}));
  EXPECT_TRUE(all["conclusions"][0]["take"].is_null());
}

TEST(Merge, different_configurations_are_all_kept_and_fit_the_schema) {
  NamedPart other = shard("b", "fast");
  other.result["config"]["seed"] = 2;
  other.result["name"] = "other";
  const Json all = merged({shard("a", "slow"), other});
  EXPECT_EQ(config::schema_violations(config::result_schema(), all), std::vector<std::string>{});
  EXPECT_EQ(all["name"], "by hand + other");
  EXPECT_EQ(all["config"]["merged"][1]["seed"], 2);
  EXPECT_EQ(all["config"]["allocation"], other.result["config"]["allocation"]);
}

TEST(Merge, costs_of_other_models_are_refused_and_the_model_stays_with_the_front_that_it_drew) {
  NamedPart part = shard("a.json", "slow"), other = shard("b.json", "fast");
  for (NamedPart* one : {&part, &other}) {
    one->result["config"]["cost"] = {{"ns_per_light", 0.02}};
    one->result["config"]["rank_by"] = "frame_cost";
  }
  other.result["config"]["seed"] = 2;
  const Json all = merged({part, other});
  EXPECT_EQ(all["config"]["cost"], part.result["config"]["cost"]);
  EXPECT_EQ(all["config"]["rank_by"], "frame_cost");
  other.result["config"]["cost"]["ns_per_light"] = 20;
  EXPECT_NE(refusal({part, other}).find("b.json: /config/cost: is not that of a.json"), std::string::npos);
  other.result["config"] = part.result["config"];
  other.result["config"]["rank_by"] = "frame_time";
  EXPECT_NE(refusal({part, other}).find("b.json: /config/rank_by: is not that of a.json"), std::string::npos);
}

TEST(Merge, a_case_of_two_parts_is_a_conflict_that_names_both) {
  const std::string said = refusal({shard("a.json", "slow"), shard("b.json", "fast"), shard("c.json", "fast")});
  EXPECT_NE(said.find("c.json: /cases: has id 'fast', and b.json has it, too"), std::string::npos) << said;
}

TEST(Merge, two_scenes_of_one_name_are_a_conflict) {
  NamedPart other = shard("b.json", "fast");
  other.result["scenes"][0]["sha256"] = std::string(64, 'b');
  const std::string said = refusal({shard("a.json", "slow"), other});
  EXPECT_NE(said.find("b.json: /scenes: has name 'hall', and a.json has it, too, but it is another"), std::string::npos)
      << said;
}

TEST(Merge, shards_of_one_machine_are_merged_however_busy_it_was) {
  NamedPart part = shard("a.json", "slow"), other = shard("b.json", "fast");
  part.result["machine"]["load"] = {{"begin", 0.1}, {"end", 0.2}};
  other.result["machine"]["clock_mhz"] = {{"now", 2000}};
  part.result["date"] = "2026-01-02T03:04:05Z";
  EXPECT_EQ(merged({part, other}), result_to_json(testing::result_by_hand(), {}));
}

TEST(Merge, times_of_two_machines_are_refused_and_counts_are_not) {
  NamedPart part = shard("a.json", "slow"), other = shard("b.json", "fast");
  other.result["machine"]["cpu"] = "another";
  const std::string said = refusal({part, other});
  EXPECT_NE(said.find("b.json: /machine: is not that of a.json"), std::string::npos) << said;
  part.result["cases"][0].erase("timing");
  other.result["cases"][0].erase("timing");
  EXPECT_EQ(refusal({part, other}), "accepted");
}

}  // namespace
}  // namespace clusterbench::report
