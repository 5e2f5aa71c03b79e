#include "measure/lists/stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure {
namespace {

// Lists of four cells from the lights of each.
assign::Lists cells(const std::vector<std::vector<std::uint32_t>>& lights) {
  assign::Lists lists{{0}, {}};
  for (const auto& cell : lights) {
    lists.lights.insert(lists.lights.end(), cell.begin(), cell.end());
    lists.begin.push_back(lists.pair_count());
  }
  return lists;
}

Churn churn_of(int window, const std::vector<assign::Lists>& steps) {
  ChurnMeter meter(window);
  for (const assign::Lists& lists : steps) meter.add(lists);
  return meter.result();
}

// Two cells; light 7 is in the second one where the pattern says x.
std::vector<assign::Lists> blinking(const std::string& pattern) {
  std::vector<assign::Lists> steps;
  for (const char c : pattern)
    steps.push_back(cells({{3}, c == 'x' ? std::vector<std::uint32_t>{7} : std::vector<std::uint32_t>{}}));
  return steps;
}

TEST(Stability, added_and_removed_pairs_are_both_changes) {
  const Churn churn = churn_of(8, {cells({{1, 2}, {}, {5}, {}}),  //
                                   cells({{1, 2}, {}, {5}, {}}),  // nothing
                                   cells({{2, 4}, {}, {}, {9}}),  // -1 +4 -5 +9
                                   cells({{2, 4}, {6}, {}, {9}})});
  EXPECT_EQ(churn.steps, 3);
  EXPECT_EQ(churn.changes, 5u);
  EXPECT_EQ(churn.most_changes, 4u);
  EXPECT_EQ(churn.mean_changes(), 5.0 / 3.0);
  EXPECT_EQ(churn.flickers, 0u);
}

TEST(Stability, a_light_that_moves_to_another_cell_is_two_changes_and_no_flicker) {
  const Churn churn = churn_of(8, {cells({{1}, {}}), cells({{}, {1}}), cells({{}, {1}})});
  EXPECT_EQ(churn.changes, 2u);
  EXPECT_EQ(churn.flickers, 0u);
}

TEST(Stability, a_change_back_is_a_flicker_whichever_way_it_goes) {
  EXPECT_EQ(churn_of(2, blinking("..x..")).flickers, 1u) << "added and removed again";
  EXPECT_EQ(churn_of(2, blinking("xx.xx")).flickers, 1u) << "removed and added again";
  EXPECT_EQ(churn_of(2, blinking(".x.x.x")).flickers, 4u) << "each change after the first";
}

TEST(Stability, a_change_back_counts_up_to_the_window_and_not_beyond) {
  EXPECT_EQ(churn_of(2, blinking(".xx.")).flickers, 1u);
  EXPECT_EQ(churn_of(2, blinking(".xxx.")).flickers, 0u);
  EXPECT_EQ(churn_of(3, blinking(".xxx.")).flickers, 1u);
  EXPECT_EQ(churn_of(3, blinking(".xxxx....xxxx")).flickers, 0u);
}

TEST(Stability, the_same_light_in_another_cell_is_another_pair) {
  EXPECT_EQ(churn_of(4, {cells({{}, {}}), cells({{1}, {}}), cells({{1}, {1}})}).flickers, 0u);
  EXPECT_EQ(churn_of(4, {cells({{}, {}}), cells({{1}, {}}), cells({{1, 2}, {}})}).flickers, 0u);
}

TEST(Stability, where_the_path_begins_is_no_change) {
  const Churn churn = churn_of(4, {cells({{1, 2, 3}})});
  EXPECT_EQ(churn, Churn{});
  EXPECT_EQ(churn.mean_changes(), 0.0);
}

TEST(Stability, excess_is_measured_against_the_truth) {
  EXPECT_EQ(excess_ratio(30, 20), 0.5);
  EXPECT_EQ(excess_ratio(10, 20), -0.5);
  EXPECT_EQ(excess_ratio(0, 0), 0.0);
  EXPECT_TRUE(std::isnan(excess_ratio(3, 0)));
}

// A camera that moves a millimetre a step past a lamp, and lists of lamps whose range is off by `noise_m` at random.
constexpr int k_steps = 2000;

view::Frame frame_at(int step, double noise_m, SplitMix64& random) {
  view::Frame frame;
  frame.viewport = {640, 360};
  frame.projection = {false, -1.6, 1.6, -0.9, 0.9, 0.1, 50.0};
  frame.view_space.origin = {0.001 * step, 0.0, 0.0};
  scene::WorldLight lamp;
  lamp.position = {1.3, 0.4, -6.0};
  lamp.range_m = 2.0 + random.between(-noise_m, noise_m);
  frame.lights = {lamp};
  frame.points = 1;
  return frame;
}

Churn churn_of_a_passing_lamp(double noise_m) {
  SplitMix64 random(1);
  grid::GridSpec spec;
  spec.tiles.pixels = {64, 64};
  const view::Frame first = frame_at(0, 0.0, random);
  const grid::Grid grid = grid::make_grid(spec, grid::grid_inputs(spec, first, 50.0, {}, {}));
  ChurnMeter meter(8);
  for (int step = 0; step <= k_steps; ++step) meter.add(find_truth(frame_at(step, noise_m, random), grid, 1).lists);
  return meter.result();
}

TEST(Stability, a_lamp_that_passes_once_never_flickers_in_the_truth) {
  const Churn churn = churn_of_a_passing_lamp(0.0);
  EXPECT_EQ(churn.steps, k_steps);
  EXPECT_GT(churn.changes, 20u);
  EXPECT_EQ(churn.flickers, 0u);
}

TEST(Stability, a_method_with_noise_changes_and_flickers_more_than_the_truth) {
  const Churn truth = churn_of_a_passing_lamp(0.0), noisy = churn_of_a_passing_lamp(0.003);
  EXPECT_GT(noisy.flickers, 20u);
  EXPECT_GT(noisy.changes, truth.changes + noisy.flickers / 2);
}

}  // namespace
}  // namespace clusterbench::measure
