#include "pictures/scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "pictures/colours.h"

namespace clusterbench::pictures {
namespace {

TEST(CountScale, begins_and_ends_at_the_ends_of_viridis) {
  for (const std::uint32_t top : {1u, 7u, 20u, 159u, 160u, 500u, 4000000000u}) {
    std::vector<Rgb> palette = basic_palette();
    const CountScale scale(0, top, lights_colour, palette);
    EXPECT_LE(palette.size(), 256u);
    EXPECT_EQ(palette[scale.colour_of(0)], (Rgb{0x44, 0x01, 0x54}));
    EXPECT_EQ(palette[scale.colour_of(top)], (Rgb{0xfd, 0xe7, 0x25})) << top;
    EXPECT_EQ(scale.colour_of(UINT32_MAX), scale.colour_of(top));
    EXPECT_EQ(scale.bar().front(), scale.colour_of(0));
    EXPECT_EQ(scale.bar().back(), scale.colour_of(top));
  }
}

TEST(CountScale, rises_evenly_and_has_a_colour_for_each_of_few_counts) {
  std::vector<Rgb> palette;
  const CountScale few(1, 12, missed_colour, palette);
  std::set<Colour> colours;
  for (std::uint32_t count = 1; count <= 12; ++count) colours.insert(few.colour_of(count));
  EXPECT_EQ(colours.size(), 12u);
  EXPECT_EQ(few.colour_of(0), few.colour_of(1));

  std::vector<Rgb> wide;
  const CountScale many(0, 1000, lights_colour, wide);
  for (std::uint32_t count = 0; count < 1000; ++count) {
    EXPECT_LE(many.colour_of(count), many.colour_of(count + 1));
    EXPECT_NEAR(many.colour_of(count), count * (wide.size() - 1) / 1000.0, 0.5 + 1e-9);
  }
}

TEST(CountScale, names_its_ends_and_numbers_that_are_easy_to_read) {
  std::vector<Rgb> palette;
  const auto labels = [&](std::uint32_t least, std::uint32_t top, bool goes_beyond) {
    std::string text;
    double before = -1.0;
    for (const Tick& tick : CountScale(least, top, lights_colour, palette).ticks(goes_beyond)) {
      EXPECT_GT(tick.at, before);
      EXPECT_LE(tick.at, 1.0);
      before = tick.at;
      text += tick.label + " ";
    }
    return text;
  };
  EXPECT_EQ(labels(0, 1, false), "0 1 ");
  EXPECT_EQ(labels(0, 30, true), "0 5 10 15 20 25 30+ ");
  EXPECT_EQ(labels(0, 17, true), "0 2 4 6 8 10 12 14 17+ ");
  EXPECT_EQ(labels(1, 5, false), "1 2 3 4 5 ");
  EXPECT_EQ(labels(1, 1, false), "1 ");
  EXPECT_EQ(labels(0, 4000, false), "0 500 1,000 1,500 2,000 2,500 3,000 3,500 4,000 ");
}

TEST(ScaleTop, is_the_next_easy_number_not_below_the_largest_count) {
  EXPECT_EQ(scale_top(0), 1u);
  EXPECT_EQ(scale_top(17), 17u);
  EXPECT_EQ(scale_top(20), 20u);
  EXPECT_EQ(scale_top(21), 25u);
  EXPECT_EQ(scale_top(100), 100u);
  EXPECT_EQ(scale_top(101), 120u);
  EXPECT_EQ(scale_top(UINT32_MAX), UINT32_MAX);
}

TEST(DepthTicks, lie_at_the_logarithm_of_their_depth) {
  const std::vector<Tick> ticks = depth_ticks(1.0, 16.0);
  ASSERT_EQ(ticks.size(), 4u);
  EXPECT_EQ(ticks[1].label, "2 m");
  EXPECT_NEAR(ticks[1].at, 0.25, 1e-12);
  EXPECT_EQ(depth_ticks(3.0, 3.0).size(), 1u);
}

TEST(DistinctColours, are_distinct) {
  const std::vector<Rgb> colours = distinct_colours(240);
  int least = 1000;
  for (std::size_t i = 1; i < colours.size(); ++i)
    least = std::min(least, std::abs(colours[i].r - colours[i - 1].r) + std::abs(colours[i].g - colours[i - 1].g) +
                                std::abs(colours[i].b - colours[i - 1].b));
  EXPECT_GT(least, 200);  // between those that follow each other
}

}  // namespace
}  // namespace clusterbench::pictures
