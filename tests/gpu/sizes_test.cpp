// Lists at the ends of what shaders can get wrong: one cell, one light, words and blocks that are just full, columns
// beyond a group's size, a million cells, lists that outgrow their buffer, buffers above the device's limit.

#include "core/error.h"
#include "core/memory.h"
#include "gpu/device_test.h"
#include "gpu/reference_lists.h"

namespace clusterbench::gpu {
namespace {

using assign::AssignerDescriptor;
using assign::Lists;
using assign::Params;
using assign::testing::Random;
using assign::testing::Setting;
using testing::first_difference;
using testing::list_methods;
using testing::lists_of;
using testing::reference_lists;

class DeviceSizes : public testing::DeviceTest {};

// A grid of so many cells before a camera that sees -1 .. 1 across and down at depth 1, from depth 1 to 100.
Setting setting_of(const Vec3i& cells, std::vector<scene::WorldLight> lights) {
  Setting setting;
  setting.name = std::to_string(cells.x) + " x " + std::to_string(cells.y) + " x " + std::to_string(cells.z) +
                 " cells, " + std::to_string(lights.size()) + " lights";
  setting.frame = assign::testing::frame_of({false, -1, 1, -1, 1, 1, 100}, {4096, 4096}, std::move(lights));
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {cells.x, cells.y}};
  spec.slices = {.scheme = grid::Scheme::exponential, .count = cells.z, .near_m = 1, .far_m = 100, .boundaries_m = {}};
  setting.grid = assign::testing::grid_of(spec, setting.frame);
  return setting;
}

// In view, of every size; each third one a spot if there are to be any.
std::vector<scene::WorldLight> lights_in_view(std::uint32_t count, std::uint64_t seed, double most_range = 60,
                                              bool with_spots = true) {
  Random random(seed);
  std::vector<scene::WorldLight> points, spots;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double depth = random.log_between(0.8, 110), range = random.log_between(0.02, most_range);
    const Vec3d at{random.between(-1.1, 1.1) * depth, random.between(-1.1, 1.1) * depth, -depth};
    if (with_spots && i % 3 == 2)
      spots.push_back(assign::testing::spot_light(at, range, random.direction(), random.between(0.05, 1.5)));
    else
      points.push_back(assign::testing::point_light(at, range));
  }
  points.insert(points.end(), spots.begin(), spots.end());
  return points;
}

void expect_reference_lists(const AssignerDescriptor& row, const Setting& setting) {
  const Params params(row.params);
  EXPECT_EQ(first_difference(lists_of(row, params, setting), reference_lists(params, setting)), "")
      << row.name << ", " << setting.name;
}

TEST_F(DeviceSizes, of_any_number_of_lights_around_full_words_and_batches_are_right) {
  for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 63u, 64u, 65u, 95u, 97u, 128u, 129u, 257u})
    for (const AssignerDescriptor* row : list_methods())
      expect_reference_lists(*row, setting_of({5, 3, 2}, lights_in_view(count, count)));
}

// One cell; blocks of 4 cells that are just full; 256 cells of a sum, one fewer and one more; groups of 64 invocations;
// rows and columns longer than a group and than a thousand.
TEST_F(DeviceSizes, of_any_number_of_cells_around_full_blocks_and_groups_are_right) {
  const Vec3i sizes[] = {{1, 1, 1},    {2, 1, 1},   {4, 4, 4},  {5, 5, 5},  {3, 4, 5},   {63, 1, 1},
                         {1, 65, 1},   {1, 1, 3},   {51, 5, 1}, {64, 4, 1}, {257, 1, 1}, {1, 1030, 1},
                         {1500, 1, 2}, {31, 33, 2}, {6, 1, 9},  {16, 9, 8}};
  for (const Vec3i& cells : sizes)
    for (const AssignerDescriptor* row : list_methods())
      expect_reference_lists(*row, setting_of(cells, lights_in_view(70, 3)));
}

// Groups are numbered across two dimensions beyond 32,768, and the last row of them is not full.
TEST_F(DeviceSizes, of_more_groups_than_fit_into_a_row_are_right) {
  expect_reference_lists(*assign::find_assigner("gpu-mask"), setting_of({210, 158, 1}, lights_in_view(3, 6)));
  const Setting many = setting_of({2, 2, 1}, lights_in_view(33'000, 7, 0.5));
  for (const AssignerDescriptor* row : list_methods()) expect_reference_lists(*row, many);
}

TEST_F(DeviceSizes, of_a_million_cells_are_right) {
  const Setting setting = setting_of({100, 100, 100}, lights_in_view(5, 8, 20));
  for (const char* name : {"gpu-group", "gpu-lights"}) expect_reference_lists(*assign::find_assigner(name), setting);
}

// By hand (--gtest_also_run_disabled_tests): ten seconds on lavapipe, a minute on SwiftShader.
TEST_F(DeviceSizes, DISABLED_of_10000_lights_and_36864_cells_are_right) {
  const Setting setting = setting_of({64, 24, 24}, lights_in_view(10'000, 9, 8));
  const Params params(list_methods().front()->params);
  const Lists expected = reference_lists(params, setting);
  for (const AssignerDescriptor* row : list_methods())
    EXPECT_EQ(first_difference(lists_of(*row, params, setting), expected), "") << row->name;
  RecordProperty("pairs", static_cast<int>(expected.pair_count()));
}

// The first buffer of lists holds 65,536 entries. A frame after it, and one before, leave no trace.
TEST_F(DeviceSizes, of_lists_that_outgrow_their_buffer_are_right_and_so_are_those_of_the_next_frames) {
  std::vector<scene::WorldLight> everywhere(90, assign::testing::point_light({0, 0, -5}, 1e3));
  const Setting few = setting_of({20, 10, 5}, lights_in_view(40, 2)), many = setting_of({20, 10, 5}, everywhere);
  const view::LightArrays of_few = view::lights_in(few.frame, grid::space_of(few.grid, few.frame)),
                          of_many = view::lights_in(many.frame, grid::space_of(many.grid, many.frame));
  for (const AssignerDescriptor* row : list_methods()) {
    const Params params(row->params);
    assign::AssignerRun run(*row, params, assign::Answer::lists);
    run.build(few.grid);
    for (const bool is_many : {false, true, false, true, true}) {
      const Setting& setting = is_many ? many : few;
      run.assign(setting.input(is_many ? of_many : of_few));
      EXPECT_EQ(first_difference(run.cell_lists(), reference_lists(params, setting)), "") << row->name;
    }
    EXPECT_EQ(run.cell_lists().pair_count(), 90'000u);
  }
}

// As many pairs as the device's largest buffer holds just so, then more, which are refused, then few.
TEST_F(DeviceSizes, of_millions_of_pairs_fill_the_largest_buffer_and_no_more) {
  const std::uint64_t limit = device().facts().max_buffer_bytes;
  const auto fitting = static_cast<std::uint32_t>(limit / 4 / 500'000);
  if (fitting > 200) GTEST_SKIP() << "skipped: the limit of " << limit << " bytes is out of reach";
  const auto everywhere = [](std::uint32_t count) {
    return setting_of({100, 100, 50}, {count, assign::testing::point_light({0, 0, -5}, 1e3)});
  };
  const Setting full = everywhere(fitting), above = everywhere(fitting + 1), few = everywhere(1);
  const AssignerDescriptor& row = *assign::find_assigner("gpu-lights");
  assign::AssignerRun run(row, Params(row.params), assign::Answer::lists);
  run.build(full.grid, {.spots = false, .boxes = false});
  const auto pairs_of = [&](const Setting& setting) {
    run.assign(setting.input(view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame))));
    return run.filled_lists()->pair_count();
  };
  EXPECT_EQ(pairs_of(full), fitting * 500'000u);
  try {
    pairs_of(above);
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    const std::string bytes = std::to_string((fitting + 1) * std::uint64_t{2'000'000});
    EXPECT_TRUE(error.message().starts_with("lists need a buffer of " + bytes + " bytes; ")) << error.message();
  }
  EXPECT_EQ(pairs_of(few), 500'000u);
}

// Refused with the number, and the next frame is right again.
TEST_F(DeviceSizes, whose_buffers_are_above_the_devices_limit_are_refused_with_the_number) {
  const std::uint64_t limit = device().facts().max_buffer_bytes;
  const Vec3i cells{100, 100, 100};
  const auto lights = static_cast<std::uint32_t>(32 * (limit / 4 / 1'000'000 + 1));
  if (lights > 100'000) GTEST_SKIP() << "skipped: the limit of " << limit << " bytes is out of reach";
  const Setting many = setting_of(cells, lights_in_view(lights, 4, 0.05, false)),
                few = setting_of(cells, lights_in_view(3, 5, 5, false));
  const AssignerDescriptor& row = *assign::find_assigner("gpu-lights");
  const Params params(row.params);
  assign::AssignerRun run(row, params, assign::Answer::lists);
  run.build(many.grid, {.spots = false, .boxes = false});
  try {
    run.assign(many.input(view::lights_in(many.frame, grid::space_of(many.grid, many.frame))));
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.where() + ": " + error.message(), "device: bits of cells and lights need a buffer of " +
                                                          std::to_string(std::uint64_t{lights} / 32 * 4'000'000) +
                                                          " bytes; " + device().facts().name + " allows " +
                                                          std::to_string(limit) + "; use fewer lights or cells");
  }
  run.assign(few.input(view::lights_in(few.frame, grid::space_of(few.grid, few.frame))));
  EXPECT_EQ(first_difference(run.cell_lists(), reference_lists(params, few)), "");
}

// As the device's limit does: what needs more memory than the configuration allows ends its own cases alone.
TEST_F(DeviceSizes, whose_buffers_are_above_the_users_limit_fail_on_the_device) {
  const std::uint64_t before = memory_limit();
  const Setting setting = setting_of({100, 100, 100}, lights_in_view(320, 4, 0.05, false));
  const AssignerDescriptor& row = *assign::find_assigner("gpu-lights");
  assign::AssignerRun run(row, Params(row.params), assign::Answer::lists);
  run.build(setting.grid, {.spots = false, .boxes = false});
  set_memory_limit(16 << 20);
  try {
    run.assign(setting.input(view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame))));
    ADD_FAILURE() << "not refused";
  } catch (const DeviceError& error) {
    EXPECT_TRUE(std::string(error.message()).starts_with("limits.memory_mib: 40000000 bits of cells and lights would "))
        << error.message();
  }
  set_memory_limit(before);
}

}  // namespace
}  // namespace clusterbench::gpu
