#include <gtest/gtest.h>

#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

Made made_world() {
  Made out = made_frame();
  grid::GridSpec spec;
  spec.kind = grid::Kind::world;
  spec.cells = {8, 3, 7};
  spec.has_bounds = true;
  spec.bounds_lo_m = {-20.0, 0.0, -25.0};
  spec.bounds_hi_m = {20.0, 10.0, 15.0};
  out.grid = grid::make_grid(spec, grid::grid_inputs(spec, out.frame, 0.0, Vec3d(0.0), Vec3d(0.0)));
  out.truth = measure::find_truth(out.frame, out.grid, 1).lists;
  return out;
}

// The same as an engine has it whose world has z the other way: lights, camera, bounds, and slices from its own lowest
// z on.
DumpFile left_handed(const Made& made, const assign::Lists& lists) {
  DumpFile dump = dump_of(made, lists, {"xyz", false, true});
  for (layout::Buffer& buffer : dump.buffers)
    if (buffer.name == "lights")
      for (std::size_t light = 0; light < made.frame.lights.size(); ++light)
        for (const std::size_t at : {std::size_t{16}, std::size_t{48}})
          buffer.bytes[64 * light + at + 7] ^= std::byte{0x80};  // the sign of z
  std::vector<double>& m = *dump.record.camera.view_to_world;
  for (const std::size_t z : {2u, 6u, 10u, 14u}) m[z] = -m[z];
  for (std::size_t i = 8; i < 12; ++i) m[i] = -m[i];  // and it looks along +z of its view space
  dump.record.camera.forward = "+z";
  dump.record.grid.first_slice = "near";
  dump.record.grid.planes.reset();
  dump.record.grid.cells = result::Size3{8, 3, 7};
  dump.record.grid.bounds = result::DumpBounds{{-20.0, 0.0, -15.0}, {20.0, 10.0, 25.0}};
  return dump;
}

TEST(WorldDump, a_left_handed_world_is_read_as_it_is) {
  const Made made = made_world();
  ASSERT_GT(made.truth.pair_count(), 100u);
  EXPECT_EQ(verdict_on(dump_of(made, made.truth)).verdict, "right");
  DumpFile dump = left_handed(made, made.truth);
  const result::CheckedSet right = verdict_on(dump);
  EXPECT_EQ(right.verdict, "right");
  EXPECT_EQ(right.error->true_pairs, made.truth.pair_count());
  EXPECT_EQ(right.error->false_positives, 0u);
  dump.record.grid.bounds.reset();
  dump.record.grid.cells.reset();
  std::vector<double> z;
  for (int i = 0; i <= 7; ++i) z.push_back(-15.0 + 40.0 * i / 7.0);
  dump.record.grid.planes = result::DumpPlanes{{0, 0, 0}, {-20, -15, -10, -5, 0, 5, 10, 15, 20}, {}, z};
  for (int i = 0; i <= 3; ++i) dump.record.grid.planes->y_m.push_back(10.0 * i / 3.0);
  const std::string verdict = verdict_on(dump).verdict;
  EXPECT_TRUE(verdict == "right" || verdict == "rounding") << verdict;
}

TEST(WorldDump, cells_of_a_left_handed_world_are_told_in_that_world) {
  const Made made = made_world();
  const std::uint32_t cell = made.truth.fullest_cell(), light = made.truth.of(cell)[0];
  const assign::Lists lists = changed(made.truth, [&](auto c, auto l) {
    return c == cell && l == light ? std::nullopt : std::optional(std::pair(c, l));
  });
  const result::CheckedSet set = verdict_on(left_handed(made, lists));
  ASSERT_EQ(set.lost.size(), 1u);
  const Vec3i at = made.grid.cell_at(cell);
  const int z = 6 - at.z;
  EXPECT_EQ(set.lost[0].cell, (result::CellIndex{static_cast<std::uint64_t>(at.x), static_cast<std::uint64_t>(at.y),
                                                 static_cast<std::uint64_t>(z)}));
  EXPECT_EQ(set.lost[0].row, static_cast<std::uint64_t>(at.x + 8 * (at.y + 3 * z)));
  EXPECT_DOUBLE_EQ(set.lost[0].from_m, -15.0 + 40.0 * z / 7.0);
  EXPECT_DOUBLE_EQ(set.lost[0].to_m, -15.0 + 40.0 * (z + 1) / 7.0);
}

TEST(WorldDump, another_order_of_a_left_handed_world_is_named_in_its_own_words) {
  const Made made = made_world();
  DumpFile dump = left_handed(made, made.truth);
  dump.record.grid.first_slice = "far";
  const result::CheckedSet set = verdict_on(dump);
  EXPECT_EQ(set.verdict, "misread");
  ASSERT_TRUE(set.other_reading);
  EXPECT_EQ(set.other_reading->order, "grid.first_slice 'near'");
}

TEST(WorldDump, cells_end_at_the_bounds_that_are_given) {
  Made made = made_world();
  DumpFile dump = dump_of(
      made, changed(made.truth,
                    [](auto, auto) -> std::optional<std::pair<std::uint32_t, std::uint32_t>> { return std::nullopt; }));
  dump.record.grid.planes.reset();
  dump.record.grid.cells = result::Size3{8, 3, 7};
  dump.record.grid.bounds = result::DumpBounds{{-20.0, 0.0, -25.0}, {20.0, 10.0, 0.0}};
  std::size_t last = 0;
  for (const result::LostInCell& lost : verdict_on(dump).lost)
    if (lost.cell[2] == 6) {
      EXPECT_EQ(lost.to_m, 0.0);
      ++last;
    }
  EXPECT_GT(last, 0u);
}

}  // namespace
}  // namespace clusterbench::dump
