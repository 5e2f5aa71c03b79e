#include "grid/reaction.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "grid/grid.h"

namespace clusterbench::grid {
namespace {

Tiling in_pixels(int width, int height) {
  return {{width, height}, {0, 0}, 0.0};
}
Tiling per_screen(int columns, int rows) {
  return {{0, 0}, {columns, rows}, 0.0};
}

// By hand: 1920 x 1080 has 240 x 135 tiles of 8 px, 120 x 68 of 16, 60 x 34 of 32; 16384 words.
TEST(DoubledTiles, are_the_first_whose_words_fit) {
  struct Row {
    Vec2i viewport;
    std::uint64_t lights;
    int pixels;
  };
  constexpr Row k_rows[] = {
      {{1920, 1080}, 0, 8},     // no words
      {{1920, 1080}, 1, 16},    // 32400, then 8160
      {{1920, 1080}, 32, 16},   // still a word
      {{1920, 1080}, 64, 16},   // 2 · 8160 = 16320
      {{1920, 1080}, 65, 32},   // 3 · 8160 = 24480, then 3 · 2040
      {{1920, 1080}, 256, 32},  // 8 · 2040 = 16320
      {{1920, 1080}, 257, 64},  // 9 · 2040 = 18360, then 9 · 30 · 17
      {{1280, 720}, 32, 8},     // 160 · 90 = 14400
      {{1280, 720}, 33, 16},    // 28800, then 2 · 80 · 45 = 7200
      {{1280, 720}, 128, 16},   // 14400
      {{1280, 720}, 129, 32},   // 18000, then 5 · 40 · 23
      {{3840, 2160}, 1, 32},    // 129600, 32400, then 8160
      {{3840, 2160}, 256, 64},  // 65280, then 8 · 60 · 34 = 16320
  };
  for (const Row& row : k_rows)
    EXPECT_EQ(doubled_tiles(in_pixels(8, 8), row.viewport, row.lights, 16384), in_pixels(row.pixels, row.pixels))
        << row.viewport.x << " px, " << row.lights << " lights";
}

TEST(DoubledTiles, end_at_one_tile_where_the_words_of_no_tiles_fit) {
  const Tiling one = doubled_tiles(in_pixels(8, 8), {100, 50}, 100, 1);
  EXPECT_EQ(one, in_pixels(128, 128));
  EXPECT_EQ(mask_words(one, {100, 50}, 100), 4u);
  EXPECT_EQ(doubled_tiles(in_pixels(200, 200), {100, 50}, 100, 1), in_pixels(200, 200));
}

TEST(ShrunkTiles, have_columns_and_rows_times_the_square_root_of_what_there_is_room_for) {
  // sqrt(1/2) = 0.7071: 17 columns become 12.02, 9 rows 6.36.
  EXPECT_EQ(shrunk_tiles(in_pixels(113, 120), {1920, 1080}, 32768, 16384), in_pixels(160, 180));
  EXPECT_EQ(shrunk_tiles(per_screen(16, 9), {1920, 1080}, 400, 100), per_screen(8, 4));
  EXPECT_EQ(shrunk_tiles(per_screen(16, 9), {1920, 1080}, 101, 100), per_screen(15, 8));
}

TEST(ShrunkTiles, are_those_asked_for_where_there_is_room) {
  EXPECT_EQ(shrunk_tiles(in_pixels(64, 64), {1920, 1080}, 16384, 16384), in_pixels(64, 64));
  EXPECT_EQ(shrunk_tiles(in_pixels(64, 64), {1920, 1080}, 0, 1), in_pixels(64, 64));
}

TEST(ShrunkTiles, end_at_one_tile) {
  EXPECT_EQ(shrunk_tiles(in_pixels(64, 64), {1920, 1080}, 4000000000u, 1), in_pixels(1920, 1080));
  EXPECT_EQ(shrunk_tiles(per_screen(3, 2), {1920, 1080}, 4000000000u, 1), per_screen(1, 1));
}

GridSpec reacting(const Reaction& reaction, const Tiling& tiles) {
  GridSpec spec;
  spec.tiles = tiles;
  spec.reaction = reaction;
  return spec;
}

std::string refusal_of(const GridSpec& spec) {
  GridInputs inputs;
  inputs.viewport = {640, 480};
  try {
    make_grid(spec, inputs);
  } catch (const Error& error) {
    return error.where() + " " + error.message();
  }
  return "";
}

TEST(ReactingGrids, refuse_what_has_no_tiles_to_make_larger) {
  const Reaction entries{Reaction::To::entries, 100, "exact", 0}, words{Reaction::To::mask_words, 100, "", 0};
  EXPECT_NE(refusal_of(reacting(words, per_screen(4, 4))).find("react.to"), std::string::npos);
  EXPECT_NE(refusal_of(reacting(entries, {{0, 0}, {0, 0}, 1.0})).find("react takes tiles"), std::string::npos);
  GridSpec cubical = reacting(entries, in_pixels(64, 64));
  cubical.slices.scheme = Scheme::cubical;
  EXPECT_NE(refusal_of(cubical).find("react takes tiles"), std::string::npos);
}

TEST(ReactingGrids, are_named_by_what_they_react_to) {
  EXPECT_NE(reacting({Reaction::To::entries, 8192, "exact", 0}, in_pixels(64, 64))
                .name()
                .find(" react entries 8192 of exact"),
            std::string::npos);
  const std::string name = reacting({Reaction::To::mask_words, 16384, "", 256}, in_pixels(8, 8)).name();
  EXPECT_NE(name.find(" react mask-words 16384 lights 256"), std::string::npos);
  EXPECT_EQ(reacting({}, in_pixels(64, 64)).unreacting().name(), GridSpec{}.name());
}

}  // namespace
}  // namespace clusterbench::grid
