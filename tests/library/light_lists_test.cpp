#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cfenv>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>

#include "assign/allocations.h"
#include "assign/contract/assigner_run.h"
#include "assign/contract/storage.h"
#include "depth/depth_image.h"
#include "geom/light_meets_cell.h"
#include "library/assign.h"
#include "library/engine_frame.h"
#include "places.h"
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace clusterbench::library {
namespace {

using testing::engine_frame;
using testing::EngineFrame;
using testing::program_frame;

Grid frustum_grid() {
  Grid grid;
  grid.columns = 16, grid.rows = 9, grid.slices = 24;
  grid.slicing = Grid::Slicing::exponential;
  return grid;
}

struct GridCase {
  Grid grid;
  grid::GridSpec spec;
};

// The same grids, as an engine asks for them and as a configuration does.
std::vector<GridCase> grid_cases() {
  std::vector<GridCase> cases;
  {
    GridCase& by_count = cases.emplace_back();
    by_count.grid = frustum_grid();
    by_count.spec.tiles = {{0, 0}, {16, 9}};
    by_count.spec.slices.scheme = grid::Scheme::exponential;
    by_count.spec.slices.count = 24;
  }
  {
    GridCase& by_pixels = cases.emplace_back();
    by_pixels.grid.far_m = 90.0;
    by_pixels.spec.slices.far_m = 90.0;
  }
  {
    static constexpr double k_boundaries[] = {0.1, 3.0, 20.0, 100.0};
    GridCase& list = cases.emplace_back();
    list.grid.slicing = Grid::Slicing::list;
    list.grid.boundaries_m = k_boundaries;
    list.spec.slices.scheme = grid::Scheme::list;
    list.spec.slices.boundaries_m = {0.1, 3.0, 20.0, 100.0};
  }
  {
    GridCase& distance = cases.emplace_back();
    distance.grid.kind = Grid::Kind::distance;
    distance.grid.slicing = Grid::Slicing::power;
    distance.grid.lambda = 0.7;
    distance.spec.kind = grid::Kind::distance;
    distance.spec.slices.scheme = grid::Scheme::power;
    distance.spec.slices.lambda = 0.7;
  }
  {
    GridCase& cascades = cases.emplace_back();
    cascades.grid.kind = Grid::Kind::cascades;
    cascades.grid.levels = 4;
    cascades.spec.kind = grid::Kind::cascades;
    cascades.spec.cells = {16, 16, 16};
    cascades.spec.levels = 4;
  }
  {
    GridCase& world = cases.emplace_back();
    world.grid.kind = Grid::Kind::world;
    world.spec.kind = grid::Kind::world;
    world.spec.cells = {16, 16, 16};
    world.spec.has_bounds = true;
    for (int i = 0; i < 3; ++i) {
      world.grid.lo_m[i] = -50.0 - i, world.grid.hi_m[i] = 55.0 + i;
      world.spec.bounds_lo_m[i] = -50.0 - i, world.spec.bounds_hi_m[i] = 55.0 + i;
    }
  }
  return cases;
}

std::vector<std::uint32_t> copy_of(std::span<const std::uint32_t> numbers) {
  return {numbers.begin(), numbers.end()};
}

assign::Lists lists_of(const LightLists& made) {
  return {copy_of(made.begins()), copy_of(made.light_indices())};
}

Settings settings_for(const Grid& grid, std::string_view method) {
  Settings settings;
  settings.grid = grid;
  settings.method = method;
  return settings;
}

// The lists of a frame; fails the test with the reason if there are none.
assign::Lists made_lists(const Settings& settings, const EngineFrame& frame) {
  LightLists lists;
  EXPECT_TRUE(lists.start(settings)) << lists.error();
  EXPECT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
  return lists_of(lists);
}

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

// A frame of lights that the method takes, with the depths that it may need.
struct FrameForMethod {
  EngineFrame engine;
  depth::DepthImage depths;

  explicit FrameForMethod(const assign::AssignerDescriptor& method) : engine(engine_frame(150, 5)) {
    if (!method.spots) engine.spots.clear();
    if (!method.points) engine.points.clear();
    depths = depth::seeded_depths(program_frame(engine), 4);
    engine.view.depths = depths.nearest;
  }
};

Grid grid_for(const assign::AssignerDescriptor& method) {
  for (const GridCase& each : grid_cases())
    if (each.spec.kind == method.kinds.front()) return each.grid;
  ADD_FAILURE() << "no grid for " << method.name;
  return {};
}

// The names between two texts of the header, without its comment signs.
std::vector<std::string> names_in_header(const std::string& from, const std::string& to) {
  std::ifstream file(test::source_dir() + "/src/library/assign.h");
  const std::string header{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = header.find(from), end = header.find(to, begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::vector<std::string> names;
  std::string name;
  for (const char c : header.substr(begin + from.size(), end - begin - from.size()) + ",") {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.') name += c;
    if (c == ',') names.push_back(std::exchange(name, ""));
  }
  std::ranges::sort(names);
  return names;
}

TEST(LightLists, have_buffers_and_take_storages_as_the_header_lists_the_methods) {
  std::vector<std::string> shown, unshown;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors()) {
    const FrameForMethod frame(*method);
    Settings settings = settings_for(grid_for(*method), method->name);
    LightLists lists;
    ASSERT_TRUE(lists.start(settings)) << method->name << " " << lists.error();
    ASSERT_TRUE(lists.update(frame.engine.view, frame.engine.lights())) << method->name << " " << lists.error();
    const bool has_lists = !lists.begins().empty(), has_buffers = !lists.buffers().empty();
    if (!has_lists) (has_buffers ? shown : unshown).push_back(method->name);
    settings.storage = "packed";
    EXPECT_EQ(lists.start(settings), has_lists) << method->name;
    if (!has_lists) continue;
    EXPECT_FALSE(has_buffers) << method->name;
    ASSERT_TRUE(lists.update(frame.engine.view, frame.engine.lights())) << method->name << " " << lists.error();
    EXPECT_EQ(lists.buffers().size(), 2u) << method->name;
  }
  std::ranges::sort(shown);
  std::ranges::sort(unshown);
  EXPECT_EQ(names_in_header("in buffers():", ";"), shown);
  EXPECT_EQ(names_in_header("without buffers:", ".\n"), unshown);
}

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

// --- What a steady frame costs ---

void run_part_by_part(void*, std::uint32_t count, void (*part)(void*, std::uint32_t), void* context) {
  for (std::uint32_t i = 0; i < count; ++i) part(context, i);
}

// Two places of the camera by turns, and with one thread fewer lights. (The parts that threads share are cut anew with
// each number of lights, so there a part can become larger than ever before.)
std::uint64_t allocations_of_steady_frames(const Settings& settings) {
  EngineFrame frame = engine_frame(1500, 3);
  LightLists lists;
  EXPECT_TRUE(lists.start(settings)) << lists.error();
  const auto update = [&] {
    frame.view.eye[0] = frame.view.eye[0] > 0.0 ? -1.0 : 1.0;
    EXPECT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
  };
  for (int warm = 0; warm < 4; ++warm) update();
  if (settings.threads == 1) frame.points.resize(frame.points.size() - 100);
  const std::uint64_t before = assign::testing::allocations();
  for (int i = 0; i < 4; ++i) {
    update();
    EXPECT_GE(lists.cell_at(3.0f, 3.0f, 3.0f), 0);
    EXPECT_GT(lists.memory_bytes(), 0u);
  }
  EXPECT_EQ(lists.builds(), 1u);
  return assign::testing::allocations() - before;
}

TEST(LightLists, of_steady_frames_allocate_nothing) {
  const Parameter sixteen_bits("index_bits", "16");
  for (const char* method : {"exact-fast", "brute-force", "aabb-fast"})
    for (const std::string_view storage : {"", "packed", "fixed", "bitfield", "linked", "runs"}) {
      Settings settings = settings_for(frustum_grid(), method);
      settings.storage = storage;
      if (storage == "packed") settings.storage_parameters = {&sixteen_bits, 1};
      EXPECT_EQ(allocations_of_steady_frames(settings), 0u) << method << " " << storage;
    }
  Settings settings = settings_for(frustum_grid(), "z-binning");
  EXPECT_EQ(allocations_of_steady_frames(settings), 0u);
  settings = settings_for(frustum_grid(), "exact-fast");
  settings.threads = 3;
  settings.jobs.run = run_part_by_part;
  EXPECT_EQ(allocations_of_steady_frames(settings), 0u);
}

// Lights that are off are in no list and take none of the method's memory: what is left are their two copies.
TEST(LightLists, count_lights_as_given_and_as_converted_and_depths) {
  const auto bytes_with = [](const EngineFrame& frame, std::string_view method) {
    LightLists lists;
    EXPECT_TRUE(lists.start(settings_for(frustum_grid(), method))) << lists.error();
    EXPECT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
    return lists.memory_bytes();
  };
  EngineFrame few = engine_frame(0, 3), many = few;
  few.points.resize(10), many.points.resize(30010);
  constexpr std::size_t k_a_light = sizeof(scene::WorldLight) + 5 * sizeof(float);  // x, y, z, radius, reach
  EXPECT_GE(bytes_with(many, "aabb"), bytes_with(few, "aabb") + 30000 * k_a_light);
  const FrameForMethod tiled(*assign::find_assigner("tiled"));
  EXPECT_GE(bytes_with(tiled.engine, "tiled"), 1280 * 720 * sizeof(float));
}

TEST(LightLists, keep_and_count_their_memory_after_a_frame_that_failed) {
  EngineFrame frame = engine_frame(500, 3);
  Settings settings = settings_for(frustum_grid(), "exact-fast");
  settings.storage = "packed";
  LightLists lists;
  ASSERT_TRUE(lists.start(settings));
  ASSERT_TRUE(lists.update(frame.view, frame.lights()));
  const std::size_t before = lists.memory_bytes();
  frame.points[1].range = -1.0f;
  EXPECT_FALSE(lists.update(frame.view, frame.lights()));
  EXPECT_GE(lists.memory_bytes(), before / 2);
}

TEST(LightLists, do_not_depend_on_threads_or_who_lends_them) {
  const EngineFrame frame = engine_frame(3000, 17);
  Settings settings = settings_for(frustum_grid(), "exact-fast");
  const assign::Lists expected = made_lists(settings, frame);
  settings.threads = 4;
  EXPECT_EQ(made_lists(settings, frame), expected);
  int calls = 0;
  settings.jobs = {&calls, [](void* user, std::uint32_t count, void (*part)(void*, std::uint32_t), void* context) {
                     ++*static_cast<int*>(user);
                     std::vector<std::thread> threads;
                     for (std::uint32_t i = 0; i < count; ++i) threads.emplace_back(part, context, count - 1 - i);
                     for (std::thread& thread : threads) thread.join();
                   }};
  EXPECT_EQ(made_lists(settings, frame), expected);
  EXPECT_EQ(calls, 2);
}

TEST(LightLists, are_built_again_only_for_a_new_picture_or_a_new_kind_of_light) {
  EngineFrame frame = engine_frame(100, 5);
  EngineFrame points_only = frame;
  points_only.spots.clear();
  LightLists lists;
  ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "exact-fast")));
  const auto builds_after = [&](const EngineFrame& of) {
    EXPECT_TRUE(lists.update(of.view, of.lights())) << lists.error();
    return lists.builds();
  };
  EXPECT_EQ(builds_after(points_only), 1u);
  frame.view.eye[1] += 3.0;
  EXPECT_EQ(builds_after(points_only), 1u);
  EXPECT_EQ(builds_after(frame), 2u);
  EXPECT_EQ(builds_after(points_only), 2u);
  frame.view.width /= 2;
  EXPECT_EQ(builds_after(frame), 3u);
  frame.view.left += 0.01;
  EXPECT_EQ(builds_after(frame), 4u);
}

// --- Rounding ---

#if defined(__SSE__)
TEST(LightLists, do_not_depend_on_the_callers_rounding) {
  const EngineFrame frame = engine_frame(300, 23);
  const Settings settings = settings_for(frustum_grid(), "exact-fast");
  const assign::Lists expected = made_lists(settings, frame);
  const unsigned before = _mm_getcsr();
  for (const unsigned mode : {0x8040u, 0x2000u, 0x4000u, 0x6000u}) {  // flush and treat as zero; down; up; to zero
    _mm_setcsr((before & ~0x6000u) | mode);
    LightLists lists;
    const bool is_made = lists.start(settings) && lists.update(frame.view, frame.lights());
    const unsigned after = _mm_getcsr() & ~0x3fu;
    _mm_setcsr(before);
    ASSERT_TRUE(is_made) << lists.error();
    EXPECT_EQ(lists_of(lists), expected) << mode;
    EXPECT_EQ(after & 0xe040u, mode);
  }
}
#endif

// --- Cells and lookup ---

TEST(LightLists, look_up_cells_as_the_grid_does_and_a_shader_would) {
  for (const GridCase& grid : grid_cases()) {
    const EngineFrame frame = engine_frame(30, 9);
    LightLists lists;
    ASSERT_TRUE(lists.start(settings_for(grid.grid, "bvh")) || lists.start(settings_for(grid.grid, "brute-force")));
    ASSERT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
    const view::Frame program = program_frame(frame);
    const grid::Grid made = grid::make_grid(grid.spec, grid::grid_inputs(grid.spec, program, 0, Vec3d(0), Vec3d(0)));
    EXPECT_EQ(Vec3i(lists.cells().x, lists.cells().y, lists.cells().z), made.cells());
    SplitMix64 random(3);
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
      const auto x = static_cast<float>(random.between(-10, 1290)), y = static_cast<float>(random.between(-10, 730));
      const auto depth = static_cast<float>(random.between(-1.0, 160.0));  // below 0 behind the eye
      const std::int64_t cell = lists.cell_at(x, y, depth);
      inside += cell >= 0;
      const bool is_shown = x >= 0 && x <= 1280 && y >= 0 && y <= 720;
      if (made.kind() == grid::Kind::frustum) {
        EXPECT_EQ(cell >= 0, is_shown && depth > 0.0f && depth <= made.screen().slices.boundaries.back());
      }
      EXPECT_FALSE(cell >= 0 && depth <= 0.0f);
      if (cell < 0 || depth < 0.1f) continue;
      const Vec3d at = view::picture_ray(program, {x, y}).at(depth);
      const geom::Cell exact = made.cell(static_cast<std::uint32_t>(cell));
      const view::Space space = grid::space_of(made, program);
      const Vec3d world = program.view_space.origin + glm::transpose(program.view_space.rotation) * at;
      const geom::BallVolume around{{world, space.origin, space.rotation}, 1e-3 * (1.0 + depth)};
      EXPECT_EQ(geom::decide_meets(around, exact), geom::Verdict::yes) << grid.spec.name() << " " << x << " " << y;
    }
    EXPECT_GT(inside, 50) << grid.spec.name();
    const float nan = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();
    EXPECT_EQ(lists.cell_at(nan, 1, 1), -1);
    EXPECT_EQ(lists.cell_at(1, 1, nan), -1);
    EXPECT_EQ(lists.cell_at(1, 1, endless), -1);
  }
}

// By the words of the header alone.
int slice_by_header(const Lookup& lookup, float depth) {
  const int slices = static_cast<int>(lookup.boundaries.size()) - 1;
  if (lookup.form == Lookup::Form::search) {
    int slice = 0;
    for (int k = 0; k < slices; ++k)
      if (lookup.boundaries[static_cast<std::size_t>(k)] <= depth) slice = k;
    return slice;
  }
  if (depth < lookup.first_m && lookup.first_slice == 1) return 0;
  const float f = lookup.form == Lookup::Form::log2 ? static_cast<float>(std::log2(static_cast<double>(depth))) : depth;
  return static_cast<int>(std::clamp(f * lookup.scale + lookup.bias, 0.0f, static_cast<float>(slices - 1)));
}

std::int64_t cell_by_header(const LightLists& lists, float x, float y, float depth, bool is_orthographic) {
  const Lookup lookup = lists.lookup();
  const Cells cells = lists.cells();
  if (depth > lookup.boundaries.back() || (!is_orthographic && depth <= 0.0f)) return -1;
  const int column = std::min(static_cast<int>(x * lookup.tile_scale_x), cells.x - 1);
  const int row = std::min(static_cast<int>(y * lookup.tile_scale_y), cells.y - 1);
  return (std::int64_t{slice_by_header(lookup, depth)} * cells.y + row) * cells.x + column;
}

// Near, far, both sides of every boundary, and depths between.
std::vector<float> depths_to_look_up(std::span<const float> boundaries) {
  std::vector<float> depths{-1.0f, 0.0f, 1e-30f, 0.01f, 0.0999f, 0.1f, 4.9999f, 5.0f, 5.0001f, 150.0f, 151.0f, 1e6f};
  for (const float boundary : boundaries)
    for (const float factor : {0.999f, 0.9999999f, 1.0f, 1.0000001f, 1.001f, 1.03f})
      depths.push_back(boundary * factor);
  return depths;
}

void expect_cells_by_header(const Grid& grid, View view, int first_slice) {
  LightLists lists;
  ASSERT_TRUE(lists.start(settings_for(grid, "bvh"))) << lists.error();
  ASSERT_TRUE(lists.update(view, {})) << lists.error();
  ASSERT_EQ(lists.lookup().boundaries.size(), static_cast<std::size_t>(lists.cells().z) + 1);
  EXPECT_EQ(lists.lookup().first_slice, first_slice);
  // The middle of the picture alone has a distance that is its depth.
  const bool is_distance = grid.kind == Grid::Kind::distance;
  std::vector<bool> seen(static_cast<std::size_t>(lists.cells().z));
  for (const float depth : depths_to_look_up(lists.lookup().boundaries))
    for (const float x : {640.0f, 0.0f, 700.5f, 1280.0f}) {
      if (is_distance && x != 640.0f) continue;
      const float y = x == 640.0f ? 360.0f : x / 2;
      const std::int64_t cell = cell_by_header(lists, x, y, depth, view.is_orthographic);
      EXPECT_EQ(lists.cell_at(x, y, depth), cell) << x << " " << depth << " " << static_cast<int>(grid.slicing);
      const auto slice = cell / (std::int64_t{lists.cells().x} * lists.cells().y);
      if (cell >= 0) seen[static_cast<std::size_t>(slice)] = true;
    }
  EXPECT_EQ(std::ranges::count(seen, true), lists.cells().z);
}

TEST(Lookup, finds_the_cells_by_the_formula_of_the_header) {
  using Slicing = Grid::Slicing;
  static constexpr double k_boundaries[] = {0.1, 3.0, 20.0, 100.0};
  const View view = engine_frame(1, 9).view;
  for (const Grid::Kind kind : {Grid::Kind::frustum, Grid::Kind::distance})
    for (const Slicing slicing :
         {Slicing::linear, Slicing::exponential, Slicing::exponential_first, Slicing::power, Slicing::list}) {
      Grid grid;  // tiles in pixels
      grid.kind = kind;
      grid.slicing = slicing;
      if (slicing == Slicing::list) grid.boundaries_m = k_boundaries;
      expect_cells_by_header(grid, view, slicing == Slicing::exponential_first);
      grid.columns = 16, grid.rows = 9;
      expect_cells_by_header(grid, view, slicing == Slicing::exponential_first);
    }
  Grid nearer;  // slices that begin beyond the camera's near plane and end before its far plane
  nearer.near_m = 1.0, nearer.far_m = 60.0;
  expect_cells_by_header(nearer, view, 1);
  nearer.slicing = Slicing::exponential;
  expect_cells_by_header(nearer, view, 0);
}

TEST(Lookup, finds_the_cells_of_an_orthographic_camera_that_sees_behind_itself) {
  View view = engine_frame(1, 9).view;
  view.is_orthographic = true;
  view.left = -32.0, view.right = 32.0, view.bottom = -18.0, view.top = 18.0;
  view.near_m = -20.0, view.far_m = 100.0;
  Grid grid;
  grid.slicing = Grid::Slicing::linear;
  expect_cells_by_header(grid, view, 0);
  grid.slicing = Grid::Slicing::exponential;  // with a first slice from near on
  expect_cells_by_header(grid, view, 1);
}

// --- Bad input ---

struct BadInput {
  const char* error;
  void (*spoil)(Settings& settings, EngineFrame& frame);
};

TEST(LightLists, refuse_bad_input_in_one_sentence_and_go_on) {
  constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
  static constexpr double k_descending[] = {1.0, 0.5};
  static const Parameter k_unknown("index_bit", "16"), k_wrong("index_bits", 16), k_no("index_bits", "17"),
      k_threads("threads", 2), k_twice[] = {{"index_bits", "16"}, {"index_bits", "8"}};
  static const Parameter k_no_type = [] {
    Parameter parameter("index_bits", "16");
    parameter.type = static_cast<Parameter::Type>(7);
    return parameter;
  }();
  const BadInput inputs[] = {
      {"method: is 'exact-fats' (did you mean 'exact-fast'?)",
       [](Settings& s, EngineFrame&) { s.method = "exact-fats"; }},
      {"storage: is 'pack'", [](Settings& s, EngineFrame&) { s.storage = "pack"; }},
      {"storage_parameters: index_bit: is not a parameter (did you mean 'index_bits'?)",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_unknown, 1};
       }},
      {"storage_parameters: index_bits: is 16; it must be a text, one of: auto, 8, 16, 32",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_wrong, 1};
       }},
      {"storage_parameters: index_bits: is '17' (did you mean '16'?); allowed: auto, 8, 16, 32",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_no, 1};
       }},
      {"storage: is given, and z-binning leaves a structure",
       [](Settings& s, EngineFrame&) { s.method = "z-binning", s.storage = "packed"; }},
      {"threads: is 0; allowed: whole numbers from 1 to 256", [](Settings& s, EngineFrame&) { s.threads = 0; }},
      {"threads: is 2; allowed: 1, since aabb-fast works on one thread; those that share a frame: exact-fast",
       [](Settings& s, EngineFrame&) { s.method = "aabb-fast", s.threads = 2; }},
      {"grid.kind: is world, on which exact-fast does not work; allowed: frustum",
       [](Settings& s, EngineFrame&) { s.grid.kind = Grid::Kind::world; }},
      {"grid.kind: is none", [](Settings& s, EngineFrame&) { s.grid.kind = static_cast<Grid::Kind>(9); }},
      {"method_parameters: have 'threads', which Settings::threads gives; allowed: the other parameters of exact-fast",
       [](Settings& s, EngineFrame&) {
         s.method_parameters = {&k_threads, 1};
       }},
      {"storage_parameters: are given, and storage is not; allowed: none",
       [](Settings& s, EngineFrame&) {
         s.storage_parameters = {k_twice, 1};
       }},
      {"storage_parameters: have 'index_bits' twice; allowed: each once",
       [](Settings& s, EngineFrame&) { s.storage = "packed", s.storage_parameters = k_twice; }},
      {"storage_parameters: have 'index_bits' of no type; allowed: number, text, flag",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_no_type, 1};
       }},
      {"grid.slicing: is none; allowed: linear,",
       [](Settings& s, EngineFrame&) { s.grid.slicing = static_cast<Grid::Slicing>(9); }},
      {"grid.boundaries_m: are given, and grid.slicing is not list; allowed: none",
       [](Settings& s, EngineFrame&) { s.grid.boundaries_m = k_descending; }},
      {"grid.lambda: is 1.5; allowed: 0 to 1",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::power, s.grid.lambda = 1.5; }},
      {"grid.lambda: is nan; allowed: 0 to 1",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::power, s.grid.lambda = std::nan(""); }},
      {"grid.first_m: is 200 m; it must lie between near, 0.1 m, and far, 150 m: name one (grid.first_m), or another "
       "scheme (grid.slicing)",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::exponential_first, s.grid.first_m = 200.0; }},
      {"grid.columns, grid.rows: are 16 and 0; allowed: both 0", [](Settings& s, EngineFrame&) { s.grid.rows = 0; }},
      {"grid.columns: is -1; allowed: 1 or more", [](Settings& s, EngineFrame&) { s.grid.columns = -1; }},
      {"grid.tile_width: is 0; allowed: 1 or more",
       [](Settings& s, EngineFrame&) { s.grid.columns = s.grid.rows = s.grid.tile_width = 0; }},
      {"grid.slices: is 0; allowed: 1 to 4096", [](Settings& s, EngineFrame&) { s.grid.slices = -5; }},
      {"grid.boundaries_m: are fewer than 2", [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::list; }},
      {"grid.boundaries_m: have 0.5 after 1; allowed: ascending numbers",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::list, s.grid.boundaries_m = k_descending; }},
      {"grid.near_m: ", [](Settings& s, EngineFrame&) { s.grid.near_m = 500.0; }},
      {"grid.far_m: is not given, and the camera has no far plane",
       [](Settings&, EngineFrame& f) { f.view.far_m = std::numeric_limits<double>::infinity(); }},
      {"view.width, view.height: are 0 and 720; allowed: 1 to 1048576 pixels",
       [](Settings&, EngineFrame& f) { f.view.width = 0; }},
      {"view.left, view.right, view.bottom, view.top: are no picture; allowed: left < right, bottom < top",
       [](Settings&, EngineFrame& f) { f.view.right = f.view.left; }},
      {"view.near_m, view.far_m: are -1 and 150; allowed: 0 < near < far",
       [](Settings&, EngineFrame& f) { f.view.near_m = -1.0; }},
      {"view.near_m, view.far_m: are nan and 150", [](Settings&, EngineFrame& f) { f.view.near_m = std::nan(""); }},
      {"view.eye: ", [](Settings&, EngineFrame& f) { f.view.eye[2] = 2e15; }},
      {"view.to_right, view.to_top, view.forward: are not unit and orthogonal; allowed: products within 1e-3 of 1 and "
       "0",
       [](Settings&, EngineFrame& f) { f.view.to_top[2] += 0.1; }},
      {"view.to_right, view.to_top, view.forward: ",
       [](Settings&, EngineFrame& f) { f.view.forward[0] = std::nan(""); }},
      {"view: shows more than", [](Settings&, EngineFrame& f) { f.view.top = 1e6; }},
      {"lights.points[3].position: is (nan,", [](Settings&, EngineFrame& f) { f.points[3].position[0] = k_nan; }},
      {"lights.points[2].range: is -1; allowed: 0 or more",
       [](Settings&, EngineFrame& f) { f.points[2].range = -1.0f; }},
      {"lights.points[2].range: is nan", [](Settings&, EngineFrame& f) { f.points[2].range = k_nan; }},
      {"lights.spots[1].direction: is (0, 0, 0)",
       [](Settings&, EngineFrame& f) {
         for (float& number : f.spots[1].direction) number = 0.0f;
       }},
      {"lights.spots[1].outer_angle: is 1.7", [](Settings&, EngineFrame& f) { f.spots[1].outer_angle = 1.7f; }},
      {"lights.boxes: are given, and exact-fast takes none", [](Settings&, EngineFrame& f) { f.boxes.resize(1); }},
  };
  for (const BadInput& input : inputs) {
    Settings settings = settings_for(frustum_grid(), "exact-fast");
    EngineFrame frame = engine_frame(30, 5);
    input.spoil(settings, frame);
    LightLists lists;
    EXPECT_FALSE(lists.start(settings) && lists.update(frame.view, frame.lights())) << input.error;
    EXPECT_TRUE(lists.error().starts_with(input.error)) << lists.error() << "\nexpected: " << input.error;
    EXPECT_TRUE(lists.begins().empty());
    EXPECT_EQ(lists.cell_at(100, 100, 10), -1);
    const EngineFrame good = engine_frame(30, 5);
    ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "exact-fast"))) << lists.error();
    EXPECT_TRUE(lists.update(good.view, good.lights())) << lists.error();
    EXPECT_EQ(lists.error(), "");
  }
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
