// Which colour a count gets in each kind of picture.

#include "pictures/map_figures.h"

#include <gtest/gtest.h>

#include <limits>

#include "pictures/colours.h"

namespace clusterbench::pictures {
namespace {

// A row of pixels with these counts; the last two pixels have no surface, and no answer.
struct RowOfPixels {
  Surface surface;
  std::vector<float> relief;
  PixelMaps maps;

  explicit RowOfPixels(std::vector<std::uint32_t> counts) {
    using State = PixelMaps::State;
    counts.insert(counts.end(), 2, 0);
    const auto width = counts.size();
    surface.image.pixels = depth::PixelGrid({static_cast<int>(width), 1}, 1);
    surface.image.nearest.assign(width, 4.0f);
    relief.assign(width, 1.0f);
    maps.state.assign(width, State::answered);
    maps.state[width - 2] = State::no_surface;
    maps.state[width - 1] = State::no_answer;
    maps.points = counts;
    maps.spots.assign(width, 0);
    maps.false_positives = maps.missed = counts;
    maps.surfaces = width - 1;
    maps.unanswered = 1;
    for (std::size_t i = 0; i < width; ++i)
      for (MapTotals* total : {&maps.lights_total, &maps.false_positives_total, &maps.missed_total})
        total->add(i, counts[i]);
  }

  Seen seen() const { return {surface, relief, 10}; }
};

std::vector<Rgb> colours_of(const Figure& figure) {
  std::vector<Rgb> out;
  for (const Colour colour : figure.panels.front().colours) out.push_back(figure.palette[colour]);
  return out;
}

const Rgb k_violet{0x44, 0x01, 0x54}, k_yellow{0xfd, 0xe7, 0x25};

TEST(LightsFigure, has_the_scales_ends_at_no_light_and_at_its_top) {
  const RowOfPixels row({0, 5, 10, 12});
  const Figure figure = lights_figure({}, row.seen(), row.maps, 10);
  const std::vector<Rgb> colours = colours_of(figure);
  EXPECT_EQ(colours[0], k_violet);
  EXPECT_EQ(colours[1], lights_colour(0.5));
  EXPECT_EQ(colours[2], k_yellow);
  EXPECT_EQ(colours[3], k_yellow);
  EXPECT_EQ(figure.ticks.back().label, "10+");
  EXPECT_EQ(colours[4], basic_palette()[k_no_surface]);
  EXPECT_EQ(colours[5], basic_palette()[k_no_answer_light]);
  EXPECT_EQ(figure.swatches.size(), 2u);
}

TEST(LevelsFigure, is_blue_above_none_green_above_three_and_red_above_five) {
  const RowOfPixels row({0, 1, 3, 4, 5, 6, 100});
  const std::vector<Rgb> colours = colours_of(levels_figure({}, row.seen(), row.maps));
  const auto is_most = [&](std::size_t i, std::uint8_t Rgb::*channel) {
    const Rgb& rgb = colours[i];
    return rgb.*channel > 150 && (rgb.r > 150) + (rgb.g > 150) + (rgb.b > 150) == 1;
  };
  for (const std::size_t i : {1, 2}) EXPECT_TRUE(is_most(i, &Rgb::b)) << i;
  for (const std::size_t i : {3, 4}) EXPECT_TRUE(is_most(i, &Rgb::g)) << i;
  for (const std::size_t i : {5, 6}) EXPECT_TRUE(is_most(i, &Rgb::r)) << i;
  EXPECT_LT(colours[0].b, 120);
}

TEST(TypesFigure, is_red_by_points_and_green_by_spots) {
  RowOfPixels row({0, 9, 0, 9, 1});
  row.maps.spots = {0, 0, 9, 9, 0, 0, 0};
  const std::vector<Rgb> colours = colours_of(types_figure({}, row.seen(), row.maps));
  EXPECT_EQ(colours[0], (Rgb{0, 0, 0}));
  EXPECT_EQ(colours[1], (Rgb{255, 0, 0}));
  EXPECT_EQ(colours[2], (Rgb{0, 255, 0}));
  EXPECT_EQ(colours[3], (Rgb{255, 255, 0}));
  EXPECT_GE(colours[4].r, 90);  // a single light is seen
  EXPECT_LT(colours[4].r, 150);
}

TEST(MissedFigure, shows_the_scene_where_nothing_is_missed_and_lights_missed_beyond_the_cells) {
  RowOfPixels row({0, 1, 4});
  row.maps.missed.back() = 2;
  const Figure figure = missed_figure({}, row.seen(), row.maps);
  const std::vector<Rgb> colours = colours_of(figure);
  EXPECT_EQ(colours[0], shaded(k_stone, 0.72));
  EXPECT_EQ(colours[1], missed_colour(0.0));
  EXPECT_EQ(colours[2], missed_colour(1.0));
  EXPECT_EQ(colours[4], missed_colour(1.0 / 3.0));
  EXPECT_NE(figure.notes.front().find("5 of 10"), std::string::npos);
  const RowOfPixels none({0, 0});
  EXPECT_TRUE(missed_figure({}, none.seen(), none.maps).bar.empty());
}

TEST(FalsePositivesFigure, begins_its_scale_at_one) {
  const RowOfPixels row({0, 1, 50});
  const Figure figure = false_positives_figure({}, row.seen(), row.maps, 50);
  const std::vector<Rgb> colours = colours_of(figure);
  EXPECT_EQ(colours[1], false_positives_colour(0.0));
  EXPECT_EQ(colours[2], false_positives_colour(1.0));
  EXPECT_EQ(figure.ticks.front().label, "1");
}

TEST(ListsFigure, has_the_same_colour_for_the_same_list_only) {
  const RowOfPixels row({0, 0, 0, 0, 0});
  ListMap lists;
  lists.list = {1, 2, 1, 0, 3, 0, 0};
  lists.lists = 3;
  const std::vector<Rgb> colours = colours_of(lists_figure({}, row.seen(), row.maps, lists));
  EXPECT_EQ(colours[0], colours[2]);
  EXPECT_NE(colours[0], colours[1]);
  EXPECT_NE(colours[1], colours[4]);
  EXPECT_EQ(colours[3], basic_palette()[k_empty]);
}

TEST(DepthFigure, is_light_near_and_dark_far) {
  RowOfPixels row({0, 0, 0});
  row.surface.image.nearest = {1.0f, 4.0f, 16.0f, std::numeric_limits<float>::infinity(), 2.0f};
  const Figure figure = depth_figure({}, row.seen());
  const std::vector<Rgb> colours = colours_of(figure);
  EXPECT_GT(colours[0].r, 240);
  EXPECT_NEAR(colours[1].r, (colours[0].r + colours[2].r) / 2, 2);
  EXPECT_LT(colours[2].r, 25);
  EXPECT_EQ(colours[3], basic_palette()[k_no_surface]);
  EXPECT_EQ(figure.ticks.front().label, "1 m");
}

TEST(StripFigure, has_a_panel_per_frame_on_one_scale) {
  StripFrame dim{0, {2, 1}, {PixelMaps::State::answered, PixelMaps::State::answered}, {0, 4}, {}, 2};
  StripFrame bright = dim;
  bright.frame = 7;
  bright.lights = {4, 8};
  for (StripFrame* frame : {&dim, &bright})
    for (std::size_t i = 0; i < 2; ++i) frame->total.add(i, frame->lights[i]);
  const Figure figure = strip_figure({}, {dim, bright}, 8);
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_EQ(figure.panels[0].colours[1], figure.panels[1].colours[0]);
  EXPECT_EQ(figure.palette[figure.panels[1].colours[1]], k_yellow);
  EXPECT_EQ(figure.panels[1].caption, "frame 7: mean 6, most 8");
}

TEST(Palettes, fit_into_a_png) {
  const RowOfPixels row({0, 100000, 7});
  ListMap lists;
  lists.list.assign(5, 1);
  lists.lists = 100000;
  for (const Figure& figure :
       {lights_figure({}, row.seen(), row.maps, 100000), levels_figure({}, row.seen(), row.maps),
        types_figure({}, row.seen(), row.maps), false_positives_figure({}, row.seen(), row.maps, 100000),
        missed_figure({}, row.seen(), row.maps), lists_figure({}, row.seen(), row.maps, lists),
        depth_figure({}, row.seen())})
    EXPECT_LE(figure.palette.size(), 256u) << figure.title;
}

}  // namespace
}  // namespace clusterbench::pictures
