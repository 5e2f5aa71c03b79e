// The truth of boxes on grids of all kinds, and the samples that lie in them.

#include <gtest/gtest.h>

#include "assign/settings.h"
#include "effort.h"
#include "geom/light_meets_cell.h"
#include "measure/samples/shading.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure {
namespace {

using assign::testing::Random;
using assign::testing::Setting;

struct GridOfBoxes {
  grid::Kind kind;
  bool orthographic;
};

// Boxes alone: random ones, and ones that reach into a cell by a hair.
Setting boxes_on(const GridOfBoxes& of, std::uint64_t seed) {
  assign::AssignerDescriptor takes_boxes;
  takes_boxes.kinds = {of.kind};
  takes_boxes.points = takes_boxes.spots = false;
  takes_boxes.boxes = true;
  takes_boxes.orthographic = of.orthographic;
  std::vector<Setting> all = assign::testing::settings_for(takes_boxes, seed);
  return std::move(all.back());
}

class TruthOfBoxes : public testing::TestWithParam<GridOfBoxes> {};

TEST_P(TruthOfBoxes, is_what_deciding_every_cell_alone_finds_and_nothing_is_undecided) {
  const Setting setting = boxes_on(GetParam(), 41);
  const Truth truth = find_truth(setting.frame, setting.grid, 1);
  EXPECT_EQ(truth.undecided, 0u);
  EXPECT_GT(truth.filter_decided, truth.exact_decided);
  const view::Space space = grid::space_of(setting.grid, setting.frame);
  Random random(5);
  int yes = 0, no = 0;
  for (int i = 0; i < test::tries(60000); ++i) {
    const auto light = static_cast<std::uint32_t>(random.unit() * static_cast<double>(setting.frame.lights.size()));
    const auto cell = static_cast<std::uint32_t>(random.unit() * setting.grid.cell_count());
    if (setting.grid.is_hole(cell) || setting.frame.lights[light].range_m == 0.0) continue;
    const geom::Verdict verdict =
        geom::decide_meets(view::volume_of(setting.frame.lights[light], space), setting.grid.cell(cell));
    const bool is_true = assign::testing::lists_light(truth.lists, cell, light);
    EXPECT_EQ(verdict == geom::Verdict::yes, is_true) << "cell " << cell << ", light " << light;
    ++(is_true ? yes : no);
  }
  EXPECT_GT(yes, 20);
  EXPECT_GT(no, 20);
}

TEST_P(TruthOfBoxes, holds_boxes_that_touch_by_a_hair_and_the_cells_of_all_their_points) {
  const Setting setting = boxes_on(GetParam(), 42);
  const Truth truth = find_truth(setting.frame, setting.grid, 2);
  EXPECT_GT(setting.touches.size(), 200u);
  for (const auto& [cell, light] : setting.touches)
    EXPECT_TRUE(assign::testing::lists_light(truth.lists, cell, light)) << "cell " << cell << ", light " << light;
  EXPECT_EQ(assign::testing::count_misses(setting.frame, setting.grid, truth.lists, test::tries(300), 7), 0);
  EXPECT_EQ(find_truth(setting.frame, setting.grid, 1).lists, truth.lists);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, TruthOfBoxes,
    testing::Values(GridOfBoxes{grid::Kind::frustum, false}, GridOfBoxes{grid::Kind::frustum, true},
                    GridOfBoxes{grid::Kind::distance, false}, GridOfBoxes{grid::Kind::cascades, false},
                    GridOfBoxes{grid::Kind::world, false}),
    [](const auto& kind) {
      return std::string(grid::kind_name(kind.param.kind)) + (kind.param.orthographic ? "_orthographic" : "");
    });

TEST(DeepestMiss, of_a_box_is_the_scale_at_which_it_begins_to_touch) {
  geom::BoxVolume box;
  box.half_axes = {Vec3d(4, 0, 0), Vec3d(0, 4, 0), Vec3d(0, 0, 4)};
  box.range = 7;
  const geom::Box cell{{1, -1, -1}, {2, 1, 1}};
  EXPECT_NEAR(relative_distance(box, cell), 0.25, 1e-9);
}

grid::Sample sample_of_boxes(const Vec3d& from_eye, const Vec3d& eye) {
  return {0.0f, 0.0f, Vec3f(from_eye), from_eye, eye};
}

TEST(SamplesInBoxes, are_those_whose_coordinates_in_the_box_are_within_one_and_get_no_light) {
  Random random(8);
  view::Frame frame;
  frame.view_space.origin = {1000, 20, -300};
  frame.lights = assign::testing::random_boxes(40, 9);
  for (scene::WorldLight& box : frame.lights) box.position += frame.view_space.origin;
  frame.count_types();
  ASSERT_EQ(frame.boxes, 40u);
  std::vector<grid::Sample> samples;
  std::vector<std::pair<std::uint32_t, bool>> expected;
  for (std::uint32_t light = 0; light < 40; ++light) {
    const scene::WorldLight& box = frame.lights[light];
    if (box.half_axes_m[2] == Vec3d(0)) continue;
    for (int i = 0; i < 50; ++i) {
      Vec3d at = box.position - frame.view_space.origin;
      bool is_in = true;
      for (const Vec3d& axis : box.half_axes_m) {
        const double along = random.between(-1.2, 1.2);
        is_in = is_in && std::fabs(along) <= 1.0;
        at += along * axis;
      }
      samples.push_back(sample_of_boxes(at, frame.view_space.origin));
      expected.emplace_back(light, is_in);
    }
  }
  const NeededLights needed = needed_lights(frame, samples);
  for (std::uint32_t i = 0; i < samples.size(); ++i)
    EXPECT_EQ(assign::testing::lists_light(needed.lists, i, expected[i].first), expected[i].second) << i;
  for (const double lux : needed.lux) EXPECT_EQ(lux, 0.0);
}

TEST(SamplesInBoxes, a_sample_on_a_side_is_in_the_box_and_one_ulp_beside_it_is_not) {
  view::Frame frame;
  frame.lights = {assign::testing::box_light({0, 0, -3}, {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 0)}),
                  assign::testing::box_light({0, 0, -4}, {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)})};
  frame.count_types();
  const auto lights_at = [&](const Vec3d& p) {
    const std::vector<grid::Sample> samples{sample_of_boxes(p, Vec3d(0))};
    return lights_reaching(frame, samples).lights;
  };
  EXPECT_EQ(lights_at({1, 0.5, -3}), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(lights_at({std::nextafter(1.0, 2.0), 0.5, -3}), (std::vector<std::uint32_t>{}));
  EXPECT_EQ(lights_at({1, 0.5, std::nextafter(-3.0, -4.0)}), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(lights_at({1, 0.5, std::nextafter(-3.0, 0.0)}), (std::vector<std::uint32_t>{}));
}

}  // namespace
}  // namespace clusterbench::measure
