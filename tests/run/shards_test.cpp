// How a run is divided among machines.

#include "run/shards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "places.h"

namespace clusterbench::run {
namespace {

using Work = std::vector<std::uint64_t>;

std::vector<std::uint64_t> sums_of(const Work& work, const std::vector<std::size_t>& ends) {
  std::vector<std::uint64_t> sums;
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    sums.push_back(std::accumulate(work.begin() + static_cast<std::ptrdiff_t>(begin),
                                   work.begin() + static_cast<std::ptrdiff_t>(end), std::uint64_t{0}));
    begin = end;
  }
  return sums;
}

// By trying all divisions.
std::uint64_t least_largest(const Work& work, std::size_t begin, std::uint64_t shards) {
  std::uint64_t sum = 0, best = ~std::uint64_t{0};
  if (shards == 1)
    return std::accumulate(work.begin() + static_cast<std::ptrdiff_t>(begin), work.end(), std::uint64_t{0});
  for (std::size_t end = begin; end <= work.size(); ++end) {
    best = std::min(best, std::max(sum, least_largest(work, end, shards - 1)));
    if (end < work.size()) sum += work[end];
  }
  return best;
}

TEST(ShardEnds, take_each_group_once_and_make_the_largest_shard_as_small_as_can_be) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    Work work(1 + random() % 9);
    for (std::uint64_t& one : work) one = 1 + random() % (random() % 4 == 0 ? 1000 : 10);
    const std::uint64_t shards = 1 + random() % 6;
    const std::vector<std::size_t> ends = shard_ends(work, shards);
    ASSERT_EQ(ends.size(), shards);
    ASSERT_TRUE(std::ranges::is_sorted(ends));
    ASSERT_EQ(ends.back(), work.size());
    const std::vector<std::uint64_t> sums = sums_of(work, ends);
    ASSERT_EQ(*std::ranges::max_element(sums), least_largest(work, 0, shards));
  }
}

TEST(ShardEnds, leave_no_shard_without_a_group_if_there_are_enough) {
  EXPECT_EQ(shard_ends(Work{100, 1, 1, 1}, 4), (std::vector<std::size_t>{1, 2, 3, 4}));
  EXPECT_EQ(shard_ends(Work{1, 1, 1, 100}, 3), (std::vector<std::size_t>{2, 3, 4}));
}

TEST(ShardEnds, leave_the_last_shards_empty_if_there_are_more_than_groups) {
  EXPECT_EQ(shard_ends(Work{5, 5}, 4), (std::vector<std::size_t>{1, 2, 2, 2}));
  EXPECT_EQ(shard_ends(Work{}, 2), (std::vector<std::size_t>{0, 0}));
}

config::Config street_config() {
  return config::parse_config(
      R"({"scenes": [{"path": ")" + test::source_dir() + R"(/scenes/street.glb", "frames": 2}, {"path": ")" +
          test::source_dir() +
          R"(/scenes/mirror.glb", "frames": 2}], "viewport": [320, 180], "timing": {"measure": false},
           "grids": [{"tiles": {"pixels": [[16, 16], [128, 128]]}, "slices": {"count": [8, 32], "far": 100}}],
           "assigners": ["aabb", "exact"]})",
      "c.json");
}

std::vector<std::string> ids_of(const Plan& plan) {
  std::vector<std::string> ids;
  for (const GroupPlan& group : plan.groups)
    for (const CasePlan& one : group.cases) ids.push_back(one.id);
  return ids;
}

TEST(Shards, together_are_the_plan_in_its_order) {
  const config::Config config = street_config();
  const Plan whole = make_plan(config, "");
  for (const std::uint64_t shards : {1, 2, 3, 7, 50}) {
    const std::vector<std::size_t> ends = shard_ends(predicted_work(config, whole), shards);
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < shards; ++i) {
      const Plan part = part_of(make_plan(config, ""), i == 0 ? 0 : ends[i - 1], ends[i]);
      EXPECT_EQ(part.scenes.size(), whole.scenes.size());
      EXPECT_EQ(part.skipped.size(), whole.skipped.size());
      for (const std::string& id : ids_of(part)) ids.push_back(id);
    }
    EXPECT_EQ(ids, ids_of(whole)) << shards;
  }
}

TEST(PredictedWork, is_the_same_each_time_and_grows_with_cells_and_methods) {
  config::Config config = street_config();
  const Plan plan = make_plan(config, "");
  const Work work = predicted_work(config, plan);
  EXPECT_EQ(work, predicted_work(config, make_plan(config, "")));
  ASSERT_EQ(work.size(), 8u);
  EXPECT_GT(work[1], work[0]);  // four times the slices
  EXPECT_GT(work[0], work[2]);  // tiles of a sixty-fourth of the area
  const Work of_one = predicted_work(config, make_plan(config, "/aabb/"));
  for (std::size_t i = 0; i < work.size(); ++i) EXPECT_GT(work[i], of_one[i]);
}

TEST(PredictedWork, counts_the_rounds_that_are_timed) {
  config::Config config = street_config();
  const Plan plan = make_plan(config, "");
  const Work counted = predicted_work(config, plan);
  config.timing.measure = true;
  const Work timed = predicted_work(config, plan);
  config.timing.rounds *= 2;
  const Work twice = predicted_work(config, plan);
  for (std::size_t i = 0; i < counted.size(); ++i) EXPECT_EQ(twice[i] - timed[i], timed[i] - counted[i]);
}

}  // namespace
}  // namespace clusterbench::run
