// Which results `merge` takes for all the shards of one run.

#include "report/results/sweep.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

NamedPart shard_of_three(std::uint64_t index) {
  NamedPart part{"s" + std::to_string(index) + ".json", record_of(testing::result_by_hand(), {})};
  part.result.shard = {index, 3, std::string(64, 'a'), {}, {}, part.result.cases.size(), {}};
  return part;
}

std::vector<NamedPart> shards(std::initializer_list<std::uint64_t> indices) {
  std::vector<NamedPart> parts;
  for (const std::uint64_t index : indices) parts.push_back(shard_of_three(index));
  return parts;
}

std::string refusal_of(std::vector<NamedPart> parts) {
  try {
    order_shards(parts);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

// All three, the second of which belongs to another run in one respect.
template <class Change>
std::string refusal_of_other(const Change& change) {
  std::vector<NamedPart> parts = shards({1, 2, 3});
  parts[1].result.shard->sweep = std::string(64, 'b');
  change(parts[1].result);
  return refusal_of(std::move(parts));
}

TEST(Sweep, shards_are_brought_into_their_order) {
  std::vector<NamedPart> parts = shards({3, 1, 2});
  order_shards(parts);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(parts[i].result.shard->index, i + 1);
}

TEST(Sweep, a_missing_shard_is_named_with_the_files_that_are_there) {
  EXPECT_EQ(refusal_of(shards({1, 2})),
            "s1.json, s2.json: shard 3 of 3 is missing; wanted are the results of all shards");
  EXPECT_EQ(refusal_of(shards({2})), "s2.json: shards 1, 3 of 3 are missing; wanted are the results of all shards");
}

TEST(Sweep, a_shard_that_is_there_twice_is_named_with_both_files) {
  std::vector<NamedPart> parts = shards({1, 2, 3, 2});
  parts[3].file = "again.json";
  EXPECT_EQ(refusal_of(std::move(parts)), "again.json: /shard: is shard 2 of 3, and so is s2.json; take one of them");
}

TEST(Sweep, a_whole_result_is_no_shard) {
  std::vector<NamedPart> parts = shards({1, 2, 3});
  parts[2].result.shard.reset();
  EXPECT_EQ(refusal_of(parts), "s3.json: /shard: is missing: it is a whole result, and s1.json is shard 1 of 3");
  std::swap(parts[0], parts[2]);
  EXPECT_EQ(refusal_of(parts), "s3.json: /shard: is missing: it is a whole result, and s2.json is shard 2 of 3");
}

TEST(Sweep, shards_of_other_programs_configurations_filters_and_numbers_are_refused_where_they_differ) {
  EXPECT_EQ(refusal_of_other([](result::Result& other) {
              other.tool.version = "9.9";
            }).find("s2.json: /tool/version: is \"9.9\""),
            0u);
  EXPECT_EQ(refusal_of_other([](result::Result& other) {
              other.config["seed"] = 77;
            }).find("s2.json: /config/seed: is 77, and "),
            0u);
  EXPECT_EQ(refusal_of_other([](result::Result& other) { other.shard->filter = "aabb"; }),
            "s2.json: /shard/filter: is \"aabb\", and \"\" in s1.json: shards of different runs have no place in one "
            "result");
  EXPECT_EQ(refusal_of_other([](result::Result& other) { other.shard->count = 4; }),
            "s2.json: /shard: is shard 2 of 4, and s1.json is shard 1 of 3");
  EXPECT_EQ(refusal_of_other([](result::Result& other) { other.scenes.at(0).sha256 = "0"; })
                .find("s2.json: /scenes/0/sha256: is of another " + shards({1}).front().result.scenes.at(0).name +
                      " than that of s1.json: "),
            0u);
  EXPECT_EQ(refusal_of_other([](result::Result&) {}),
            "s2.json: /shard/sweep: is of another run than s1.json: scenes, their triangles, plug-ins, shaders, "
            "--count or cases differ");
}

TEST(Sweep, shards_that_were_changed_after_their_run_are_refused_though_their_sweep_is_one) {
  std::vector<NamedPart> parts = shards({1, 2, 3});
  parts[1].result.config["seed"] = 77;
  EXPECT_EQ(refusal_of(parts).find("s2.json: /config/seed: is 77, and "), 0u) << refusal_of(parts);
  parts = shards({1, 2, 3});
  parts[2].result.tool.git_sha = "another";
  EXPECT_EQ(refusal_of(parts).find("s3.json: /tool/git_sha: is \"another\""), 0u) << refusal_of(parts);
  parts = shards({1, 2, 3});
  parts[1].result.cases.pop_back();
  EXPECT_EQ(refusal_of(parts),
            "s2.json: /cases: has 1 case, and the shard was written with 2 cases: the file was changed");
}

TEST(Sweep, of_lists_of_two_lengths_the_first_item_that_one_lacks_is_named) {
  std::vector<NamedPart> parts = shards({1, 2, 3});
  parts[0].result.config["limits"]["fail_if"] = {"longest > 1"};
  parts[1].result.config["limits"]["fail_if"] = {"longest > 1", "pairs > 2"};
  EXPECT_EQ(refusal_of(parts).find("s2.json: /config/limits/fail_if/1: is \"pairs > 2\", and absent in s1.json"), 0u)
      << refusal_of(parts);
  std::swap(parts[0].result.config, parts[1].result.config);
  EXPECT_EQ(refusal_of(parts).find("s2.json: /config/limits/fail_if/1: is absent, and \"pairs > 2\" in s1.json"), 0u)
      << refusal_of(parts);
}

TEST(Sweep, shards_against_two_baselines_are_refused) {
  std::vector<NamedPart> parts = shards({1, 2, 3});
  for (NamedPart& part : parts) part.result.shard->baseline = {"base.json", std::string(64, 'c')};
  parts[2].result.shard->baseline->sha256 = std::string(64, 'd');
  EXPECT_EQ(refusal_of(parts).find("s3.json: /shard/baseline: is "), 0u) << refusal_of(parts);
}

TEST(Sweep, a_number_beyond_the_last_is_refused) {
  std::vector<NamedPart> parts = shards({1, 2, 3});
  parts[2].result.shard->index = 4;
  EXPECT_EQ(refusal_of(std::move(parts)), "s3.json: /shard: is shard 4 of 3, which is none of them");
}

TEST(Sweep, machines_may_choose_instruction_sets_and_threads_for_themselves) {
  std::vector<NamedPart> parts = shards({1, 2, 3});
  parts[1].result.tool.simd_target = "SCALAR";
  parts[1].result.config["threads"] = 7;
  EXPECT_EQ(refusal_of(std::move(parts)), "accepted");
}

}  // namespace
}  // namespace clusterbench::report
