#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <set>

#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

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
    const result::CheckedDump checked = judge(dump, {});
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
  EXPECT_EQ(verdict_on(transposed).other_reading->camera, "camera.order 'columns'");
}

// A perspective projection that looks along +z (sign 1) or -z (sign -1), by columns; its planes stay as they are.
void give_projection(const Made& of, double sign, result::DumpCamera& camera) {
  const view::Projection& p = of.frame.projection;
  const double width = p.right - p.left, height = p.top - p.bottom;
  camera.sides.reset();
  camera.orthographic.reset();
  camera.projection = {2.0 / width,
                       0,
                       0,
                       0,
                       0,
                       2.0 / height,
                       0,
                       0,
                       -sign * (p.right + p.left) / width,
                       -sign * (p.top + p.bottom) / height,
                       sign * 1.01,
                       sign,
                       0,
                       0,
                       -0.1,
                       0};
}

// Only what the camera has well in front of it.
Made in_front() {
  Made out = made_frame();
  std::erase_if(out.frame.lights, [&](const scene::WorldLight& light) {
    return (out.frame.view_space.rotation * (light.position - out.frame.view_space.origin)).z > -light.range_m - 1.0;
  });
  out.frame.count_types();
  out.truth = measure::find_truth(out.frame, out.grid, 1).lists;
  return out;
}

TEST(PlantedFaults, a_camera_of_the_other_handedness_throughout_is_found_where_it_sees_no_light) {
  const Made front = in_front();
  ASSERT_GT(front.truth.pair_count(), 100u);
  DumpFile both = dump_of(front, front.truth), row = both;
  give_projection(front, 1.0, both.record.camera);
  both.record.camera.forward = "+z";
  give_projection(front, -1.0, row.record.camera);
  EXPECT_EQ(verdict_on(row).verdict, "right");
  for (const std::size_t i : {8u, 9u, 10u}) row.record.camera.view_to_world->at(i) *= -1.0;
  for (const DumpFile& dump : {both, row}) {
    const result::CheckedDump checked = judge(dump, {});
    EXPECT_EQ(checked.sets[0].error->true_pairs, 0u);
    EXPECT_EQ(checked.sets[0].verdict, "misread");
    ASSERT_TRUE(checked.sets[0].other_reading);
    EXPECT_LE(checked.sets[0].other_reading->lost_pairs, 2u);
    const std::string text = check_text(checked, 3);
    EXPECT_LT(text.find("camera: the other handedness"), text.find("lists: no light is lost, but")) << text;
  }
}

TEST(PlantedFaults, a_mirrored_x_axis_is_found) {
  DumpFile dump = dump_of(made(), made().truth);
  for (const std::size_t i : {0u, 1u, 2u}) dump.record.camera.view_to_world->at(i) *= -1.0;
  const result::CheckedSet set = verdict_on(dump);
  EXPECT_EQ(set.verdict, "misread");
  ASSERT_TRUE(set.other_reading);
  EXPECT_EQ(set.other_reading->camera, "camera: the x row of world_to_view negated");
  EXPECT_LE(set.other_reading->lost_pairs, 2u);
}

// As of an engine that culls coarsely: each light in all cells that are a few columns and rows from its own.
assign::Lists grown(const Made& of, int columns, int rows) {
  const Vec3i cells = of.grid.cells();
  std::vector<std::set<std::uint32_t>> lists(of.truth.cell_count());
  for (std::uint32_t cell = 0; cell < of.truth.cell_count(); ++cell) {
    const Vec3i at = of.grid.cell_at(cell);
    const auto here = of.truth.of(cell);
    for (int z = 0; z < cells.z; ++z)
      for (int y = std::max(0, at.y - rows); y <= std::min(cells.y - 1, at.y + rows); ++y)
        for (int x = std::max(0, at.x - columns); x <= std::min(cells.x - 1, at.x + columns); ++x)
          lists[grid::cell_index({x, y, z}, cells)].insert(here.begin(), here.end());
  }
  assign::Lists out{{0}, {}};
  for (const std::set<std::uint32_t>& list : lists) {
    out.lights.insert(out.lights.end(), list.begin(), list.end());
    out.begin.push_back(static_cast<std::uint32_t>(out.lights.size()));
  }
  return out;
}

TEST(PlantedFaults, a_wrong_description_of_loose_lists_is_found_where_it_loses_pairs) {
  const DumpFile loose = dump_of(made(), grown(made(), 1, 1));
  const result::CheckedSet sound = verdict_on(loose);
  EXPECT_EQ(sound.verdict, "right");
  ASSERT_GT(10 * sound.error->false_positives, 9 * sound.error->listed_pairs);
  DumpFile mirrored = loose, rows = loose;
  for (const std::size_t i : {0u, 1u, 2u}) mirrored.record.camera.view_to_world->at(i) *= -1.0;
  rows.record.grid.first_row = "bottom";
  for (const auto& [dump, camera, row] :
       {std::tuple(&mirrored, "camera: the x row of world_to_view negated", "top"), std::tuple(&rows, "", "top")}) {
    const result::CheckedSet set = verdict_on(*dump);
    EXPECT_EQ(set.verdict, "misread");
    EXPECT_GT(set.error->lost_pairs, 100u);
    ASSERT_TRUE(set.other_reading);
    EXPECT_EQ(set.other_reading->camera, camera);
    EXPECT_EQ(set.other_reading->first_row, row);
    EXPECT_LE(set.other_reading->lost_pairs, set.error->lost_pairs / 100);
  }
  // A light that is in no list at all is lost under any description, however loose the lists are.
  const std::uint32_t forgotten = made().truth.lights[0];
  const DumpFile without = dump_of(made(), changed(grown(made(), 12, 7), [&](auto cell, auto light) -> Moved {
                                     if (light == forgotten) return std::nullopt;
                                     return std::pair(cell, light);
                                   }));
  EXPECT_EQ(verdict_on(without).verdict, "lost");
}

// Before the bits of the one light are those of 37 decals, which all cells have: read as the light's they lose nothing.
TEST(PlantedFaults, bits_of_other_things_are_no_better_reading_of_a_lost_light) {
  Made one = made_frame();
  one.frame.lights.resize(1);
  one.frame.count_types();
  scene::WorldLight& light = one.frame.lights[0];
  light.position =
      one.frame.view_space.origin - 4.0 * glm::transpose(one.frame.view_space.rotation)[2] + Vec3d(0.3, 0.2, 0.1);
  light.range_m = 1.5;
  one.truth = measure::find_truth(one.frame, one.grid, 1).lists;
  DumpFile dump = dump_of(one, one.truth);
  const Vec3i cells = one.grid.cells();
  layout::Buffer words{"words", "", 0, std::vector<std::byte>(4 + 8 * std::size_t{one.truth.cell_count()})};
  for (std::uint32_t cell = 0; cell < one.truth.cell_count(); ++cell) {
    Vec3i from = one.grid.cell_at(cell);
    from.z = (from.z + 4) % cells.z;  // each list in the slice four before its own
    const bool is_here = !one.truth.of(grid::cell_index(from, cells)).empty();
    for (std::size_t byte = 0; byte < 4; ++byte) words.bytes[4 + 8 * cell + byte] = std::byte{0xff};
    words.bytes[4 + 8 * cell + 4] = is_here ? std::byte{0x3f} : std::byte{0x1f};
  }
  dump.buffers.push_back(words);
  dump.record.lists = {{}};
  dump.record.lists[0].layout = "bits";
  dump.record.lists[0].first_bit = 37;
  dump.record.lists[0].rows = result::DumpRows{"words", 4, 8};
  const result::CheckedSet set = verdict_on(dump);
  ASSERT_GE(set.error->lost_pairs, 10u);
  ASSERT_EQ(set.error->false_positives, set.error->listed_pairs);
  EXPECT_EQ(set.verdict, "lost") << (set.other_reading ? set.other_reading->lists : "");
}

// Points ahead of the eye. Seen behind it they still reach into some of their cells, and into no others.
TEST(PlantedFaults, a_wrong_handedness_that_loses_nothing_is_found) {
  Made near = made_frame();
  near.frame.lights.resize(10);
  for (int i = 0; i < 10; ++i) {
    scene::WorldLight& light = near.frame.lights[static_cast<std::size_t>(i)];
    ASSERT_EQ(light.type, scene::LightType::point);
    const Vec3d seen{0.35 * i - 1.6, 0.3 * (i % 3) - 0.3, -2.2 - 0.1 * i};
    light.position = near.frame.view_space.origin + glm::transpose(near.frame.view_space.rotation) * seen;
    light.range_m = 4.0;
  }
  near.frame.count_types();
  near.truth = measure::find_truth(near.frame, near.grid, 1).lists;
  DumpFile dump = dump_of(near, near.truth);
  give_projection(near, -1.0, dump.record.camera);
  for (const std::size_t i : {8u, 9u, 10u}) dump.record.camera.view_to_world->at(i) *= -1.0;
  const result::CheckedDump checked = judge(dump, {});
  const result::CheckedSet& set = checked.sets[0];
  ASSERT_EQ(set.error->lost_pairs, 0u);
  ASSERT_GT(2 * set.error->false_positives, set.error->listed_pairs);
  ASSERT_LT(10 * set.error->false_positives, 9 * set.error->listed_pairs) << "of fewer than were tried once";
  EXPECT_EQ(set.verdict, "misread");
  ASSERT_TRUE(set.other_reading);
  EXPECT_NE(set.other_reading->camera.find("the other handedness"), std::string::npos);
  EXPECT_NE(check_text(checked, 3).find("Probably it is the description: with camera: the other handedness"),
            std::string::npos)
      << check_text(checked, 3);
}

TEST(PlantedFaults, the_inverse_of_the_view_matrix_is_found) {
  DumpFile dump = dump_of(made(), made().truth);
  std::swap(dump.record.camera.world_to_view, dump.record.camera.view_to_world);
  const result::CheckedSet set = verdict_on(dump);
  EXPECT_EQ(set.verdict, "misread");
  ASSERT_TRUE(set.other_reading);
  EXPECT_EQ(set.other_reading->camera.find("camera.view_to_world and camera.world_to_view: the other"), 0u);
  EXPECT_EQ(set.other_reading->order, "");
}

// The ranges of a dump's rows.
void change_ranges(DumpFile& dump, const std::function<double(double)>& change) {
  std::vector<std::byte>& bytes = std::ranges::find(dump.buffers, "lights", &layout::Buffer::name)->bytes;
  for (std::size_t at = 24; at < bytes.size(); at += 64) {
    double range_m = 0.0;
    std::memcpy(&range_m, &bytes[at], sizeof range_m);
    range_m = change(range_m);
    std::memcpy(&bytes[at], &range_m, sizeof range_m);
  }
}

TEST(PlantedFaults, ranges_that_are_something_else_are_found) {
  struct Row {
    std::function<double(double)> in_buffer;
    const char *is, *wanted;
  };
  const Row rows[] = {{[](double r) { return r * r; }, "range", "lights.rows range.is 'squared'"},
                      {[](double r) { return r; }, "inverse", "lights.rows range.is 'range'"},
                      {[](double r) { return 1.0 / r; }, "range", "lights.rows range.is 'inverse'"},
                      {[](double r) { return 1.0 / (r * r); }, "inverse", "lights.rows range.is 'inverse-squared'"},
                      {[](double r) { return 2.0 * r; }, "range", "ranges half as large"},
                      {[](double r) { return r / 2.0; }, "range", "ranges twice as large"}};
  for (const Row& row : rows) {
    DumpFile dump = dump_of(made(), made().truth);
    change_ranges(dump, row.in_buffer);
    for (result::DumpLightRows& lights : *dump.record.lights.rows) lights.range.is = row.is;
    const result::CheckedDump checked = judge(dump, {});
    EXPECT_EQ(checked.sets[0].verdict, "misread") << row.wanted;
    ASSERT_TRUE(checked.sets[0].other_reading) << row.wanted << check_text(checked, 1);
    EXPECT_EQ(checked.sets[0].other_reading->lights.find(row.wanted), 0u) << checked.sets[0].other_reading->lights;
    EXPECT_NE(check_text(checked, 1).find(row.wanted), std::string::npos);
  }
}

TEST(PlantedFaults, pairs_that_are_lost_where_a_list_is_full_are_told) {
  const assign::StorageDescriptor* fixed = assign::find_storage("fixed");
  constexpr std::uint32_t k_cap = 3;
  const auto storage = fixed->make(assign::Params(fixed->params, {{"cap", static_cast<double>(k_cap)}}));
  storage->start(made().truth.cell_count(), made().frame.ranges());
  storage->store(made().truth);
  MadeDump full = make_dump(made().frame, made().grid, *layout::describe(*storage->shader_buffers()), {});
  DumpFile dump{"made.json", std::move(full.record), std::move(full.buffers)};
  const Deepest deepest = deepest_pair();
  std::uint64_t dropped = 0;
  for (std::uint32_t cell = 0; cell < made().truth.cell_count(); ++cell)
    dropped += std::max<std::uint64_t>(made().truth.of(cell).size(), k_cap) - k_cap;
  ASSERT_GT(dropped, 0u);
  const result::CheckedDump checked = judge(dump, {});
  EXPECT_EQ(checked.sets[0].error->lost_pairs, dropped);
  EXPECT_EQ(checked.sets[0].error->lost_in_full_lists, dropped);
  EXPECT_NE(check_text(checked, 1).find(" lost in cells whose list is full (lists[].per_cell)"), std::string::npos)
      << check_text(checked, 1);
  const DumpFile packed = dump_of(made(), changed(made().truth, [&](auto cell, auto light) -> Moved {
                                    if (cell == deepest.cell && light == deepest.light) return std::nullopt;
                                    return std::pair(cell, light);
                                  }));
  EXPECT_EQ(verdict_on(packed).error->lost_in_full_lists, 0u);
}

// Whoever tells too small ranges loses nothing, and is told which would fit.
TEST(PlantedFaults, ranges_that_are_told_too_small_are_found) {
  Made small = made_frame();
  const assign::Lists listed = small.truth;
  for (scene::WorldLight& light : small.frame.lights) light.range_m = 0.5;
  const result::CheckedDump checked = judge(dump_of(small, listed), {}), sound = judge(dump_of(made(), listed), {});
  EXPECT_EQ(checked.sets[0].verdict, "misread");
  EXPECT_NE(check_text(checked, 3).find("with ranges 8 times as large most listed pairs are true"), std::string::npos);
  EXPECT_EQ(sound.sets[0].verdict, "right");
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
  const result::CheckedDump empty = judge(dump_of(away, away.truth), {});
  EXPECT_EQ(empty.sets[0].verdict, "empty");
  EXPECT_EQ(worst_verdict({empty}), "empty");
  const result::CheckedDump right = judge(dump_of(made(), made().truth), {});
  EXPECT_EQ(worst_verdict({right, empty}), "right") << "one of many frames may see none";
  EXPECT_EQ(judge(dump_of(away, made().truth), {}).sets[0].verdict, "empty");
  EXPECT_EQ(worst_verdict({right, judge(dump_of(away, made().truth), {})}), "empty");
}

// A set of the exact lists twice.
DumpFile doubled() {
  DumpFile dump = dump_of(made(), made().truth);
  dump.record.lists.push_back(dump.record.lists.front());
  return dump;
}

TEST(PlantedFaults, lights_twice_in_a_list_are_told_and_lists_are_judged_all_the_same) {
  DumpFile dump = doubled();
  const result::CheckedSet set = verdict_on(dump);
  EXPECT_EQ(set.verdict, "twice");
  EXPECT_EQ(set.error->lost_pairs, 0u);
  EXPECT_EQ(set.reading.fault_count, 0u);
  EXPECT_EQ(set.reading.twice_count, made().truth.pair_count());
  ASSERT_FALSE(set.reading.twice.empty());
  EXPECT_EQ(set.reading.twice[0].buffer, "indices");
  dump.record.lists.back().set = "transparent";
  EXPECT_EQ(verdict_on(dump).verdict, "right") << "sets are judged apart";
}

TEST(PlantedFaults, lights_twice_hide_neither_a_lost_light_nor_an_index_that_cannot_be) {
  DumpFile lost = doubled();
  layout::Buffer& headers = *std::ranges::find(lost.buffers, "headers", &layout::Buffer::name);
  std::size_t cell = 0;
  while (made().truth.of(static_cast<std::uint32_t>(cell)).size() < 3) ++cell;
  for (std::size_t byte = 4; byte < 8; ++byte) headers.bytes[8 * cell + byte] = std::byte{0};  // both counts
  const result::CheckedDump checked = judge(lost, {});
  EXPECT_EQ(checked.sets[0].verdict, "lost");
  EXPECT_NE(check_text(checked, 3).find("pairs of a cell and a light are twice in their lists:\n"), std::string::npos)
      << check_text(checked, 3);

  DumpFile wrong = doubled();
  layout::Buffer& indices = *std::ranges::find(wrong.buffers, "indices", &layout::Buffer::name);
  indices.bytes.back() = std::byte{0xff};
  const result::CheckedSet set = verdict_on(wrong);
  EXPECT_EQ(set.verdict, "unreadable");
  EXPECT_EQ(set.reading.fault_count, 2u) << "once for each part";
  ASSERT_FALSE(set.reading.faults.empty());
  EXPECT_EQ(set.reading.faults[0].buffer, "indices");
}

TEST(PlantedFaults, a_wrong_width_that_can_be_read_is_told_as_such) {
  DumpFile dump = dump_of(made(), made().truth);
  result::DumpEntries& entries = *dump.record.lists[0].entries;
  ASSERT_EQ(entries.type, "u8");
  std::vector<std::byte>& indices = std::ranges::find(dump.buffers, "indices", &layout::Buffer::name)->bytes;
  std::vector<std::byte> wide(4 * indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) wide[4 * i] = indices[i];
  indices = wide;
  entries.type = "u32";
  EXPECT_EQ(verdict_on(dump).verdict, "right");
  for (const char* wrong : {"u16", "u8"}) {
    entries.type = wrong;  // every other index is 0, or three of four
    const result::CheckedDump checked = judge(dump, {});
    const result::CheckedSet& set = checked.sets[0];
    EXPECT_EQ(set.verdict, "misread") << wrong;
    ASSERT_TRUE(set.other_reading) << wrong;
    EXPECT_EQ(set.other_reading->lists, "entries as u32");
    EXPECT_EQ(set.other_reading->lost_pairs, 0u);
    const std::string text = check_text(checked, 3);
    EXPECT_NE(text.find("Probably it is the description: with entries as u32, 0 pairs would be lost in place of "),
              std::string::npos)
        << text;
  }
}

TEST(OurMethods, are_left_out_and_named_where_they_would_take_long) {
  Made small = made_frame();  // few pairs: the cells are many enough
  for (scene::WorldLight& light : small.frame.lights) light.range_m = 0.3;
  small.truth = measure::find_truth(small.frame, small.grid, 1).lists;
  DumpFile dump = dump_of(small, small.truth);
  const result::CheckedDump quick = judge(dump, {.methods = method_choice("quick")});
  EXPECT_GE(quick.methods.size(), 5u);
  EXPECT_TRUE(quick.methods_left_out.empty());
  // Five million cells, all empty.
  dump.record.grid.tiles->count = {160, 90};
  dump.record.grid.slices = result::DumpSlices{};
  dump.record.grid.slices->scheme = "linear";
  dump.record.grid.slices->count = 350;
  dump.record.grid.slices->far_m = 50.0;
  dump.record.lists = {{}};
  dump.record.lists[0].layout = "bits";
  dump.record.lists[0].per_tile = true;
  dump.record.lists[0].rows = result::DumpRows{"tiles", {}, 28};
  dump.buffers.push_back({"tiles", "", 0, std::vector<std::byte>(std::size_t{28} * 160 * 90)});
  const result::CheckedDump large = judge(dump, {.methods = method_choice("quick")});
  EXPECT_TRUE(large.methods.empty());
  EXPECT_EQ(large.methods_left_out.size(), quick.methods.size());
  const std::string text = check_text(large, 0);
  EXPECT_NE(text.find("methods of clusterbench left out"), std::string::npos) << text;
  EXPECT_NE(text.find("exact-fast"), std::string::npos) << text;
  const result::CheckedDump named = judge(dump, {.methods = method_choice("exact-fast")});
  ASSERT_EQ(named.methods.size(), 1u);
  EXPECT_EQ(named.methods[0].listed_pairs, named.sets[0].error->true_pairs);
}

}  // namespace
}  // namespace clusterbench::dump
