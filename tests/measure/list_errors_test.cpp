#include "measure/truth/list_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clusterbench::measure {
namespace {

// One light of range 20 at depth 10 before two cells: depths 0.5..15 and 15..64.
struct TwoCells {
  view::Frame frame;
  grid::Grid grid;
  Truth truth;

  TwoCells() {
    frame.index = 4;
    frame.viewport = {64, 64};
    frame.projection = {false, -1.0, 1.0, -1.0, 1.0, 0.5, 64.0};
    scene::WorldLight light;
    light.rig_index = 7;
    light.position = {0.0, 0.0, -10.0};
    light.range_m = 20.0;
    frame.lights = {light};
    frame.points = 1;
    grid::GridSpec spec;
    spec.tiles.count = {1, 1};
    spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {0.5, 15.0, 64.0}};
    grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
    truth = find_truth(frame, grid, 1);
  }
};

TEST(Error, equal_lists_have_none) {
  const TwoCells s;
  ErrorCounts counts;
  add_frame(counts, s.frame, s.grid, s.truth, s.truth.lists);
  EXPECT_EQ(counts.true_pairs, 2u);
  EXPECT_EQ(counts.false_positives, 0u);
  EXPECT_EQ(counts.false_negatives, 0u);
  EXPECT_FALSE(counts.deepest);
}

TEST(Error, a_miss_is_named_with_its_depth) {
  const TwoCells s;
  ErrorCounts counts;
  add_frame(counts, s.frame, s.grid, s.truth, assign::Lists{{0, 1, 1}, {0}});
  EXPECT_EQ(counts.false_negatives, 1u);
  EXPECT_EQ(counts.miss_ratio(), 0.5);
  ASSERT_TRUE(counts.deepest);
  EXPECT_EQ(counts.deepest->frame, 4);
  EXPECT_EQ(counts.deepest->cell, 1u);
  EXPECT_EQ(counts.deepest->rig_index, 7);
  EXPECT_NEAR(counts.deepest_miss, 0.75, 1e-9);
}

// Where a limit of lights drops some, thousands are missed: the depth of each would take a minute a frame.
TEST(Error, a_miss_is_asked_for_its_depth_only_if_it_can_be_deeper_than_all_before) {
  const TwoCells s;
  const geom::LightVolume light = view::volume_of(s.frame.lights[0], grid::space_of(s.grid, s.frame));
  const double distance = relative_distance(light, s.grid.cell(1));
  EXPECT_NEAR(distance, 0.25, 1e-9);
  EXPECT_EQ(relative_distance(light, s.grid.cell(1), 0.26), distance);
  EXPECT_EQ(relative_distance(light, s.grid.cell(1), 0.24), 1.0);
  ErrorCounts counts;
  add_frame(counts, s.frame, s.grid, s.truth, assign::Lists{{0, 0, 0}, {}});
  EXPECT_EQ(counts.false_negatives, 2u);
  EXPECT_EQ(counts.deepest->cell, 0u) << "which holds the light's centre";
  EXPECT_NEAR(counts.deepest_miss, 1.0, 1e-9);
}

TEST(Error, reported_pairs_without_a_true_one_have_no_ratio) {
  TwoCells s;
  s.truth.lists = {{0, 0, 0}, {}};
  ErrorCounts counts;
  add_frame(counts, s.frame, s.grid, s.truth, s.truth.lists);
  EXPECT_EQ(counts.excess_ratio(), 0.0);
  add_frame(counts, s.frame, s.grid, s.truth, assign::Lists{{0, 1, 1}, {0}});
  EXPECT_EQ(counts.false_positives, 1u);
  EXPECT_TRUE(std::isnan(counts.excess_ratio()));
}

}  // namespace
}  // namespace clusterbench::measure
