#include "pictures/figure.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>

#include "core/error.h"
#include "core/memory.h"
#include "pictures/colours.h"
#include "pictures/png.h"

namespace clusterbench::pictures {
namespace {

Figure small_figure(Vec2i size) {
  Figure figure;
  figure.palette = basic_palette();
  figure.palette.push_back({10, 20, 30});
  figure.title = "Title";
  figure.lines = {"one line"};
  figure.panels = {
      {size, std::vector<Colour>(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), k_basics), ""}};
  return figure;
}

std::int64_t count(const Canvas& canvas, Colour colour) {
  return std::count(canvas.pixels.begin(), canvas.pixels.end(), colour);
}

TEST(Figure, holds_every_pixel_of_its_map_and_enlarges_small_ones_by_a_whole_factor) {
  EXPECT_EQ(count(drawn(small_figure({700, 20})), k_basics), 700 * 20);
  EXPECT_EQ(count(drawn(small_figure({64, 48})), k_basics), 64 * 48 * 10 * 10);
  const Canvas large = drawn(small_figure({960, 540}));
  EXPECT_LT(large.size.x, 960 + 40);
  EXPECT_LT(large.size.y, 540 + 100);
}

TEST(Figure, is_bounded_before_memory_is_taken) {
  const Figure figure = small_figure({1000, 1000});
  const MemoryLimitScope limit(1 << 19);
  EXPECT_THROW(drawn(figure), Error);
}

TEST(Text, is_broken_at_blanks_and_has_a_mark_for_characters_that_the_font_lacks) {
  EXPECT_EQ(wrapped("aa bbb cc", Font::text, 6 * 7), (std::vector<std::string>{"aa bbb", "cc"}));
  EXPECT_EQ(wrapped("abcdefgh", Font::text, 3 * 7), (std::vector<std::string>{"abc", "def", "gh"}));
  EXPECT_TRUE(wrapped("", Font::text, 70).empty());
  EXPECT_EQ(text_width("h\u00e4ll", Font::text), 4 * 7);
  Canvas known({7, 13}, basic_palette()), other = known;
  draw_text(known, {0, 0}, "?", Font::text, k_ink);
  draw_text(other, {0, 0}, "\u00e4", Font::text, k_ink);
  EXPECT_EQ(known.pixels, other.pixels);
  EXPECT_GT(count(known, k_ink), 5);
}

TEST(Canvas, leaves_out_what_is_beside_it) {
  Canvas canvas({4, 3}, basic_palette());
  canvas.fill({-2, -2, 3, 3}, k_ink);
  canvas.fill({3, 2, 100, 100}, k_ink);
  canvas.set(4, 0, k_ink);
  canvas.set(0, -1, k_ink);
  EXPECT_EQ(canvas.pixels, (std::vector<Colour>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}));
}

TEST(Png, is_read_back_as_it_was) {
  Canvas canvas({3, 2}, {{255, 255, 255}, {1, 2, 3}, {250, 0, 125}});
  canvas.pixels = {0, 1, 2, 2, 1, 0};
  const std::string bytes = png_of(canvas);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
  image.format = PNG_FORMAT_RGB;
  std::vector<Rgb> pixels(6);
  ASSERT_EQ(PNG_IMAGE_SIZE(image), 18u);
  ASSERT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(pixels[i], canvas.palette[canvas.pixels[i]]);
}

}  // namespace
}  // namespace clusterbench::pictures
