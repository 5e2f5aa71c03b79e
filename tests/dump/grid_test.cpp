#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "dump/dump_frame.h"
#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

view::Frame frame_720() {
  view::Frame frame;
  frame.viewport = {1280, 720};
  frame.projection = {false, -1.6, 1.6, -0.9, 0.9, 0.1, 200.0};
  return frame;
}

result::DumpGrid grid_with(const char* json) {
  return result::from_json<result::DumpGrid>(result::Json::parse(json));
}

std::vector<float> boundaries(const char* slices, const view::Frame& frame = frame_720()) {
  const std::string text = std::string(R"({"tiles": {"count": [4, 3]}, "slices": )") + slices + "}";
  return grid_of(grid_with(text.c_str()), frame).screen().slices.boundaries;
}

TEST(DumpGrid, tiles_in_pixels_are_counted_from_the_first_row) {
  const char* from_top = R"({"tiles": {"pixels": [100, 100]}, "slices": {"count": 1}, "first_row": "top"})";
  const char* from_bottom = R"({"tiles": {"pixels": [100, 100]}, "slices": {"count": 1}, "first_row": "bottom"})";
  const grid::Tiles top = grid_of(grid_with(from_top), frame_720()).screen().tiles;
  const grid::Tiles bottom = grid_of(grid_with(from_bottom), frame_720()).screen().tiles;
  ASSERT_EQ(top.y.size(), 9u);
  ASSERT_EQ(bottom.y.size(), 9u);
  // Planes from the top: 0, 100 .. 700, 720 pixels below it, or 0, 20, 120 .. 720.
  for (int i = 0; i < 9; ++i) {
    const auto slope = [](double pixel) { return static_cast<float>(0.9 - 1.8 * pixel / 720.0); };
    EXPECT_NEAR(top.y[static_cast<std::size_t>(i)], slope(i == 8 ? 720.0 : 100.0 * i), 1e-6);
    EXPECT_NEAR(bottom.y[static_cast<std::size_t>(i)], slope(i == 0 ? 0.0 : 100.0 * i - 80.0), 1e-6);
  }
  EXPECT_EQ(top.x, bottom.x);
}

TEST(DumpGrid, a_formula_gives_the_slices_of_its_scheme) {
  // Bevy: ln(depth) * a - b + 1, the first slice to 5 m, 23 more to 100 m.
  const double a = 23.0 / std::log(20.0), b = std::log(5.0) * a;
  const std::string ln = R"({"count": 24, "formula": {"function": "ln", "scale": )" + grid::number_name(a) +
                         R"(, "bias": )" + grid::number_name(1.0 - b) + "}}";
  const std::vector<float> by_formula = boundaries(ln.c_str());
  const std::vector<float> by_scheme =
      boundaries(R"({"scheme": "exponential-first", "count": 24, "first_m": 5, "far_m": 100})");
  ASSERT_EQ(by_formula.size(), 25u);
  for (std::size_t i = 0; i < 25; ++i) EXPECT_NEAR(by_formula[i], by_scheme[i], 1e-5 * by_scheme[i]) << i;
  const std::vector<float> log2 =
      boundaries(R"({"count": 4, "formula": {"function": "log2", "scale": 2, "bias": 1, "far_m": 9}})");
  EXPECT_EQ(log2[1], 1.0f);
  EXPECT_EQ(log2[3], 2.0f);
  EXPECT_EQ(log2[4], 9.0f);
  EXPECT_LE(log2[0], 0.1f) << "slice 0 begins at the near plane";
  // Unreal: slice = log2(depth * B + O) * S.
  const std::vector<float> unreal = boundaries(
      R"({"count": 6, "formula": {"function": "log2", "depth_scale": 0.5, "depth_offset": 0.75, "scale": 2, "bias": 0}})");
  for (std::size_t i = 1; i < 7; ++i)
    EXPECT_FLOAT_EQ(std::log2(unreal[i] * 0.5f + 0.75f) * 2.0f, static_cast<float>(i));
  EXPECT_EQ(boundaries(R"({"count": 4, "formula": {"function": "linear", "scale": 0.02, "bias": 0}})"),
            (std::vector<float>{0.0f, 50.0f, 100.0f, 150.0f, 200.0f}));
}

TEST(DumpGrid, boundaries_of_our_own_grids_come_back_to_the_bit) {
  const testing::Made made = testing::made_frame();
  const DumpFile dump = testing::dump_of(made, made.truth);
  const grid::Grid back = frame_of(dump).grid;
  EXPECT_EQ(back.screen().slices.boundaries, made.grid.screen().slices.boundaries);
  EXPECT_EQ(back.screen().tiles.x, made.grid.screen().tiles.x);
  EXPECT_EQ(back.screen().tiles.y, made.grid.screen().tiles.y);
  EXPECT_EQ(frame_of(dump).frame.view_space.origin, made.frame.view_space.origin);
  EXPECT_EQ(frame_of(dump).frame.view_space.rotation, made.frame.view_space.rotation);
}

TEST(DumpGrid, tiles_without_slices_say_so) {
  view::Frame frame = frame_720();
  const std::vector<float> ends = boundaries(R"({"count": 1})", frame);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_FLOAT_EQ(ends[0], 0.1f);
  EXPECT_FLOAT_EQ(ends[1], 200.0f);
  frame.projection.far_m = INFINITY;
  EXPECT_THROW(boundaries(R"({"count": 1})", frame), Error);
  EXPECT_THROW(boundaries(R"({"scheme": "linear", "count": 4})", frame), Error);
}

TEST(DumpGrid, slices_that_do_not_say_where_they_are_are_refused) {
  const std::pair<const char*, const char*> rows[] = {
      {R"({"tiles": {"count": [4, 3]}})",
       "/grid/slices: are missing; allowed: boundaries_m, scheme or formula; count 1"},
      {R"({"tiles": {"count": [4, 3]}, "slices": {}})", "/grid/slices: do not say where they are; allowed: "},
      {R"({"tiles": {"count": [4, 3]}, "slices": {"count": 2}})", "/grid/slices: do not say where they are; allowed: "},
      {R"({"tiles": {"count": [4, 3]}, "slices": {"count": 1, "far_m": 9}})",
       "/grid/slices/far_m: has no meaning beside count; it is of scheme"},
      {R"({"tiles": {"count": [4, 3]}, "slices": {"count": 3, "boundaries_m": [1, 2, 3]}})",
       "/grid/slices/count: is 3; boundaries_m are those of 2"},
      {R"({"tiles": {"count": [4, 3]}, "slices": {"near_m": 1, "boundaries_m": [1, 2, 3]}})",
       "/grid/slices/near_m: has no meaning beside boundaries_m; it is of scheme"},
      {R"({"tiles": {"count": [4, 3]}, "slices": {"far_m": 9, "count": 2,
           "formula": {"function": "linear", "scale": 1, "bias": 0}}})",
       "/grid/slices/far_m: has no meaning beside formula; it is of scheme (formula.far_m)"}};
  for (const auto& [json, wanted] : rows) try {
      grid_of(grid_with(json), frame_720());
      ADD_FAILURE() << wanted;
    } catch (const Error& error) {
      EXPECT_EQ((error.where() + ": " + error.message()).substr(0, std::string(wanted).size()), wanted);
    }
}

TEST(DumpGrid, a_world_grid_may_give_its_planes) {
  const char* uneven = R"({"kind": "world", "planes": {"origin_m": [1e6, 0, -5], "x_m": [-1, 0, 4], "y_m": [0, 2],
                           "z_m": [-3, -2.5, 0, 1]}})";
  const grid::Grid grid = grid_of(grid_with(uneven), frame_720());
  EXPECT_EQ(grid.cells(), Vec3i(2, 1, 3));
  EXPECT_EQ(grid.world().origin, Vec3d(1e6, 0.0, -5.0));
  EXPECT_EQ(grid.world().z, (std::vector<float>{-3.0f, -2.5f, 0.0f, 1.0f}));
  const std::pair<const char*, const char*> rows[] = {
      {R"({"kind": "world", "planes": {"origin_m": [0, 0, 0], "x_m": [0, 1], "y_m": [0, 0], "z_m": [0, 1]}})",
       "/grid/planes/y_m: does not ascend in single precision at 0 m"},
      {R"({"kind": "world", "planes": {"origin_m": [1e15, 0, 0], "x_m": [0, 1e14], "y_m": [0, 1], "z_m": [0, 1]}})",
       "/grid/planes/x_m: has 1e+14 m, which takes it beyond 1e15 m"},
      {R"({"kind": "world", "cells": [1, 1, 1], "planes": {"origin_m": [0, 0, 0], "x_m": [0, 1], "y_m": [0, 1],
           "z_m": [0, 1]}})",
       "/grid/planes: stands beside cells, bounds, tiles or slices; allowed: alone"},
      {R"({"tiles": {"count": [1, 1]}, "planes": {"origin_m": [0, 0, 0], "x_m": [0, 1], "y_m": [0, 1], "z_m": [0, 1]}})",
       "/grid/planes: is of world grids only"}};
  for (const auto& [json, wanted] : rows) try {
      grid_of(grid_with(json), frame_720());
      ADD_FAILURE() << wanted;
    } catch (const Error& error) {
      EXPECT_EQ(error.where() + ": " + error.message(), wanted);
    }
}

}  // namespace
}  // namespace clusterbench::dump
