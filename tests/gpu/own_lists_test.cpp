// Methods on a device whose answer is a light structure of their own: lists with room for N lights, and lists per tile
// between the depths of its pixels.

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "assign/bounds/tile_planes.h"
#include "assign/contract/light_test.h"
#include "assign/contract/storage.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/occupied/depth_parts.h"
#include "assign/storages/fixed.h"
#include "core/arrays.h"
#include "geom/light_meets_cell.h"
#include "geom/numbers/round_to_float.h"
#include "geom/single_precision/bounding_volumes.h"
#include "geom/single_precision/box_tests.h"
#include "geom/single_precision/touch_tests.h"
#include "gpu/device/device.h"
#include "gpu/device_test.h"
#include "gpu/methods/frame_arguments.h"
#include "gpu/methods/methods.h"
#include "gpu/structure_runs.h"

namespace clusterbench::gpu {
namespace {

using assign::Answer;
using assign::AssignerDescriptor;
using assign::AssignerRun;
using assign::Lists;
using assign::Params;
using assign::StructureUse;
using assign::testing::Setting;
using testing::expect_same_cells;
using testing::lights_of;
using testing::run_of;
using testing::settings_of_tiles;
using testing::Values;

using DeviceOwnLists = testing::DeviceTest;

Setting without_boxes(Setting setting) {
  std::erase_if(setting.frame.lights,
                [](const scene::WorldLight& light) { return light.type == scene::LightType::box; });
  setting.frame.count_types();
  return setting;
}

void keep_points_of(Setting& setting) {
  std::erase_if(setting.frame.lights,
                [](const scene::WorldLight& light) { return light.type != scene::LightType::point; });
  setting.frame.count_types();
}

// Where a device may round either way, its methods count each step twice.
float steps() {
  return device().facts().rounds_to_nearest ? 1.0f : 2.0f;
}
double inflation_of_reference() {
  return (2.0 + 4.0 * static_cast<double>(steps())) / 6.0;
}

// --- gpu-cells-fixed ---

// Lists of another method, in the storage of the same form.
std::unique_ptr<assign::Storage> stored_fixed(const Lists& lists, double cap, const Setting& setting) {
  const assign::StorageDescriptor& fixed = *assign::find_storage("fixed");
  std::unique_ptr<assign::Storage> storage = fixed.make(Params(fixed.params, {{"cap", cap}}));
  storage->start(setting.grid, setting.frame.ranges());
  storage->store(lists);
  return storage;
}

void expect_same(const assign::LightStructure& found, const assign::LightStructure& expected,
                 const std::string& where) {
  EXPECT_TRUE(found.expanded() == expected.expanded()) << where;
  const StructureUse use = found.use(), wanted = expected.use();
  EXPECT_EQ(use.index_entries, wanted.index_entries) << where;
  EXPECT_EQ(use.header_bytes, wanted.header_bytes) << where;
  EXPECT_EQ(use.dropped_pairs, wanted.dropped_pairs) << where;
  EXPECT_EQ(use.overflowing_cells, wanted.overflowing_cells) << where;
  EXPECT_EQ(use.dropped_lights, wanted.dropped_lights) << where;
  EXPECT_EQ(found.limit().index_entries, expected.limit().index_entries) << where;
}

TEST_F(DeviceOwnLists, of_fixed_length_are_those_of_brute_force_in_the_storage_fixed) {
  const AssignerDescriptor& row = *assign::find_assigner("gpu-cells-fixed");
  std::uint64_t dropped = 0;
  for (Setting setting : assign::testing::settings_for(row, 9)) {
    keep_points_of(setting);
    const Lists lists =
        run_of("brute-force", {{"inflation", inflation_of_reference()}}, Answer::lists, setting).cell_lists();
    for (const double cap : {1.0, 7.0, 100.0, 1000.0}) {
      const AssignerRun run = run_of(row.name, {{"cap", cap}}, Answer::structure, setting);
      const auto expected = stored_fixed(lists, cap, setting);
      expect_same(*run.structure(), *expected, setting.name + ", cap " + std::to_string(cap));
      dropped += run.structure()->use().dropped_pairs;
    }
  }
  EXPECT_GT(dropped, 0u);
}

TEST_F(DeviceOwnLists, of_fixed_length_have_the_spots_of_gpu_cells) {
  const AssignerDescriptor& row = *assign::find_assigner("gpu-cells-fixed");
  for (const Setting& setting : assign::testing::settings_for(row, 10))
    for (const std::string spot : {"sphere", "both"}) {
      const Lists lists = run_of("gpu-cells", {{"spot", spot}}, Answer::lists, setting).cell_lists();
      const AssignerRun run = run_of(row.name, {{"cap", 20.0}, {"spot", spot}}, Answer::structure, setting);
      const auto expected = stored_fixed(lists, 20.0, setting);
      expect_same(*run.structure(), *expected, setting.name + ", " + spot);
    }
}

TEST_F(DeviceOwnLists, of_fixed_length_forget_what_the_frame_before_dropped) {
  const AssignerDescriptor& row = *assign::find_assigner("gpu-cells-fixed");
  Setting setting = assign::testing::settings_for(row, 9).front();
  keep_points_of(setting);
  AssignerRun run = run_of(row.name, {{"cap", 1.0}}, Answer::structure, setting);
  EXPECT_GT(run.structure()->use().dropped_lights.size(), 1u);
  for (scene::WorldLight& light : setting.frame.lights) light.range_m = 0.0;
  const view::LightArrays empty = lights_of(setting);
  run.assign(setting.input(empty));
  EXPECT_TRUE(run.structure()->use().dropped_lights.empty());
  EXPECT_EQ(run.structure()->use().dropped_pairs, 0u);
  setting.frame.lights.clear();
  setting.frame.count_types();
  const view::LightArrays none = lights_of(setting);
  run.assign(setting.input(none));
  EXPECT_EQ(run.structure()->use().index_entries, 0u);
  EXPECT_EQ(run.structure()->buffers().front().elements, 0u);
}

TEST_F(DeviceOwnLists, of_fixed_length_stay_on_the_device_as_words) {
  const AssignerDescriptor& row = *assign::find_assigner("gpu-cells-fixed");
  const Setting setting = assign::testing::settings_for(row, 9).front();
  const StructureUse use = run_of(row.name, {}, Answer::structure, setting).structure()->use();
  EXPECT_EQ(use.upload_bytes, 0u);
  EXPECT_EQ(use.index_bytes, 4u * 100u * setting.grid.cell_count());
  EXPECT_EQ(use.header_bytes, 4u * setting.grid.cell_count());
}

// --- gpu-tiled ---

// Where a device may round either way, its masks have some more parts.
bool has_masks_of_the_processor() {
  return device().facts().rounds_to_nearest;
}

TEST_F(DeviceOwnLists, of_tiles_are_those_of_tiled_where_spots_are_balls) {
  std::uint64_t pairs = 0;
  for (const Setting& given : settings_of_tiles(9))
    for (const bool is_masked : {false, true})
      for (const std::string spot : {"sphere", "range"}) {
        if (is_masked && !has_masks_of_the_processor()) continue;
        const Setting setting = without_boxes(given);
        const std::string where = setting.name + ", " + spot + (is_masked ? ", masked" : "");
        const AssignerRun run =
            run_of("gpu-tiled", {{"test", std::string("aabb")}, {"depth_mask", is_masked}, {"spot", spot}},
                   Answer::structure, setting);
        const AssignerRun expected =
            run_of(is_masked ? "tiled-2.5d" : "tiled",
                   {{"test", std::string("aabb")}, {"spot", spot}, {"inflation", inflation_of_reference()}},
                   Answer::structure, setting);
        expect_same_cells(*run.structure(), *expected.structure(), where);
        EXPECT_TRUE(run.structure()->expanded() == expected.structure()->expanded()) << where;
        pairs += run.structure()->use().index_entries;
      }
  EXPECT_GT(pairs, 1000u);
}

// The tiles of a frame, pixel by pixel.
struct SeenTiles {
  std::vector<float> lo, hi;
  std::vector<std::uint32_t> masks;

  SeenTiles(const grid::Tiles& tiles, const depth::DepthImage& image) {
    const auto count = static_cast<std::size_t>(tiles.count.x) * static_cast<std::size_t>(tiles.count.y);
    lo.assign(count, INFINITY);
    hi.assign(count, -INFINITY);
    masks.assign(count, 0);
    each_pixel(tiles, image, [&](std::size_t tile, float depth) {
      lo[tile] = std::min(lo[tile], depth);
      hi[tile] = std::max(hi[tile], depth);
    });
    for (std::size_t tile = 0; tile < count; ++tile)
      if (lo[tile] <= hi[tile]) hi[tile] = std::nextafter(hi[tile], INFINITY);
    each_pixel(tiles, image, [&](std::size_t tile, float depth) {
      masks[tile] |= assign::DepthParts(lo[tile], hi[tile]).bit_of(depth);
    });
  }

  template <class Visit>
  static void each_pixel(const grid::Tiles& tiles, const depth::DepthImage& image, const Visit& visit) {
    for (int y = 0; y < tiles.viewport.y; ++y)
      for (int x = 0; x < tiles.viewport.x; ++x) {
        const float depth = image.nearest[static_cast<std::size_t>(y * tiles.viewport.x + x)];
        if (std::isinf(depth)) continue;
        const Vec2i tile = tiles.tile_of(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        visit(static_cast<std::size_t>(tile.y * tiles.count.x + tile.x), depth);
      }
  }
};

// The ball around a tile, in the steps of around.glsl.
geom::Ball ball_in_steps(const geom::FrustumCell& part) {
  const geom::Box box = geom::box_around(part);
  const Vec3f center = 0.5f * box.lo + 0.5f * box.hi;
  float squared = 0.0f;
  for (const float depth : {part.depth0, part.depth1}) {
    const double scale = part.orthographic ? 1.0 : static_cast<double>(depth);
    const auto reach = [&](float lo, float hi, float middle) {
      return std::max(geom::rounded_up(hi * scale) - middle, middle - geom::rounded_down(lo * scale));
    };
    const float x = reach(part.x0, part.x1, center.x), y = reach(part.y0, part.y1, center.y), z = depth + center.z;
    squared = std::max(squared, x * x + y * y + z * z);
  }
  squared *= 1.0f + 0x1p-19f;
  if (!(squared < 1e38f)) return {center, 1e19f};
  squared = std::max(squared, 1e-34f);
  float root = std::sqrt(squared);
  while (root * root >= squared) root = std::nextafter(root, 0.0f);
  while (root * root < squared) root = std::nextafter(root, INFINITY);
  return {center, root};
}

// The steps of the shaders, in the processor's single precision.
class TileTwin {
 public:
  TileTwin(const Params& params, const Setting& setting, const view::LightArrays& lights)
      : params_(params),
        test_(params, 4.0f * steps()),
        lights_(lights),
        grid_(setting.grid),
        tiles_(setting.grid.screen().tiles),
        seen_(tiles_, setting.depth) {}

  Lists lists() const {
    grid::ScreenGrid endless = grid_.screen();
    endless.slices.boundaries = {endless.slices.boundaries.front(), std::numeric_limits<float>::max()};
    const assign::ViewCull view(endless);
    Lists out;
    out.begin.push_back(0);
    for (std::uint32_t tile = 0; tile < seen_.lo.size(); ++tile) {
      for (std::uint32_t light = 0; light < lights_.size(); ++light)
        if (seen_.lo[tile] <= seen_.hi[tile] && !lights_.is_empty(light) &&
            !view.misses(test_.ball(lights_, light, 1.0f)) && meets(light, tile))
          out.lights.push_back(light);
      out.begin.push_back(out.pair_count());
    }
    return out;
  }

 private:
  geom::FrustumCell part_of(std::uint32_t tile) const {
    auto part = std::get<geom::FrustumCell>(grid_.cell(tile));
    part.depth0 = seen_.lo[tile];
    part.depth1 = seen_.hi[tile];
    return part;
  }

  bool meets(std::uint32_t light, std::uint32_t tile) const {
    geom::Ball ball = test_.ball(lights_, light, 4.0f * steps());
    ball.radius = std::min(ball.radius, 1e19f);
    geom::Box box{ball.center - ball.radius, ball.center + ball.radius};
    if (lights_.is_box(light)) {
      const geom::PaddedBox padded =
          geom::padded(lights_.box(light), test_.padding(5.0f) * (0x1p-24f * lights_.reach[light]));
      box = {padded.box.center - padded.extent, padded.box.center + padded.extent};
    }
    const float near = -box.hi.z, far = -box.lo.z;
    if (near > seen_.hi[tile] || far < seen_.lo[tile]) return false;
    if (params_.flag("depth_mask") &&
        (assign::DepthParts(seen_.lo[tile], seen_.hi[tile]).bits_between(near, far) & seen_.masks[tile]) == 0)
      return false;
    if (params_.text("test") != "aabb" && is_beside(ball, tile)) return false;
    const geom::Box bounds = geom::box_around(part_of(tile));
    if (params_.text("test") != "planes" &&
        !(lights_.is_box(light) ? boxes_touch(box, bounds) : geom::ball_touches_box(ball, bounds)))
      return false;
    return !lights_.is_spot(light) || !test_.tests_cones() || cone_touches(light, tile);
  }

  static bool boxes_touch(const geom::Box& a, const geom::Box& b) {
    return a.lo.x <= b.hi.x && a.lo.y <= b.hi.y && a.lo.z <= b.hi.z && b.lo.x <= a.hi.x && b.lo.y <= a.hi.y &&
           b.lo.z <= a.hi.z;
  }

  bool is_beside(const geom::Ball& ball, std::uint32_t tile) const {
    const auto column = tile % static_cast<std::uint32_t>(tiles_.count.x),
               row = tile / static_cast<std::uint32_t>(tiles_.count.x);
    const auto beyond = [&](float boundary, float coordinate) {
      return assign::tile_plane(boundary, tiles_.orthographic).distance(coordinate, -ball.center.z);
    };
    return beyond(tiles_.x[column], ball.center.x) < -ball.radius ||
           beyond(tiles_.x[column + 1], ball.center.x) > ball.radius ||
           beyond(tiles_.y[row], ball.center.y) > ball.radius ||
           beyond(tiles_.y[row + 1], ball.center.y) < -ball.radius;
  }

  bool cone_touches(std::uint32_t light, std::uint32_t tile) const {
    const geom::Ball ball = ball_in_steps(part_of(tile));
    if (ball.radius > 1e18f) return true;
    geom::SphericalCone cone = test_.cone(lights_, light);
    cone.range = std::min(cone.range, 1e19f);
    const Vec3f to = ball.center - cone.apex;
    const float along = to.x * cone.axis.x + to.y * cone.axis.y + to.z * cone.axis.z;
    const float reach = ball.radius + 0x1p-19f * steps() * (geom::size_of(cone.apex) + geom::size_of(ball.center));
    const float farthest = cone.range + reach;
    if (along < -reach || along > farthest || to.x * to.x + to.y * to.y + to.z * to.z > farthest * farthest)
      return false;
    const Vec3f across = to - along * cone.axis;
    const float beside = reach + cone.sin_angle * along;
    return beside >= 0.0f &&
           cone.cos_angle * cone.cos_angle * (across.x * across.x + across.y * across.y + across.z * across.z) <=
               beside * beside;
  }

  const Params& params_;
  assign::LightTest test_;
  const view::LightArrays& lights_;
  const grid::Grid& grid_;
  const grid::Tiles& tiles_;
  SeenTiles seen_;
};

TEST_F(DeviceOwnLists, of_tiles_are_those_of_the_same_steps_on_the_processor) {
  if (!device().facts().rounds_to_nearest) GTEST_SKIP() << "skipped: the device may round either way";
  const AssignerDescriptor& row = *assign::find_assigner("gpu-tiled");
  std::uint64_t pairs = 0;
  std::size_t turn = 0;
  const std::vector<std::string> spots{"both", "cone-sphere", "sphere"};
  for (const Setting& setting : settings_of_tiles(11))
    for (const std::string test : {"planes", "aabb", "both"})
      for (const bool is_masked : {false, true}) {
        const Values values{{"test", test}, {"depth_mask", is_masked}, {"spot", spots[turn++ % spots.size()]}};
        const Params params(row.params, values);
        const view::LightArrays lights = lights_of(setting);
        const Lists found = run_of(row.name, values, Answer::structure, setting).structure()->expanded();
        EXPECT_TRUE(found == TileTwin(params, setting, lights).lists())
            << setting.name << ", " << test << ", " << params.text("spot") << (is_masked ? ", masked" : "");
        pairs += found.pair_count();
      }
  EXPECT_GT(pairs, 1000u);
}

// One row of tiles of two pixels each, of all sizes of the domain.
struct PairsOfPixels {
  static constexpr std::uint32_t k_tiles = 20000;

  std::vector<float> x, y, depths;
  bool orthographic;

  PairsOfPixels(bool is_orthographic, std::uint64_t seed) : orthographic(is_orthographic) {
    assign::testing::Random random(seed);
    const auto side = [&] {
      const double size = random.log_between(1e-6, orthographic ? 1e12 : 1e5);
      return static_cast<float>(random.unit() < 0.5 ? -size : size);
    };
    for (std::uint32_t i = 0; i <= k_tiles; ++i) x.push_back(i % 100 == 0 ? 0.0f : side());
    std::ranges::sort(x);
    y = {side(), side()};
    std::ranges::sort(y, std::greater<>());
    for (std::uint32_t i = 0; i < k_tiles; ++i) {
      const double near = random.log_between(1e-14, 1e14);
      depths.push_back(static_cast<float>(near));
      depths.push_back(static_cast<float>(near * (random.unit() < 0.1 ? 1.0 : 1.0 + random.log_between(1e-7, 1e3))));
      if (random.unit() < 0.5) std::swap(depths[2 * i], depths[2 * i + 1]);
    }
  }

  geom::FrustumCell part(std::uint32_t tile) const {
    const float a = depths[2 * tile], b = depths[2 * tile + 1];
    return {x[tile], x[tile + 1], y[1], y[0], std::min(a, b), std::nextafter(std::max(a, b), INFINITY), orthographic};
  }

  // As tile.glsl lays them out.
  std::vector<std::uint32_t> on_device() const {
    std::vector<std::uint32_t> sides;
    const auto add = [&](float boundary, std::uint32_t pixel) {
      sides.insert(sides.end(), {std::bit_cast<std::uint32_t>(boundary), 0, 0, pixel});
    };
    for (std::uint32_t i = 0; i <= k_tiles; ++i) add(x[i], 2 * i);
    add(y[0], 0);
    add(y[1], 1);
    FrameArguments arguments;
    arguments.cells = arguments.columns = k_tiles;
    arguments.rows = arguments.slices = 1;
    arguments.picture_width = 2 * k_tiles;
    arguments.is_orthographic = orthographic ? 1 : 0;
    Buffers buffers(device());
    buffers.reserve(Binding::depths, bytes_of(depths), "depths");
    buffers.reserve(Binding::tile_sides, bytes_of(sides), "sides");
    buffers.reserve(Binding::tiles, 64 * k_tiles, "tiles");
    Commands commands(device(), buffers);
    commands.upload(Binding::depths, depths.data(), bytes_of(depths));
    commands.upload(Binding::tile_sides, sides.data(), bytes_of(sides));
    commands.barrier();
    commands.dispatch(device().kernel("tile_depths", 64, 1), arguments, k_tiles);
    commands.download(Binding::tiles, 64 * k_tiles);
    commands.run();
    const auto words = commands.downloaded(0);
    return {words.begin(), words.end()};
  }
};

TEST_F(DeviceOwnLists, of_tiles_know_their_tiles_as_the_processor_does) {
  for (const bool orthographic : {false, true}) {
    const PairsOfPixels given(orthographic, 17);
    const std::vector<std::uint32_t> words = given.on_device();
    const auto value = [&](std::size_t word) { return std::bit_cast<float>(words[word]); };
    for (std::uint32_t tile = 0; tile < PairsOfPixels::k_tiles; ++tile) {
      const geom::FrustumCell part = given.part(tile);
      ASSERT_EQ(value(4 * tile), part.depth0) << tile;
      ASSERT_EQ(value(4 * tile + 1), part.depth1) << tile;
      const geom::Box box = geom::box_around(part);
      const std::size_t at = 4 * PairsOfPixels::k_tiles + 12 * tile;
      ASSERT_EQ(Vec3f(value(at), value(at + 1), value(at + 2)), box.lo) << tile;
      ASSERT_EQ(Vec3f(value(at + 4), value(at + 5), value(at + 6)), box.hi) << tile;
      if (!device().facts().rounds_to_nearest) continue;
      ASSERT_EQ(value(4 * tile + 3), 32.0f / (part.depth1 - part.depth0)) << tile;
      const assign::DepthParts parts(part.depth0, part.depth1);
      ASSERT_EQ(words[4 * tile + 2], parts.bit_of(given.depths[2 * tile]) | parts.bit_of(given.depths[2 * tile + 1]));
      const geom::Ball ball = ball_in_steps(part);
      ASSERT_EQ(Vec3f(value(at + 8), value(at + 9), value(at + 10)), ball.center) << tile;
      ASSERT_EQ(value(at + 11), ball.radius) << tile;
    }
  }
}

// Tiles of four pixels: the ends of a range, and the depths on both sides of where one of its parts begins. Ranges are
// so long that these depths are closer to it than a device's roundoffs.
class BesideAPart {
 public:
  static constexpr std::uint32_t k_tiles = 4000;

  explicit BesideAPart(std::uint64_t seed) {
    assign::testing::Random random(seed);
    for (std::uint32_t tile = 0; tile < k_tiles; ++tile) {
      const auto lo = static_cast<float>(random.log_between(1e-3, 1e6)),
                 hi = static_cast<float>(lo * (1.0 + random.log_between(40.0, 1e4)));
      const assign::DepthParts parts(lo, std::nextafter(hi, INFINITY));
      part_.push_back(1 + static_cast<int>(31.0 * random.unit()));
      float before = lo, behind = hi;
      while (std::nextafter(before, INFINITY) < behind) {
        const float middle = before + (behind - before) / 2.0f;
        (parts.part_of(middle) < part_.back() ? before : behind) = middle;
      }
      depths_.insert(depths_.end(), {lo, before, behind, hi});
    }
  }

  int part(std::uint32_t tile) const { return part_[tile]; }
  std::uint32_t bits_on_host(std::uint32_t tile) const {
    const float* pixel = &depths_[4 * tile];
    const assign::DepthParts parts(pixel[0], std::nextafter(pixel[3], INFINITY));
    return parts.bit_of(pixel[0]) | parts.bit_of(pixel[1]) | parts.bit_of(pixel[2]) | parts.bit_of(pixel[3]);
  }
  // `without`: of each tile, pixel 1 or 2 is as if it were not there.
  std::vector<std::uint32_t> bits_on_device(std::uint32_t mode, std::uint32_t without) const {
    std::vector<float> depths = depths_;
    for (std::uint32_t tile = 0; tile < k_tiles; ++tile) depths[4 * tile + without] = depths[4 * tile];
    std::vector<std::uint32_t> sides;
    for (std::uint32_t i = 0; i <= k_tiles; ++i)
      sides.insert(sides.end(), {std::bit_cast<std::uint32_t>(static_cast<float>(i)), 0, 0, 4 * i});
    for (std::uint32_t row = 0; row < 2; ++row)
      sides.insert(sides.end(), {std::bit_cast<std::uint32_t>(1.0f - static_cast<float>(row)), 0, 0, row});
    FrameArguments arguments;
    arguments.cells = arguments.columns = k_tiles;
    arguments.rows = arguments.slices = 1;
    arguments.picture_width = 4 * k_tiles;
    Buffers buffers(device());
    buffers.reserve(Binding::depths, bytes_of(depths), "depths");
    buffers.reserve(Binding::tile_sides, bytes_of(sides), "sides");
    buffers.reserve(Binding::tiles, 64 * k_tiles, "tiles");
    Commands commands(device(), buffers);
    commands.upload(Binding::depths, depths.data(), bytes_of(depths));
    commands.upload(Binding::tile_sides, sides.data(), bytes_of(sides));
    commands.barrier();
    commands.dispatch(device().kernel("tile_depths", 64, mode), arguments, k_tiles);
    commands.download(Binding::tiles, 16 * k_tiles);
    commands.run();
    const auto words = commands.downloaded(0);
    std::vector<std::uint32_t> bits;
    for (std::uint32_t tile = 0; tile < k_tiles; ++tile) bits.push_back(words[4 * tile + 2]);
    return bits;
  }

 private:
  std::vector<float> depths_;
  std::vector<int> part_;
};

TEST_F(DeviceOwnLists, of_tiles_have_both_parts_of_a_depth_between_them_where_a_device_may_round_either_way) {
  constexpr std::uint32_t k_mask = 1, k_widened_mask = 3;
  const BesideAPart given(23);
  for (const std::uint32_t without : {1u, 2u}) {
    const std::vector<std::uint32_t> bits = given.bits_on_device(k_mask, without),
                                     wider = given.bits_on_device(k_widened_mask, without);
    std::uint32_t more = 0;
    for (std::uint32_t tile = 0; tile < BesideAPart::k_tiles; ++tile) {
      const std::uint32_t both = 3u << (given.part(tile) - 1);
      ASSERT_EQ(wider[tile] & both, both) << tile << ": the depth next to part " << given.part(tile);
      ASSERT_EQ(wider[tile] & given.bits_on_host(tile), given.bits_on_host(tile)) << tile;
      ASSERT_EQ(bits[tile] & ~wider[tile], 0u) << tile;
      ASSERT_LE(std::popcount(wider[tile]), 6) << tile << ": only what lies next to a depth";
      more += bits[tile] != wider[tile] ? 1 : 0;
    }
    EXPECT_GT(more, BesideAPart::k_tiles / 2) << "a mask that is not widened has one of the two";
  }
}

TEST_F(DeviceOwnLists, of_tiles_lose_no_light_that_meets_a_visible_part) {
  std::uint64_t true_pairs = 0;
  for (const Setting& setting : settings_of_tiles(13)) {
    const view::LightArrays lights = lights_of(setting);
    for (const std::string test : {"planes", "both"}) {
      const AssignerRun run = run_of("gpu-tiled", {{"test", test}}, Answer::structure, setting);
      const grid::OccupiedCells cells = run.structure()->occupied_cells();
      const Lists lists = run.structure()->expanded();
      for (std::uint32_t cell = 0; cell < cells.cell_count(); cell += 5)
        for (std::uint32_t light = 0; light < lights.size(); light += 3) {
          const auto list = lists.of(cell);
          if (lights.is_empty(light) || std::binary_search(list.begin(), list.end(), light)) continue;
          for (const geom::FrustumCell& part : cells.of(cell))
            EXPECT_NE(geom::decide_meets(lights.volume(light), part), geom::Verdict::yes)
                << setting.name << ", " << test << ", light " << light << ", tile " << cell;
        }
      true_pairs += lists.pair_count();
    }
  }
  EXPECT_GT(true_pairs, 1000u);
}

TEST_F(DeviceOwnLists, of_tiles_test_lights_in_view_against_tiles_that_show_a_surface) {
  const AssignerDescriptor& row = *assign::find_assigner("gpu-tiled");
  Setting setting = assign::testing::settings_for(row, 9).front();
  keep_points_of(setting);
  for (float& depth : setting.depth.nearest) depth = INFINITY;
  EXPECT_EQ(run_of(row.name, {}, Answer::structure, setting).tests_done(), 0u);
  setting.depth.nearest[0] = 5.0f;
  const AssignerRun run = run_of(row.name, {}, Answer::structure, setting);
  EXPECT_GT(run.tests_done(), 0u);
  EXPECT_LT(run.tests_done(), setting.frame.lights.size()) << "one tile; some lights lie beside the view";
  EXPECT_EQ(run.structure()->occupied_cells().parts.size(), 1u);
  EXPECT_EQ(run.structure()->occupied_cells().parts.front().depth0, 5.0f);
}

}  // namespace
}  // namespace clusterbench::gpu
