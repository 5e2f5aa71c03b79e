// The exact assigners where single precision says least: lights just beside the picture where the last tiles are
// clipped, and lights that end at the eye where slices begin there.

#include <gtest/gtest.h>

#include "assign/settings.h"
#include "effort.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure {
namespace {

using assign::testing::Random;
using assign::testing::Setting;

assign::Lists exact_lists(const char* name, const Setting& setting) {
  return assign::testing::lists_by(name, setting.frame, setting.grid);
}

void expect_true_lists(const Setting& setting) {
  const Truth truth = find_truth(setting.frame, setting.grid, 2);
  EXPECT_EQ(truth.undecided, 0U) << setting.name;
  for (const char* name : {"exact", "exact-fast"}) {
    const assign::Lists found = exact_lists(name, setting);
    EXPECT_EQ(found, truth.lists) << name << " on " << setting.name << ": " << found.pair_count() << " pairs for "
                                  << truth.lists.pair_count();
  }
}

Setting setting_of(std::string name, const view::Projection& projection, Vec2i viewport, const grid::GridSpec& spec,
                   std::vector<scene::WorldLight> lights) {
  Setting setting;
  setting.name = std::move(name);
  setting.frame = assign::testing::frame_of(projection, viewport, std::move(lights));
  setting.grid = assign::testing::grid_of(spec, setting.frame);
  return setting;
}

grid::GridSpec listed_slices(Vec2i tile_pixels, Vec2i tile_count, std::vector<double> boundaries_m) {
  grid::GridSpec spec;
  spec.tiles = {tile_pixels, tile_count};
  spec.slices.scheme = grid::Scheme::list;
  spec.slices.boundaries_m = std::move(boundaries_m);
  return spec;
}

TEST(ExactLists, hold_no_light_beside_the_picture_where_the_last_column_is_clipped) {
  const grid::GridSpec spec = listed_slices({64, 64}, {0, 0}, {0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100});
  Setting setting = setting_of("orthographic", {true, -5, 5, -3.2, 3.2, 0, 100}, {1000, 640}, spec,
                               {assign::testing::point_light({14, 2.53, -5.1}, 3.99999)});
  setting.frame.view_space.origin = {5, 3.2, 0};
  EXPECT_EQ(find_truth(setting.frame, setting.grid, 1).lists.pair_count(), 0U);
  expect_true_lists(setting);
}

// --- Random clipped tiles, with balls that end at a side of the picture, in it or beside it by a hair ---

// Left, right, bottom or top at a place of that depth.
Vec3d place_beside(const view::Projection& picture, int side, double depth, double share, double range, double hair) {
  const double w = picture.orthographic ? 1.0 : depth;
  const bool across = side < 2;
  const double at[4] = {picture.left, picture.right, picture.bottom, picture.top};
  const double slope = at[side], out = side % 2 == 0 ? -1.0 : 1.0;
  const double low = across ? picture.bottom : picture.left, high = across ? picture.top : picture.right;
  const double other = (low + share * (high - low)) * w;
  const double tilt = picture.orthographic ? 0.0 : slope;
  const double length = std::sqrt(1.0 + tilt * tilt), away = range * (1.0 + hair) / length;
  const Vec3d in_plane = across ? Vec3d{slope * w, other, -depth} : Vec3d{other, slope * w, -depth};
  return in_plane + out * away * (across ? Vec3d{1, 0, tilt} : Vec3d{0, 1, tilt});
}

std::vector<scene::WorldLight> lights_beside(const view::Projection& picture, int count, Random& random) {
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < count; ++i) {
    const double range = random.log_between(1e-2, 100), depth = random.log_between(0.05, 150);
    const double hair = random.log_between(1e-9, 1e-4) * (random.unit() < 0.5 ? -1 : 1);
    const int side = static_cast<int>(random.between(0, 4));
    lights.push_back(assign::testing::point_light(
        place_beside(picture, side, depth, random.between(-0.2, 1.2), range, hair), range));
  }
  return lights;
}

view::Projection random_picture(bool orthographic, Random& random) {
  const double size = orthographic ? random.log_between(0.5, 50) : random.log_between(0.05, 5);
  const double shift_x = random.unit() < 0.5 ? 0.0 : random.between(-1.5, 1.5) * size;
  const double shift_y = random.unit() < 0.5 ? 0.0 : random.between(-1.5, 1.5) * size;
  return {orthographic, shift_x - size, shift_x + size, shift_y - 0.6 * size, shift_y + 0.6 * size, 0.1, 120};
}

// Tiles of so many pixels that the last column and row have anything from one pixel to all of theirs.
grid::GridSpec random_clipped_grid(Random& random) {
  const auto pixels = [&] { return static_cast<int>(random.between(20, 700)); };
  const std::vector<double> lists[] = {{0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100}, {0.1, 1, 5, 30, 120}, {0.1, 120}};
  return listed_slices({pixels(), pixels()}, {0, 0}, lists[static_cast<int>(random.between(0, 3))]);
}

TEST(ExactLists, are_true_for_lights_that_end_at_a_side_of_the_picture_with_clipped_tiles) {
  Random random(35);
  for (int i = 0; i < test::tries(400); ++i) {
    const bool orthographic = i % 2 == 0;
    const view::Projection picture = random_picture(orthographic, random);
    const grid::GridSpec spec = random_clipped_grid(random);
    expect_true_lists(
        setting_of(spec.name() + (orthographic ? ", orthographic " : ", perspective ") + std::to_string(i), picture,
                   {1000, 640}, spec, lights_beside(picture, 200, random)));
  }
}

// --- Balls whose surface is nearly at the eye, in slices that begin there ---

TEST(ExactLists, hold_a_light_around_the_eye_by_less_than_single_precision_tells_everywhere) {
  const grid::GridSpec spec = listed_slices({0, 0}, {12, 12}, {0, 1, 10, 100});
  for (const Vec3d& towards : {Vec3d{0, 0, -1}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{0, -1, 0}, Vec3d{0.6, 0, 0.8}}) {
    const Setting setting = setting_of("20 pm", assign::testing::perspective(1.0, 1.5, 0.1, 100), {1200, 800}, spec,
                                       {assign::testing::point_light(1e-5 * towards, 1e-5 + 2e-11)});
    EXPECT_EQ(find_truth(setting.frame, setting.grid, 1).lists.pair_count(), 144U);
    expect_true_lists(setting);
  }
}

// The surface goes through the eye but for a part of its slack, or through one of the tile planes' lines nearby.
std::vector<scene::WorldLight> lights_around_the_eye(const grid::ScreenGrid& screen, int count, Random& random) {
  std::vector<scene::WorldLight> lights;
  for (int i = 0; i < count; ++i) {
    const double range = random.log_between(2e-7, 1e6);
    const double hair = random.log_between(1e-16, 1e-3) * (random.unit() < 0.3 ? -1 : 1);
    Vec3d towards = random.direction();
    if (i % 4 == 1) towards = {0, 0, -1};
    if (i % 4 == 2) towards = glm::normalize(Vec3d{0, random.log_between(1e-9, 1), -1});
    if (i % 4 == 3) {  // a tile plane touches nearly at the eye
      const std::vector<float>& planes = screen.tiles.y;
      const double slope = planes[static_cast<std::size_t>(random.unit() * static_cast<double>(planes.size()))];
      towards = glm::normalize(Vec3d{random.log_between(1e-9, 1e-2), 1, slope + random.log_between(1e-9, 1e-2)});
      if (random.unit() < 0.5) towards = -towards;
    }
    lights.push_back(assign::testing::point_light(range * towards, range * (1 + hair)));
  }
  return lights;
}

TEST(ExactLists, are_true_for_lights_around_the_eye_of_any_size_where_slices_begin_at_the_eye) {
  Random random(34);
  for (const std::vector<double>& boundaries :
       {std::vector<double>{0, 1, 10, 100}, {0, 1e-9, 1e-7, 1e-5, 1e-3}, {0, 1e-14, 1e-10, 1}, {0, 1e3, 1e6}})
    for (const double field : {0.5, 1.5, 3.0}) {
      Setting setting = setting_of("", assign::testing::perspective(field, 1.5, 0.1, 100), {1200, 800},
                                   listed_slices({0, 0}, {12, 9}, boundaries), {});
      setting.name = "slices from " + std::to_string(boundaries[1]) + ", field " + std::to_string(field);
      setting.frame.lights = lights_around_the_eye(setting.grid.screen(), test::tries(48), random);
      setting.frame.points = static_cast<std::uint32_t>(setting.frame.lights.size());
      expect_true_lists(setting);
    }
}

}  // namespace
}  // namespace clusterbench::measure
