#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "assign/contract/assigner_run.h"
#include "assign/contract/storage.h"
#include "core/memory.h"
#include "depth/depth_image.h"
#include "geom/light_meets_cell.h"
#include "grid/grid.h"
#include "library/assign.h"
#include "library/cases.h"

namespace clusterbench::library {
namespace {

using testing::copy_of;
using testing::engine_frame;
using testing::EngineFrame;
using testing::FrameForMethod;
using testing::frustum_grid;
using testing::grid_cases;
using testing::GridCase;
using testing::lists_of;
using testing::made_lists;
using testing::program_frame;
using testing::settings_for;

struct ProgramLists {
  grid::Grid grid;
  view::Frame frame;
  assign::Lists lists;
};

ProgramLists program_lists(const grid::GridSpec& spec, const EngineFrame& engine,
                           const assign::AssignerDescriptor& method) {
  ProgramLists made;
  made.frame = program_frame(engine);
  made.grid = grid::make_grid(spec, grid::grid_inputs(spec, made.frame, 0.0, Vec3d(0.0), Vec3d(0.0)));
  assign::AssignerRun run(method, assign::Params(method.params), assign::Answer::lists);
  run.build(made.grid);
  const view::LightArrays arrays = view::lights_in(made.frame, grid::space_of(made.grid, made.frame));
  run.assign({made.frame, arrays});
  made.lists = *run.filled_lists();
  return made;
}

TEST(LightLists, are_those_of_the_program_for_every_method_and_grid) {
  int compared = 0;
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors()) {
    if (row->make == nullptr || row->needs.depth) continue;
    for (const GridCase& grid : grid_cases()) {
      if (!row->takes(grid.spec.kind)) continue;
      EngineFrame frame = engine_frame(120, 7, row->boxes);
      if (!row->spots) frame.spots.clear();
      if (!row->points) frame.points.clear();
      const assign::Lists expected = program_lists(grid.spec, frame, *row).lists;
      EXPECT_EQ(made_lists(settings_for(grid.grid, row->name), frame), expected)
          << row->name << " " << grid.spec.name();
      compared += expected.pair_count() > 0;
    }
  }
  EXPECT_GT(compared, 40);
}

// Every pair decided by the truth's own code, which no method uses for all of its pairs.
TEST(LightLists, of_exact_fast_are_exactly_the_lights_that_reach_the_cells) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const EngineFrame frame = engine_frame(200, seed);
    Grid grid = frustum_grid();
    grid.columns = 8, grid.rows = 5, grid.slices = 8;
    grid::GridSpec spec = grid_cases()[0].spec;
    spec.tiles.count = {8, 5};
    spec.slices.count = 8;
    const ProgramLists program = program_lists(spec, frame, *assign::find_assigner("brute-force"));
    const assign::Lists exact = made_lists(settings_for(grid, "exact-fast"), frame);
    std::uint64_t pairs = 0;
    for (std::uint32_t cell = 0; cell < program.grid.cell_count(); ++cell)
      for (std::uint32_t light = 0; light < program.frame.lights.size(); ++light) {
        const geom::LightVolume volume = view::volume_of(program.frame.lights[light], program.frame.view_space);
        const bool is_true = geom::decide_meets(volume, program.grid.cell(cell)) == geom::Verdict::yes;
        const bool is_listed = std::ranges::count(exact.of(cell), light) == 1;
        ASSERT_EQ(is_listed, is_true) << "light " << light << ", cell " << cell << ", seed " << seed;
        pairs += is_true;
      }
    EXPECT_EQ(pairs, exact.pair_count());
    EXPECT_GT(pairs, 100u);
    EXPECT_GT(program.lists.pair_count(), pairs);
  }
}

// The z of everything in the world mirrored, as a left-handed engine has it.
TEST(LightLists, of_a_left_handed_world_are_those_of_the_right_handed_one) {
  for (const char* method : {"exact-fast", "exact", "brute-force", "sphere-refinement-fast", "box-separating-axis"}) {
    EngineFrame frame = engine_frame(300, 11, std::string_view(method).starts_with("box"));
    if (std::string_view(method).starts_with("box")) frame.points.clear(), frame.spots.clear();
    const Settings settings = settings_for(frustum_grid(), method);
    const assign::Lists right_handed = made_lists(settings, frame);
    const auto mirror = [](auto& point) { point[2] = -point[2]; };
    for (PointLight& point : frame.points) mirror(point.position);
    for (SpotLight& spot : frame.spots) mirror(spot.position), mirror(spot.direction);
    for (Box& box : frame.boxes) {
      mirror(box.center);
      for (auto& axis : box.half_axes) mirror(axis);
    }
    View& view = frame.view;
    mirror(view.eye), mirror(view.to_right), mirror(view.to_top), mirror(view.forward);
    EXPECT_EQ(made_lists(settings, frame), right_handed) << method;
    EXPECT_GT(right_handed.pair_count(), 50u) << method;
  }
}

TEST(LightLists, hold_storages_of_the_same_lists) {
  const EngineFrame frame = engine_frame(200, 5);
  for (const std::string_view storage : storages()) {
    Settings settings = settings_for(frustum_grid(), "exact-fast");
    settings.storage = storage;
    LightLists lists;
    ASSERT_TRUE(lists.start(settings)) << lists.error();
    ASSERT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
    const auto* row = assign::find_storage(std::string(storage));
    const auto made = row->make(assign::Params(row->params));
    const view::LightRanges ranges = program_frame(frame).ranges();
    made->start(static_cast<std::uint32_t>(16 * 9 * 24), ranges);
    made->store(lists_of(lists));
    const assign::ShaderBuffers expected = *made->shader_buffers();
    ASSERT_EQ(lists.buffers().size(), expected.buffers.size()) << storage;
    const auto needs = made->buffers();
    for (std::size_t i = 0; i < expected.buffers.size(); ++i) {
      const Buffer& buffer = lists.buffers()[i];
      EXPECT_STREQ(buffer.name, expected.buffers[i].name);
      EXPECT_EQ(buffer.element_bytes, needs[i].element_bytes) << storage << " " << buffer.name;
      EXPECT_TRUE(std::ranges::equal(buffer.bytes, expected.buffers[i].bytes)) << storage << " " << buffer.name;
      EXPECT_GT(buffer.bytes.size(), 0u) << storage << " " << buffer.name;
    }
  }
}

TEST(LightLists, have_buffers_of_structures_and_lists_of_them_if_asked) {
  const EngineFrame frame = engine_frame(100, 5);
  for (const char* method : {"z-binning", "tile-ranges", "tile-spans"}) {
    Settings settings = settings_for(frustum_grid(), method);
    for (const bool wants_lists : {false, true}) {
      settings.wants_lists_of_structures = wants_lists;
      LightLists lists;
      ASSERT_TRUE(lists.start(settings)) << lists.error();
      ASSERT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
      EXPECT_GE(lists.buffers().size(), 2u) << method;
      EXPECT_EQ(lists.begins().size(), wants_lists ? 16u * 9u * 24u + 1u : 0u) << method;
    }
  }
}

// --- Structures of a method's own ---

// The lists of a method with a structure of its own, against what its own structure gives a shader at random points of
// the picture.
void expect_lists_of_samples(const assign::AssignerDescriptor& method, const GridCase& grid) {
  const FrameForMethod frame(method);
  Settings settings = settings_for(grid.grid, method.name);
  settings.wants_lists_of_structures = true;
  LightLists lists;
  if (!lists.start(settings)) {
    EXPECT_EQ(lists.error(), "wants_lists_of_structures: is true, and " + method.name +
                                 " has no lists of the grid's cells; allowed: false");
    return;
  }
  ASSERT_TRUE(lists.update(frame.engine.view, frame.engine.lights())) << lists.error();
  const Cells cells = lists.cells();
  ASSERT_EQ(lists.begins().size(), static_cast<std::size_t>(cells.x * cells.y * cells.z) + 1) << method.name;
  EXPECT_EQ(lists.begins().back(), lists.light_indices().size()) << method.name;

  const view::Frame program = program_frame(frame.engine);
  const grid::Grid made = grid::make_grid(grid.spec, grid::grid_inputs(grid.spec, program, 0, Vec3d(0), Vec3d(0)));
  assign::AssignerRun run(method, assign::Params(method.params), assign::Answer::structure);
  run.build(made);
  const view::LightArrays arrays = view::lights_in(program, grid::space_of(made, program));
  run.assign({program, arrays, &frame.depths});
  SplitMix64 random(8);
  std::vector<std::uint32_t> expected;
  std::size_t pairs = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto x = static_cast<float>(random.between(0, 1279)), y = static_cast<float>(random.between(0, 719));
    auto depth = static_cast<float>(random.between(0.2, 149.0));
    const float surface = frame.depths.nearest[static_cast<std::size_t>(y) * 1280 + static_cast<std::size_t>(x)];
    if (i % 2 == 0 && std::isfinite(surface)) depth = std::min(surface, 149.0f);
    const Vec3d at = view::picture_ray(program, {x, y}).at(depth);
    run.structure()->lights_at({x, y, Vec3f(at), Vec3d(0.0), Vec3d(0.0)}, grid::Log2::rounded, expected);
    const std::int64_t cell = lists.cell_at(x, y, depth);
    ASSERT_GE(cell, 0);
    std::vector<std::uint32_t> listed = copy_of(lists.of(static_cast<std::uint32_t>(cell)));
    std::ranges::sort(listed);
    std::ranges::sort(expected);
    ASSERT_EQ(listed, expected) << method.name << " at " << x << ", " << y << ", " << depth;
    pairs += listed.size();
  }
  EXPECT_GT(pairs, 0u) << method.name;
}

TEST(LightLists, of_structures_are_the_lights_that_a_shader_finds_in_the_cell) {
  int refused = 0;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors()) {
    if (method->make != nullptr) continue;
    ASSERT_TRUE(method->takes(grid::Kind::frustum)) << method->name;
    expect_lists_of_samples(*method, grid_cases()[0]);
    Settings settings = settings_for(grid_cases()[0].grid, method->name);
    settings.wants_lists_of_structures = true;
    refused += !LightLists().start(settings);
  }
  EXPECT_EQ(refused, 3);  // tile-slices, deferred, naive-tile-size
}

TEST(LightLists, take_depths_for_methods_that_need_them) {
  EngineFrame frame = engine_frame(100, 5);
  LightLists lists;
  ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "tiled"))) << lists.error();
  EXPECT_FALSE(lists.update(frame.view, frame.lights()));
  EXPECT_EQ(lists.error(), "view.depths: are 0, and this method needs one for each of 921600 pixels");
  std::vector<float> depths(921600, 20.0f);
  frame.view.depths = depths;
  for (const float bad : {-1.0f, -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    depths[77] = bad;
    EXPECT_FALSE(lists.update(frame.view, frame.lights()));
    EXPECT_TRUE(lists.error().ends_with("; allowed: 0 m or more, and +inf without a surface")) << lists.error();
  }
  depths[77] = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
  EXPECT_GE(lists.buffers().size(), 2u);
}

TEST(LightLists, go_on_after_a_frame_that_failed) {
  const EngineFrame good = engine_frame(60, 5);
  EngineFrame bad = good;
  bad.points[1].range = -2.0f;
  Settings settings = settings_for(frustum_grid(), "exact-fast");
  settings.storage = "packed";
  LightLists lists;
  ASSERT_TRUE(lists.start(settings));
  ASSERT_TRUE(lists.update(good.view, good.lights()));
  const assign::Lists expected = lists_of(lists);
  EXPECT_FALSE(lists.update(bad.view, bad.lights()));
  EXPECT_TRUE(lists.buffers().empty());
  ASSERT_TRUE(lists.update(good.view, good.lights()));
  EXPECT_EQ(lists_of(lists), expected);
  EXPECT_EQ(lists.buffers().size(), 2u);
}

TEST(LightLists, that_would_need_more_than_the_limit_on_memory_fail) {
  const std::uint64_t before = memory_limit();
  const EngineFrame frame = engine_frame(2000, 5);
  LightLists lists;
  ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "brute-force")));
  set_memory_limit(10'000);
  EXPECT_FALSE(lists.update(frame.view, frame.lights()));
  EXPECT_TRUE(lists.error().starts_with("set_memory_limit: ")) << lists.error();
  EXPECT_NE(lists.error().find("KiB, and 9 KiB are allowed"), std::string_view::npos) << lists.error();
  set_memory_limit(before);
  EXPECT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
}

TEST(LightLists, that_were_not_started_or_moved_from_answer_nothing) {
  LightLists lists;
  EXPECT_EQ(lists.error(), "");
  EXPECT_FALSE(lists.update({}, {}));
  EXPECT_EQ(lists.error(), "update: was called before a start() that did not fail");
  EXPECT_EQ(lists.cells().x + static_cast<int>(lists.begins().size() + lists.buffers().size() + lists.of(0).size()), 0);
  EXPECT_EQ(lists.memory_bytes() + lists.builds() + lists.dropped_pairs(), 0u);
  ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "exact-fast")));
  EXPECT_EQ(lists.lookup().boundaries.size(), 0u);
  LightLists moved = std::move(lists);
  const EngineFrame frame = engine_frame(30, 5);
  EXPECT_TRUE(moved.update(frame.view, frame.lights()));
  EXPECT_EQ(moved.of(1u << 30).size(), 0u);
}

TEST(LightLists, count_the_pairs_that_fixed_drops) {
  const EngineFrame frame = engine_frame(500, 5);
  const Parameter cap("cap", 2);
  Settings settings = settings_for(frustum_grid(), "exact-fast");
  settings.storage = "fixed";
  settings.storage_parameters = {&cap, 1};
  LightLists lists;
  ASSERT_TRUE(lists.start(settings)) << lists.error();
  ASSERT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
  std::uint64_t dropped = 0;
  for (std::uint32_t cell = 0; cell < 16 * 9 * 24; ++cell)
    dropped += lists.of(cell).size() > 2 ? lists.of(cell).size() - 2 : 0;
  EXPECT_GT(dropped, 0u);
  EXPECT_EQ(lists.dropped_pairs(), dropped);
}

TEST(Names, are_those_of_the_program) {
  ASSERT_EQ(methods().size(), assign::assigner_names().size());
  EXPECT_TRUE(std::ranges::equal(methods(), assign::assigner_names()));
  EXPECT_TRUE(std::ranges::equal(storages(), assign::storage_names()));
}

}  // namespace
}  // namespace clusterbench::library
