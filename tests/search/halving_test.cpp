#include "search/halving.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace clusterbench::search {
namespace {

// Candidate c costs c + 1 in the mean over all frames, and a little else on each.
double cost(std::size_t candidate, std::size_t frame) {
  return static_cast<double>(candidate) + 1.0 + 0.3 * std::sin(7.0 * static_cast<double>(frame * candidate));
}

struct Counted {
  std::size_t evaluations = 0, calls = 0;
};

Score mean_cost(Counted& counted) {
  return [&counted](std::span<const std::size_t> candidates, std::size_t frames) {
    ++counted.calls;
    counted.evaluations += candidates.size() * frames;
    std::vector<Standing> standings;
    for (const std::size_t candidate : candidates) {
      double sum = 0.0;
      for (std::size_t frame = 0; frame < frames; ++frame) sum += cost(candidate, frame);
      standings.push_back({false, {sum / static_cast<double>(frames)}});
    }
    return standings;
  };
}

TEST(Halving, finds_the_best_candidate_and_counts_its_evaluations) {
  Counted counted;
  const Halving found = halve({.candidates = 512, .frames = 64, .keep_one_in = 8, .least = 4}, mean_cost(counted));
  ASSERT_FALSE(found.finalists.empty());
  EXPECT_EQ(found.finalists.front(), 0u);
  // 512 on 1 frame, 64 on 4, 8 on 16: each rung has an eighth of the candidates and four times the frames.
  EXPECT_EQ(counted.evaluations, 512u * 1 + 64u * 4 + 8u * 16);
  ASSERT_EQ(found.rungs.size(), 3u);
  EXPECT_EQ(found.rungs[1].candidates, 64u);
  EXPECT_EQ(found.rungs[2].frames, 16u);
  EXPECT_EQ(found.finalists.size(), 4u);
}

TEST(Halving, what_is_out_comes_never_again_however_good_it_is) {
  std::set<std::size_t> seen_later;
  const Halving found =
      halve({.candidates = 200, .frames = 100}, [&](std::span<const std::size_t> candidates, std::size_t frames) {
        std::vector<Standing> standings;
        for (const std::size_t candidate : candidates) {
          if (frames > 1) seen_later.insert(candidate);
          standings.push_back({candidate % 2 == 0, {static_cast<double>(candidate)}});
        }
        return standings;
      });
  EXPECT_EQ(found.finalists.front(), 1u);
  EXPECT_EQ(found.rungs.front().out, 100u);
  EXPECT_TRUE(std::ranges::none_of(seen_later, [](std::size_t candidate) { return candidate % 2 == 0; }));
}

TEST(Halving, has_no_finalist_where_all_are_out) {
  const Halving found =
      halve({.candidates = 9, .frames = 10}, [](std::span<const std::size_t> candidates, std::size_t) {
        return std::vector<Standing>(candidates.size(), Standing{true, {}});
      });
  EXPECT_TRUE(found.finalists.empty());
  ASSERT_EQ(found.rungs.size(), 1u);
  EXPECT_EQ(found.rungs[0].out, 9u);
}

TEST(Halving, takes_the_first_of_equals_and_the_second_number_of_ranks_before_it) {
  const auto all_equal = [](std::span<const std::size_t> candidates, std::size_t) {
    return std::vector<Standing>(candidates.size(), Standing{false, {1.0}});
  };
  EXPECT_EQ(halve({.candidates = 100, .frames = 8, .least = 5}, all_equal).finalists,
            (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  const auto last_is_smallest = [](std::span<const std::size_t> candidates, std::size_t) {
    std::vector<Standing> standings;
    for (const std::size_t candidate : candidates) standings.push_back({false, {1.0, -static_cast<double>(candidate)}});
    return standings;
  };
  EXPECT_EQ(halve({.candidates = 100, .frames = 8}, last_is_smallest).finalists.front(), 99u);
}

TEST(Halving, keeps_a_share_of_the_candidates_of_a_single_frame) {
  Counted counted;
  const Halving found = halve({.candidates = 64, .frames = 1, .keep_one_in = 8}, mean_cost(counted));
  EXPECT_EQ(counted.evaluations, 64u);
  EXPECT_EQ(found.finalists.size(), 8u);
}

TEST(Halving, candidates_that_are_apart_take_no_room_from_the_others) {
  HalvingRequest request{.candidates = 100, .frames = 64, .keep_one_in = 8, .least = 4, .apart = {}, .apart_kept = 2};
  Counted counted;
  const std::vector<std::size_t> together = halve(request, mean_cost(counted)).finalists;
  // 50 more, which are all better.
  request.candidates = 150;
  request.apart.assign(150, false);
  std::fill(request.apart.begin() + 100, request.apart.end(), true);
  const Score with_better = [&](std::span<const std::size_t> candidates, std::size_t frames) {
    std::vector<Standing> standings = mean_cost(counted)(candidates, frames);
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (candidates[i] >= 100) standings[i].rank[0] -= 1000.0;
    return standings;
  };
  const Halving found = halve(request, with_better);
  ASSERT_EQ(found.finalists.size(), together.size() + 2);
  EXPECT_TRUE(std::equal(together.begin(), together.end(), found.finalists.begin()));
  EXPECT_EQ(found.finalists[together.size()], 100u);
}

TEST(Halving, needs_no_candidates) {
  Counted counted;
  EXPECT_TRUE(halve({.candidates = 0, .frames = 4}, mean_cost(counted)).rungs.empty());
  EXPECT_EQ(counted.calls, 0u);
}

TEST(SpreadOrder, has_every_number_once_and_its_beginnings_spread) {
  for (const std::size_t count : {1u, 2u, 3u, 7u, 8u, 60u}) {
    const std::vector<std::size_t> order = spread_order(count, count / 3);
    EXPECT_EQ(order.front(), count / 3);
    EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), count);
    EXPECT_EQ(order.size(), count);
  }
  const std::vector<std::size_t> order = spread_order(64, 5);
  std::vector<std::size_t> some(order.begin() + 1, order.begin() + 9);
  std::ranges::sort(some);
  EXPECT_EQ(some, (std::vector<std::size_t>{0, 8, 16, 24, 32, 40, 48, 56}));
}

}  // namespace
}  // namespace clusterbench::search
