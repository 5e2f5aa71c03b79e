#include "measure/statistics/peaks_over_threshold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.h"

namespace clusterbench::measure {
namespace {

using Needs = std::vector<std::uint64_t>;

TailEstimate tail_of_one(const Needs& needs) {
  const PathNeeds path{needs, 1};
  return tail_of({&path, 1});
}

// What frames need on the whole: 1000 + a generalised Pareto excess.
struct KnownTail {
  double shape, scale;

  double above(std::uint64_t capacity) const {
    const double inside = 1.0 + shape * (static_cast<double>(capacity) - 1000.0) / scale;
    return inside <= 0.0 ? 0.0 : std::pow(inside, -1.0 / shape);
  }
  std::uint64_t need(double survival) const {
    return static_cast<std::uint64_t>(std::ceil(1000.0 + scale * std::expm1(-shape * std::log(survival)) / shape));
  }
  std::uint64_t capacity_of(double chance) const { return need(chance); }
};

// Moving maxima have the extremal index that is asked for, at every level; 1: independent frames.
Needs moving_maxima(const KnownTail& truth, double index, std::size_t frames, std::uint64_t seed) {
  SplitMix64 random(seed);
  const auto frechet = [&] { return 1.0 / -std::log1p(-random.unit()); };
  Needs needs;
  double x = frechet();
  for (std::size_t i = 0; i < frames; ++i) {
    x = std::max((1.0 - index) * x, index * frechet());
    needs.push_back(truth.need(-std::expm1(-1.0 / x)));
  }
  return needs;
}

// The share of experiments whose interval holds the true chance.
double share_of_intervals_held(const KnownTail& truth, double index, std::size_t frames, double chance,
                               int experiments) {
  int held = 0, estimated = 0;
  const std::uint64_t capacity = truth.capacity_of(chance);
  for (int i = 0; i < experiments; ++i) {
    const TailEstimate found = tail_of_one(moving_maxima(truth, index, frames, 100 + static_cast<std::uint64_t>(i)));
    if (!found.tail) continue;
    ++estimated;
    const Chance here = found.tail->chance_above(capacity);
    EXPECT_LE(here.ci95.low, here.estimate);
    EXPECT_GE(here.ci95.high, here.estimate);
    held += here.ci95.low <= truth.above(capacity) && truth.above(capacity) <= here.ci95.high ? 1 : 0;
  }
  EXPECT_GT(estimated, experiments * 3 / 4);
  return static_cast<double>(held) / estimated;
}

TEST(Tail, intervals_hold_the_known_chance_of_independent_frames) {
  for (const double chance : {0.01, 0.0005})
    EXPECT_GE(share_of_intervals_held({-0.3, 30.0}, 1.0, 400, chance, 25), 0.84) << chance;
}

TEST(Tail, intervals_hold_the_known_chance_of_frames_that_are_alike) {
  for (const double chance : {0.01, 0.0005})
    EXPECT_GE(share_of_intervals_held({-0.2, 30.0}, 0.2, 1500, chance, 25), 0.84) << chance;
}

// The same, less known: intervals are not so wide that they say nothing.
TEST(Tail, of_many_independent_frames_is_near_the_truth) {
  const KnownTail truth{-0.25, 100.0};
  const TailEstimate found = tail_of_one(moving_maxima(truth, 1.0, 5000, 4));
  ASSERT_TRUE(found.tail) << found.refusal;
  EXPECT_TRUE(found.tail->fits);
  EXPECT_NEAR(found.tail->shape, -0.25, 0.08);
  EXPECT_NEAR(found.tail->extremal_index, 1.0, 0.1);
  const std::uint64_t capacity = truth.capacity_of(1e-4);
  const Chance chance = found.tail->chance_above(capacity);
  EXPECT_GT(chance.estimate, 1e-5);
  EXPECT_LT(chance.ci95.high, 1.5e-3);
  EXPECT_EQ(found.tail->chance_above(100 * capacity).estimate, 0.0) << "beyond the end of the fit";
}

TEST(Tail, below_the_threshold_is_what_was_recorded) {
  const Needs needs = moving_maxima({-0.25, 100.0}, 0.5, 2000, 4);
  const TailEstimate found = tail_of_one(needs);
  ASSERT_TRUE(found.tail) << found.refusal;
  EXPECT_EQ(found.tail->frames, 2000u);
  for (const std::uint64_t capacity : {std::uint64_t{1000}, found.tail->threshold}) {
    const auto above = std::ranges::count_if(needs, [&](std::uint64_t need) { return need > capacity; });
    EXPECT_NEAR(found.tail->chance_above(capacity).estimate, static_cast<double>(above) / 2000.0, 5e-4);
  }
}

TEST(Tail, capacity_and_chance_are_inverse) {
  const TailEstimate found = tail_of_one(moving_maxima({-0.2, 40.0}, 0.4, 2000, 8));
  ASSERT_TRUE(found.tail) << found.refusal;
  for (const double chance : {0.3, 0.01, 1e-4}) {
    const Tail::Capacity capacity = found.tail->capacity_for(chance);
    EXPECT_LE(found.tail->chance_above(capacity.estimate).estimate, chance);
    EXPECT_GT(found.tail->chance_above(capacity.estimate - 1).estimate, chance);
    ASSERT_TRUE(capacity.upper);
    EXPECT_GE(*capacity.upper, capacity.estimate);
    EXPECT_LE(found.tail->chance_above(*capacity.upper).ci95.high, chance);
    EXPECT_GT(found.tail->chance_above(*capacity.upper - 1).ci95.high, chance);
  }
}

TEST(Tail, scales_with_the_unit_of_the_needs) {
  const Needs small = moving_maxima({-0.3, 20.0}, 0.5, 1500, 5);
  Needs large;
  for (const std::uint64_t need : small) large.push_back(7 + 64 * need);
  const TailEstimate one = tail_of_one(small), other = tail_of_one(large);
  ASSERT_TRUE(one.tail && other.tail) << one.refusal << other.refusal;
  EXPECT_EQ(other.tail->unit, 64u);
  EXPECT_EQ(other.tail->threshold, 7 + 64 * one.tail->threshold);
  for (const std::uint64_t capacity : {one.tail->threshold + 3, one.tail->highest + 2}) {
    EXPECT_EQ(other.tail->chance_above(7 + 64 * capacity).estimate, one.tail->chance_above(capacity).estimate);
    EXPECT_EQ(other.tail->chance_above(7 + 64 * capacity + 63).ci95.high, one.tail->chance_above(capacity).ci95.high);
  }
}

TEST(Tail, of_several_paths_is_that_of_all_and_the_same_in_any_order) {
  const Needs first = moving_maxima({-0.3, 20.0}, 0.5, 700, 5), second = moving_maxima({-0.3, 20.0}, 0.5, 900, 6);
  const std::array<PathNeeds, 2> forth{PathNeeds{first, 1}, PathNeeds{second, 1}},
      back{PathNeeds{second, 1}, PathNeeds{first, 1}};
  const TailEstimate one = tail_of(forth), other = tail_of(back);
  ASSERT_TRUE(one.tail && other.tail) << one.refusal << other.refusal;
  EXPECT_EQ(one.tail->frames, 1600u);
  EXPECT_EQ(one.tail->chance_above(1060).ci95.high, other.tail->chance_above(1060).ci95.high);
}

TEST(Tail, of_entries_of_several_frames_says_so_and_is_an_upper_bound) {
  const Needs needs = moving_maxima({-0.3, 20.0}, 0.3, 4000, 5);
  Needs merged;
  for (std::size_t i = 0; i < needs.size(); i += 4)
    merged.push_back(*std::max_element(needs.begin() + static_cast<std::ptrdiff_t>(i),
                                       needs.begin() + static_cast<std::ptrdiff_t>(i) + 4));
  const PathNeeds path{merged, 4};
  const TailEstimate all = tail_of_one(needs), some = tail_of({&path, 1});
  ASSERT_TRUE(all.tail && some.tail) << all.refusal << some.refusal;
  EXPECT_TRUE(some.tail->has_merged_frames && !all.tail->has_merged_frames);
  EXPECT_EQ(some.tail->frames, 4000u);
  EXPECT_GE(some.tail->chance_above(1040).ci95.high, all.tail->chance_above(1040).estimate);
}

TEST(Tail, is_refused_for_too_few_peaks_and_says_how_many_there_are) {
  Needs needs(600, 10);
  for (std::size_t i = 0; i < 600; ++i) needs[i] += i % 60 < 20 ? 5 + i % 60 + i / 60 : i % 3;  // ten hills
  const TailEstimate found = tail_of_one(needs);
  EXPECT_FALSE(found.tail);
  EXPECT_NE(found.refusal.find("of the 20 independent peaks it needs"), std::string::npos) << found.refusal;
}

// Frames in the hundreds are no substitute for hills.
TEST(Tail, is_refused_for_one_smooth_hill) {
  Needs needs;
  for (std::uint64_t i = 0; i < 1000; ++i) needs.push_back(1000 + (i < 500 ? i : 999 - i) * 3 + i % 7);
  const TailEstimate found = tail_of_one(needs);
  EXPECT_FALSE(found.tail);
  EXPECT_EQ(found.refusal.find("1 of the 20 independent peaks it needs"), 0u) << found.refusal;
}

TEST(Tail, is_refused_for_a_loop_that_is_walked_again_and_again) {
  const Needs once = moving_maxima({-0.3, 300.0}, 0.4, 100, 9);
  Needs often;
  for (int i = 0; i < 20; ++i) often.insert(often.end(), once.begin(), once.end());
  const TailEstimate found = tail_of_one(often);
  EXPECT_FALSE(found.tail);
  EXPECT_NE(found.refusal.find("the paths repeat themselves"), std::string::npos) << found.refusal;
}

TEST(Tail, is_refused_without_frames_and_for_constant_needs) {
  EXPECT_EQ(tail_of({}).refusal, "no frames were recorded");
  EXPECT_EQ(tail_of_one({}).refusal, "no frames were recorded");
  EXPECT_EQ(tail_of_one({7}).refusal, "every frame needs 7");
  EXPECT_EQ(tail_of_one(Needs(1000, 0)).refusal, "every frame needs 0");
}

TEST(Tail, is_refused_where_frames_have_one_of_two_needs) {
  SplitMix64 random(2);
  Needs needs;
  for (int i = 0; i < 500; ++i) needs.push_back(random.unit() < 0.2 ? 2000 : 1000);
  const TailEstimate found = tail_of_one(needs);
  EXPECT_FALSE(found.tail);
  EXPECT_NE(found.refusal.find("have only 1 different height"), std::string::npos) << found.refusal;
}

TEST(Tail, stops_at_huge_needs_no_more_than_at_small_ones) {
  Needs needs;
  SplitMix64 random(2);
  for (int i = 0; i < 500; ++i) needs.push_back((std::uint64_t{1} << 62) + (random.next() >> 4));
  const TailEstimate found = tail_of_one(needs);
  if (found.tail) {
    EXPECT_GE(found.tail->chance_above(needs[0]).ci95.high, 0.0);
    (void)found.tail->capacity_for(1e-9);
  }
}

// The height of a wheel's rim: more often near the top than anywhere below, which no shape from -1 on has.
TEST(Tail, says_when_it_does_not_fit) {
  SplitMix64 random(12);
  Needs needs;
  for (int i = 0; i < 1500; ++i)
    needs.push_back(static_cast<std::uint64_t>(1e5 * (2.0 - std::cos(2.0 * M_PI * random.unit()))));
  const TailEstimate found = tail_of_one(needs);
  ASSERT_TRUE(found.tail) << found.refusal;
  EXPECT_FALSE(found.tail->fits) << found.tail->fit_p << " above " << found.tail->threshold;
}

// Rooms, each with twice the lights of the one before, and less than a third of its frames: a tail without end, but all
// of it on a few steps.
TEST(Tail, says_when_frames_come_in_steps_that_no_curve_has) {
  SplitMix64 random(7);
  Needs needs;
  for (int i = 0; i < 3000; ++i) {
    double lights = 1000.0;
    while (random.unit() < 0.3) lights *= 2.0;
    needs.push_back(static_cast<std::uint64_t>(lights * (1.0 + 0.1 * random.unit())));
  }
  const TailEstimate found = tail_of_one(needs);
  ASSERT_TRUE(found.tail) << found.refusal;
  EXPECT_FALSE(found.tail->fits) << found.tail->fit_p << " above " << found.tail->threshold;
}

}  // namespace
}  // namespace clusterbench::measure
