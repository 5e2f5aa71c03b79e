#include <gtest/gtest.h>

#include "core/error.h"
#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

std::string grid_refusal(const char* json) {
  view::Frame frame;
  frame.viewport = {1280, 720};
  frame.projection = {false, -1.6, 1.6, -0.9, 0.9, 0.1, 200.0};
  try {
    grid_of(result::from_json<result::DumpGrid>(result::Json::parse(json)), frame);
    return "";
  } catch (const Error& error) {
    return error.where() + ": " + error.message();
  }
}

TEST(DumpRefusals, of_grids_are_in_the_words_of_a_dump) {
  const std::string first = grid_refusal(
      R"({"tiles": {"count": [4, 3]}, "slices": {"scheme": "exponential-first", "count": 4, "first_m": 500, "far_m": 100}})");
  EXPECT_EQ(first.find("/grid/slices/"), 0u) << first;
  EXPECT_EQ(first.find("grids"), std::string::npos) << first;
  const std::string cells =
      grid_refusal(R"({"tiles": {"count": [1280, 720]}, "slices": {"scheme": "linear", "count": 60000}})");
  EXPECT_EQ(cells.find("/grid: "), 0u) << cells;
}

TEST(DumpRefusals, a_last_slice_that_far_m_leaves_empty_is_told_with_both_numbers) {
  EXPECT_EQ(
      grid_refusal(R"({"tiles": {"count": [4, 3]}, "slices": {"count": 5,
                             "formula": {"function": "linear", "scale": 0.5, "bias": 0, "far_m": 8.0000000001}}})"),
      "/grid/slices/formula/far_m: is 8.0000000001 m, where the last slice (4) begins, at 8 m: nothing is left of "
      "it; is the bias right?");
}

TEST(DumpRefusals, lights_in_two_ways_are_named) {
  const Made made = made_frame({{0, 0}, {4, 3}, 0.0});
  DumpFile dump = dump_of(made, made.truth);
  dump.record.lights.listed.emplace();
  try {
    frame_of(dump);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.message(), "has rows and listed; allowed: one of rows, listed and scene");
  }
}

TEST(DumpRefusals, a_unit_beyond_all_reason_is_refused) {
  const Made made = made_frame({{0, 0}, {4, 3}, 0.0});
  DumpFile dump = dump_of(made, made.truth);
  dump.record.metres_per_unit = 1e50;
  try {
    parse_dump(result::to_json(dump.record).dump(), "made.json");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "/metres_per_unit");
  }
}

}  // namespace
}  // namespace clusterbench::dump
