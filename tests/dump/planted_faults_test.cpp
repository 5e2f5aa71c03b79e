#include <gtest/gtest.h>

#include <functional>

#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

using Moved = std::optional<std::pair<std::uint32_t, std::uint32_t>>;

const Made& made() {
  static const Made frame = made_frame();
  return frame;
}

struct Deepest {
  std::uint32_t cell = 0, light = 0;
  double reach = -1.0;
};

// Where a light reaches deepest into a cell without being all around it.
Deepest deepest_pair() {
  Deepest out;
  for (std::uint32_t cell = 0; cell < made().truth.cell_count(); ++cell)
    for (const std::uint32_t light : made().truth.of(cell)) {
      const double reach = 1.0 - measure::relative_distance(made().frame, made().grid, cell, light);
      if (reach > out.reach) out = {cell, light, reach};
    }
  return out;
}

TEST(PlantedFaults, the_exact_lists_are_right_in_every_order) {
  for (const layout::CellOrder& order : layout::all_orders()) {
    const result::CheckedSet set = verdict_on(dump_of(made(), made().truth, order));
    EXPECT_EQ(set.verdict, "right") << order.axes;
    EXPECT_EQ(set.error->lost_pairs, 0u);
    EXPECT_EQ(set.error->false_positives, 0u);
    EXPECT_EQ(set.error->true_pairs, made().truth.pair_count());
  }
}

TEST(PlantedFaults, a_light_removed_where_it_reaches_deepest_is_named_with_its_cell) {
  const Deepest deepest = deepest_pair();
  const result::CheckedSet set = verdict_on(dump_of(made(), changed(made().truth, [&](auto cell, auto light) -> Moved {
                                                      if (cell == deepest.cell && light == deepest.light)
                                                        return std::nullopt;
                                                      return std::pair(cell, light);
                                                    })));
  EXPECT_EQ(set.verdict, "lost");
  ASSERT_EQ(set.lost.size(), 1u);
  EXPECT_EQ(set.lost[0].light, deepest.light);
  EXPECT_EQ(set.lost[0].row, deepest.cell);
  const Vec3i at = made().grid.cell_at(deepest.cell);
  EXPECT_EQ(set.lost[0].cell[2], static_cast<std::uint64_t>(at.z));
  EXPECT_NEAR(set.lost[0].reach_percent, 100.0 * deepest.reach, 1e-6);
  EXPECT_NEAR(set.lost[0].reach_mm, 4000.0 * deepest.reach, 1e-4);
  EXPECT_FALSE(set.other_reading) << "one pair is no other order";
}

struct PlantedRow {
  const char* name;
  std::function<Moved(std::uint32_t cell, std::uint32_t light)> plant;
  bool loses_all_of_one = false;
};

TEST(PlantedFaults, each_is_found) {
  const auto cells_of_slice = static_cast<std::uint32_t>(made().grid.cells().x * made().grid.cells().y);
  const std::uint32_t cells = made().truth.cell_count(), columns = static_cast<std::uint32_t>(made().grid.cells().x);
  const PlantedRow rows[] = {
      {"indices off by one",
       [](auto cell, auto light) -> Moved { return std::pair(cell, light == 0 ? 199 : light - 1); }},
      {"slice 5 shifted to 6",
       [&](auto cell, auto light) -> Moved {
         return std::pair(cell / cells_of_slice == 5 ? cell + cells_of_slice : cell, light);
       }},
      {"all slices shifted",
       [&](auto cell, auto light) -> Moved { return std::pair((cell + cells_of_slice) % cells, light); }},
      {"one column to the right", [&](auto cell, auto light) -> Moved { return std::pair((cell + 1) % cells, light); }},
      {"the last column is forgotten",
       [&](auto cell, auto light) -> Moved {
         if (cell % columns == columns - 1) return std::nullopt;
         return std::pair(cell, light);
       }},
      {"one light is in no list",
       [](auto cell, auto light) -> Moved {
         if (light == made().truth.lights[0]) return std::nullopt;
         return std::pair(cell, light);
       },
       true},
      {"spots are not assigned",
       [](auto cell, auto light) -> Moved {
         if (made().frame.ranges().is_spot(light)) return std::nullopt;
         return std::pair(cell, light);
       }},
      {"only four lights fit into a cell", [](auto cell, auto light) -> Moved {
         static std::uint32_t last_cell = ~0u, count = 0;
         if (cell != last_cell) count = 0;
         last_cell = cell;
         if (++count > 4) return std::nullopt;
         return std::pair(cell, light);
       }}};
  for (const PlantedRow& row : rows) {
    const assign::Lists lists = changed(made().truth, row.plant);
    std::uint64_t lost = 0;
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
      for (const std::uint32_t light : made().truth.of(cell))
        lost += !std::ranges::binary_search(lists.of(cell), light);
    const result::CheckedSet set = verdict_on(dump_of(made(), lists));
    EXPECT_EQ(set.verdict, "lost") << row.name;
    ASSERT_TRUE(set.error) << row.name;
    EXPECT_GT(lost, 0u) << row.name;
    EXPECT_EQ(set.error->lost_pairs, lost) << row.name;
    EXPECT_EQ(set.error->absent_lights == 1, row.loses_all_of_one) << row.name;
  }
}

TEST(PlantedFaults, a_wrong_order_of_cells_is_said_before_its_losses) {
  for (const layout::CellOrder& real : layout::all_orders()) {
    if (real == layout::CellOrder{}) continue;
    DumpFile dump = dump_of(made(), made().truth, real);
    dump.record.grid.axes.reset();
    dump.record.grid.first_row.reset();
    dump.record.grid.first_slice.reset();
    const result::CheckedDump checked = judge(dump, {.with_methods = false});
    const result::CheckedSet& set = checked.sets.front();
    ASSERT_TRUE(set.other_reading) << real.axes;
    EXPECT_EQ(set.verdict, "misread");
    EXPECT_EQ(set.other_reading->axes, real.axes);
    EXPECT_EQ(set.other_reading->first_row == "bottom", real.is_from_bottom);
    EXPECT_EQ(set.other_reading->first_slice == "far", real.is_from_far);
    EXPECT_EQ(set.other_reading->lost_pairs, 0u);
    const std::string text = check_text(checked, 10);
    EXPECT_LT(text.find("Probably it is the description"), text.find("LOST")) << text;
  }
}

TEST(PlantedFaults, the_other_handedness_and_transposed_matrices_are_found) {
  DumpFile turned = dump_of(made(), made().truth);
  turned.record.camera.forward = "+z";
  EXPECT_EQ(verdict_on(turned).verdict, "misread");
  ASSERT_TRUE(verdict_on(turned).other_reading);
  EXPECT_EQ(verdict_on(turned).other_reading->camera, "camera.forward: the other way");

  // At the origin of the world a transposed view matrix is one, too.
  Made here = made_frame();
  for (scene::WorldLight& light : here.frame.lights) light.position -= here.frame.view_space.origin;
  here.frame.view_space.origin = Vec3d(0.0);
  here.truth = measure::find_truth(here.frame, here.grid, 1).lists;
  DumpFile transposed = dump_of(here, here.truth);
  EXPECT_EQ(verdict_on(transposed).verdict, "right");
  transposed.record.camera.order = "rows";
  ASSERT_TRUE(verdict_on(transposed).other_reading);
  EXPECT_EQ(verdict_on(transposed).other_reading->camera, "camera.order: the matrices transposed");
}

TEST(PlantedFaults, rows_of_pixels_that_are_counted_from_the_other_end_are_found) {
  const Made pixels = made_frame({{100, 100}, {0, 0}, 0.0});  // 720 is no multiple of 100
  DumpFile dump = dump_of(pixels, pixels.truth);
  EXPECT_EQ(verdict_on(dump).verdict, "right");
  dump.record.grid.first_row = "bottom";
  const result::CheckedSet set = verdict_on(dump);
  ASSERT_TRUE(set.other_reading);
  EXPECT_EQ(set.other_reading->first_row, "top");
  EXPECT_EQ(set.other_reading->lost_pairs, 0u);
}

TEST(PlantedFaults, a_light_that_is_lost_within_rounding_is_told_apart) {
  Made one = made_frame();
  one.frame.lights.resize(1);
  one.frame.count_types();
  scene::WorldLight& light = one.frame.lights[0];
  // A ball in front of the camera that ends a hair beyond the end of slice 4.
  const float end = one.grid.screen().slices.boundaries[5];
  const Vec3d ahead = -glm::transpose(one.frame.view_space.rotation)[2];
  for (const auto& [beyond_m, wanted] : {std::pair(1e-7, "rounding"), std::pair(1e-2, "lost")}) {
    light.range_m = 1.0;
    light.position = one.frame.view_space.origin + (static_cast<double>(end) - 1.0 + beyond_m) * ahead;
    one.truth = measure::find_truth(one.frame, one.grid, 1).lists;
    const result::CheckedSet set = verdict_on(dump_of(one, changed(one.truth, [&](auto cell, auto of) -> Moved {
                                                        if (one.grid.cell_at(cell).z == 5) return std::nullopt;
                                                        return std::pair(cell, of);
                                                      })));
    EXPECT_EQ(set.verdict, wanted);
    ASSERT_FALSE(set.lost.empty());
    EXPECT_NEAR(set.lost[0].reach_mm, 1000.0 * beyond_m, 1e-6);
  }
}

// A spot that shines along slices, whose cone enters slice 5 with its side alone.
TEST(PlantedFaults, a_spot_reaches_in_by_the_side_of_its_cone_and_not_by_its_range) {
  Made one = made_frame();
  scene::WorldLight spot =
      *std::ranges::find_if(one.frame.lights, [](const auto& light) { return light.type == scene::LightType::spot; });
  const Mat3d to_world = glm::transpose(one.frame.view_space.rotation);
  const double end = one.grid.screen().slices.boundaries[5];
  spot.range_m = 1.0;
  spot.outer_cone_rad = 0.3;
  for (const auto& [side_m, wanted] : {std::pair(1e-8, "rounding"), std::pair(0.01, "lost")}) {
    // Its side towards the slice runs along the slice's boundary, this far behind it.
    spot.position = one.frame.view_space.origin + to_world * Vec3d(0.0, 0.0, -(end + side_m));
    spot.direction = to_world * Vec3d(std::cos(0.3), 0.0, std::sin(0.3));
    one.frame.lights = {spot};
    one.frame.count_types();
    one.truth = measure::find_truth(one.frame, one.grid, 1).lists;
    const result::CheckedSet set = verdict_on(dump_of(one, changed(one.truth, [&](auto cell, auto of) -> Moved {
                                                        if (one.grid.cell_at(cell).z == 5) return std::nullopt;
                                                        return std::pair(cell, of);
                                                      })));
    EXPECT_EQ(set.verdict, wanted) << side_m;
    ASSERT_FALSE(set.lost.empty());
    EXPECT_NEAR(set.lost[0].reach_mm, 1000.0 * side_m, 1e-3 + 10.0 * side_m) << side_m;
  }
}

TEST(PlantedFaults, long_lists_that_lose_nothing_are_right_in_any_grid) {
  for (const grid::Tiling tiles : {grid::Tiling{{100, 100}, {0, 0}, 0.0}, grid::Tiling{{0, 0}, {12, 7}, 0.0}}) {
    const Made made = made_frame(tiles);
    assign::Lists all{{0}, {}};
    for (std::uint32_t cell = 0; cell < made.truth.cell_count(); ++cell) {
      for (std::uint32_t light = 0; light < made.frame.lights.size(); ++light) all.lights.push_back(light);
      all.begin.push_back(static_cast<std::uint32_t>(all.lights.size()));
    }
    const result::CheckedSet set = verdict_on(dump_of(made, all));
    EXPECT_EQ(set.verdict, "right");
    EXPECT_FALSE(set.other_reading);
    EXPECT_GT(set.error->false_positives, 9 * set.error->true_pairs) << "as a list of another camera's frame has";
  }
}

TEST(PlantedFaults, a_camera_that_sees_no_light_checks_nothing) {
  Made away = made_frame();
  away.frame.view_space.origin.z += 1000.0;
  away.frame.view_space.rotation = Mat3d(Vec3d(-1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, -1));
  away.truth = measure::find_truth(away.frame, away.grid, 1).lists;
  ASSERT_EQ(away.truth.pair_count(), 0u);
  const result::CheckedDump empty = judge(dump_of(away, away.truth), {.with_methods = false});
  EXPECT_EQ(empty.sets[0].verdict, "empty");
  EXPECT_EQ(worst_verdict({empty}), "empty");
  const result::CheckedDump right = judge(dump_of(made(), made().truth), {.with_methods = false});
  EXPECT_EQ(worst_verdict({right, empty}), "right") << "one of many frames may see none";
  EXPECT_EQ(judge(dump_of(away, made().truth), {.with_methods = false}).sets[0].verdict, "empty");
  EXPECT_EQ(worst_verdict({right, judge(dump_of(away, made().truth), {.with_methods = false})}), "empty");
}

TEST(PlantedFaults, a_light_twice_in_a_list_is_told_and_lists_are_judged_all_the_same) {
  DumpFile dump = dump_of(made(), made().truth);
  dump.record.lists.push_back(dump.record.lists.front());
  const result::CheckedSet set = verdict_on(dump);
  EXPECT_EQ(set.verdict, "twice");
  EXPECT_EQ(set.error->lost_pairs, 0u);
  EXPECT_GT(set.reading.fault_count, 0u);
  dump.record.lists.back().set = "transparent";
  EXPECT_EQ(verdict_on(dump).verdict, "right") << "sets are judged apart";
}

}  // namespace
}  // namespace clusterbench::dump
