// Methods that cut their cells to the depths of pixels: against the truth of these cells, and at the pixels.

#include <gtest/gtest.h>

#include <cmath>

#include "assign/contract/assigner_run.h"
#include "assign/occupied/depth_parts.h"
#include "assign/settings.h"
#include "core/error.h"
#include "core/memory.h"
#include "effort.h"
#include "geom/light_meets_cell.h"
#include "measure/samples/samples.h"
#include "measure/truth/list_errors.h"
#include "measure/truth/truth.h"
#include "view/packing.h"

namespace clusterbench::measure {
namespace {

using assign::AssignerDescriptor;
using assign::AssignerRun;
using assign::testing::Setting;

std::vector<const AssignerDescriptor*> rows_with_depth() {
  std::vector<const AssignerDescriptor*> rows;
  for (const AssignerDescriptor* row : assign::assigner_descriptors())
    if (row->needs.depth && !row->naive) rows.push_back(row);
  return rows;
}

// `deferred` has no cells.
std::vector<const AssignerDescriptor*> rows_with_cells() {
  std::vector<const AssignerDescriptor*> rows = rows_with_depth();
  std::erase_if(rows, [](const AssignerDescriptor* row) {
    return !AssignerRun(*row, assign::Params(row->params), assign::Answer::structure).has_cells();
  });
  return rows;
}

AssignerRun run_of(const AssignerDescriptor& row, const assign::Params& params, const Setting& setting) {
  AssignerRun run(row, params, assign::Answer::structure);
  run.build(setting.grid);
  const view::LightArrays lights = view::lights_in(setting.frame, setting.frame.view_space);
  run.assign(setting.input(lights));
  return run;
}

ErrorCounts errors_of(const AssignerRun& run, const Setting& setting) {
  const grid::OccupiedCells cells = run.structure()->occupied_cells();
  ErrorCounts counts;
  add_frame(counts, setting.frame, cells, find_truth(setting.frame, setting.grid, cells, 2), run.cell_lists());
  return counts;
}

bool lies_in(const geom::FrustumCell& part, const Vec3d& p) {
  const double depth = -p.z, scale = part.orthographic ? 1.0 : depth;
  return depth >= part.depth0 && depth <= part.depth1 && p.x >= part.x0 * scale && p.x <= part.x1 * scale &&
         p.y >= part.y0 * scale && p.y <= part.y1 * scale;
}

// In plain double precision.
bool reaches(const scene::WorldLight& light, const Vec3d& from_eye, const Vec3d& eye) {
  const Vec3d way = from_eye - (light.position - eye);
  const double distance = glm::length(way);
  if (light.range_m == 0.0 || distance > light.range_m) return false;
  if (light.type != scene::LightType::spot) return true;
  return glm::dot(way, glm::normalize(light.direction)) >= std::cos(light.outer_cone_rad) * distance;
}

// How many lights the visible surfaces lack of those that reach them; every `step`th pixel is asked.
struct AtPixels {
  std::uint64_t needed = 0, missed = 0, evaluated = 0, unanswered = 0;
};
AtPixels at_pixels(const AssignerRun& run, const Setting& setting, std::size_t step) {
  AtPixels counts;
  std::vector<std::uint32_t> given;
  const std::vector<grid::Sample> samples = opaque_samples(setting.frame, setting.depth);
  for (std::size_t i = 0; i < samples.size(); i += step) {
    counts.unanswered += run.structure()->lights_at(samples[i], grid::Log2::rounded, given) ? 0 : 1;
    counts.evaluated += given.size();
    for (std::uint32_t light = 0; light < setting.frame.lights.size(); ++light) {
      if (!reaches(setting.frame.lights[light], samples[i].from_eye, samples[i].eye)) continue;
      ++counts.needed;
      counts.missed += std::ranges::find(given, light) == given.end() ? 1 : 0;
    }
  }
  return counts;
}

TEST(OccupiedCells, no_true_pair_is_lost_in_any_view_with_any_choice) {
  for (const AssignerDescriptor* row : rows_with_cells())
    for (int i = 0; i < test::tries(3); ++i)
      for (const Setting& setting : assign::testing::settings_for(*row, 51 + static_cast<std::uint64_t>(i)))
        for (const assign::Params& params : assign::testing::params_of(*row)) {
          const ErrorCounts errors = errors_of(run_of(*row, params, setting), setting);
          EXPECT_EQ(errors.false_negatives, 0u) << row->name << " on " << setting.name;
          EXPECT_EQ(errors.undecided, 0u) << row->name << " on " << setting.name;
          EXPECT_GT(errors.true_pairs, 100u) << row->name << " on " << setting.name << ": no power";
        }
}

TEST(OccupiedCells, no_true_pair_is_lost_at_any_scale_of_the_domain) {
  for (const AssignerDescriptor* row : rows_with_cells())
    for (const Setting& setting : assign::testing::settings_of_any_size(*row, test::tries(16), 52)) {
      const ErrorCounts errors = errors_of(run_of(*row, assign::Params(row->params), setting), setting);
      EXPECT_EQ(errors.false_negatives, 0u) << row->name << " on " << setting.name;
      EXPECT_EQ(errors.undecided, 0u) << row->name << " on " << setting.name;
    }
}

TEST(OccupiedCells, no_visible_surface_lacks_a_light_that_reaches_it) {
  for (const AssignerDescriptor* row : rows_with_depth())
    for (const Setting& setting : assign::testing::settings_for(*row, 53))
      for (const assign::Params& params : assign::testing::params_of(*row)) {
        const AtPixels counts = at_pixels(run_of(*row, params, setting), setting, 101);
        EXPECT_EQ(counts.missed, 0u) << row->name << " on " << setting.name;
        EXPECT_GT(counts.needed, 1000u) << setting.name;
      }
}

TEST(OccupiedCells, every_pixel_lies_in_one_part_of_its_cell_and_no_part_is_without_a_pixel) {
  for (const AssignerDescriptor* row : rows_with_cells())
    for (const Setting& setting : assign::testing::settings_for(*row, 54)) {
      if (!row->at_surfaces) continue;  // tile_slices_test.cpp
      const AssignerRun run = run_of(*row, assign::Params(row->params), setting);
      const grid::OccupiedCells cells = run.structure()->occupied_cells();
      std::vector<bool> holds_pixel(cells.parts.size());
      const grid::ScreenGrid& screen = setting.grid.screen();
      const auto tiles = static_cast<std::uint32_t>(cells.counts.x * cells.counts.y);
      for (const grid::Sample& sample : opaque_samples(setting.frame, setting.depth)) {
        const Vec2i tile = screen.tiles.tile_of(sample.pixel_x, sample.pixel_y);
        const auto index = static_cast<std::uint32_t>(tile.y * cells.counts.x + tile.x);
        std::uint32_t cell = index;
        if (cells.counts.z > 1) {
          const int slice = screen.slices.slice_of(-sample.view.z);
          if (slice < 0) continue;
          cell += static_cast<std::uint32_t>(slice) * tiles;
        }
        const Vec3d local = setting.frame.view_space.rotation * sample.from_eye;
        int parts = 0;
        for (std::uint32_t part = cells.begin[cell]; part < cells.begin[cell + 1]; ++part) {
          geom::FrustumCell wider = cells.parts[part];
          // Of the double that was turned to the world and back.
          const float slack = 1e-6f * std::fabs(wider.depth1);
          wider.depth0 -= slack;
          wider.depth1 += slack;
          if (!lies_in(wider, local)) continue;
          ++parts;
          holds_pixel[part] = true;
        }
        ASSERT_GE(parts, 1) << row->name << " on " << setting.name << " at depth " << -sample.view.z;
      }
      EXPECT_EQ(std::ranges::count(holds_pixel, false), 0) << row->name << " on " << setting.name;
    }
}

TEST(OccupiedCells, are_refused_before_they_take_more_memory_than_the_limit) {
  for (const AssignerDescriptor* row : rows_with_cells()) {
    const Setting setting = assign::testing::settings_for(*row, 7).front();
    const AssignerRun run = run_of(*row, assign::Params(row->params), setting);
    ASSERT_GT(run.structure()->occupied_cells().parts.size(), 100u) << row->name;
    const MemoryLimitScope little(100 * sizeof(geom::FrustumCell));
    EXPECT_THROW(run.structure()->occupied_cells(), Error) << row->name;
  }
}

TEST(OccupiedCells, truth_is_what_each_part_by_itself_is_decided_to_be) {
  for (const AssignerDescriptor* row : rows_with_cells())
    for (Setting setting : assign::testing::settings_for(*row, 55)) {
      const AssignerRun run = run_of(*row, assign::Params(row->params), setting);
      const grid::OccupiedCells cells = run.structure()->occupied_cells();
      const Truth truth = find_truth(setting.frame, setting.grid, cells, 1);
      EXPECT_EQ(truth.lists, find_truth(setting.frame, setting.grid, cells, 3).lists);
      for (std::uint32_t light = 0; light < setting.frame.lights.size(); light += 7) {
        const geom::LightVolume volume = view::volume_of(setting.frame.lights[light], setting.frame.view_space);
        for (std::uint32_t cell = light % 5; cell < cells.cell_count(); cell += 5) {
          bool is_true = false;
          for (const geom::FrustumCell& part : cells.of(cell))
            is_true =
                is_true || (geom::range_of(volume) > 0.0 && geom::decide_meets(volume, part) == geom::Verdict::yes);
          ASSERT_EQ(assign::testing::lists_light(truth.lists, cell, light), is_true)
              << row->name << " on " << setting.name << ", cell " << cell << ", light " << light;
        }
      }
    }
}

TEST(OccupiedCells, packed_lights_lose_nothing_once_they_are_inflated) {
  for (const AssignerDescriptor* row : rows_with_cells())
    for (const Setting& setting : assign::testing::settings_for(*row, 56)) {
      const view::LightArrays lights =
          view::inflated(view::packed(view::lights_in(setting.frame, setting.frame.view_space), view::Packing::half));
      AssignerRun run(*row, assign::Params(row->params), assign::Answer::structure);
      run.build(setting.grid);
      run.assign(setting.input(lights));
      EXPECT_EQ(errors_of(run, setting).false_negatives, 0u) << row->name << " on " << setting.name;
    }
}

// --- By hand: two tiles side by side ---

constexpr float k_no_surface = std::numeric_limits<float>::infinity();

// Slices from 1 to 2, 4, 8, 16, 32 m. A tile is as wide as it is deep; they meet at x = 0 unless the picture begins
// elsewhere. 20 x 10 pixels.
struct TwoTiles {
  Setting setting;

  explicit TwoTiles(const std::vector<scene::WorldLight>& lights, double left = -1.0) {
    view::Frame& frame = setting.frame;
    frame.viewport = {20, 10};
    frame.projection = {false, left, left + 2.0, -0.5, 0.5, 1, 100};
    frame.lights = lights;
    for (const scene::WorldLight& light : lights) frame.points += light.type == scene::LightType::point ? 1 : 0;
    grid::GridSpec spec;
    spec.tiles = {{0, 0}, {2, 1}};
    spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {1, 2, 4, 8, 16, 32}};
    setting.grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
    setting.depth = {depth::PixelGrid(frame.viewport, 1), std::vector<float>(200, k_no_surface)};
  }
  // Pixels of the left and the right tile, in turn.
  void show(const std::vector<float>& left, const std::vector<float>& right) {
    for (std::size_t i = 0; i < 200; ++i) {
      const std::vector<float>& of = i % 20 < 10 ? left : right;
      if (!of.empty()) setting.depth.nearest[i] = of[i % 10 % of.size()];
    }
  }
  AssignerRun run(const char* name, const std::map<std::string, assign::ParamValue>& given = {}) const {
    const AssignerDescriptor& row = *assign::find_assigner(name);
    return run_of(row, assign::Params(row.params, given), setting);
  }
};

std::vector<std::uint32_t> at(const AssignerRun& run, const TwoTiles& two, const Vec3d& place,
                              bool* is_answered = nullptr) {
  std::vector<std::uint32_t> lights;
  const bool answered = run.structure()->lights_at(sample_of(two.setting.frame, place), grid::Log2::rounded, lights);
  if (is_answered != nullptr) *is_answered = answered;
  return lights;
}

using Lights = std::vector<std::uint32_t>;
using assign::testing::point_light;
using assign::testing::spot_light;

TEST(Tiled, a_tile_lists_what_lies_between_its_depths) {
  TwoTiles two({point_light({2, 0, -5}, 1), point_light({5, 0, -10}, 1), point_light({8, 0, -20}, 1),
                point_light({-5, 0, -10}, 1), spot_light({5, 0, -8}, 6, {0, 0, -1}, 0.3)});
  two.show({30, k_no_surface}, {9, 12});
  const AssignerRun run = two.run("tiled");
  EXPECT_EQ(at(run, two, {5, 0, -10}), (Lights{1, 4}));
  EXPECT_EQ(at(run, two, {2, 0, -5}), (Lights{1, 4})) << "a tile's list is the same at all depths";
  EXPECT_EQ(at(run, two, {-5, 0, -10}), Lights()) << "before the wall that the tile shows";
  const grid::OccupiedCells cells = run.structure()->occupied_cells();
  EXPECT_EQ(cells.counts, Vec3i(2, 1, 1));
  ASSERT_EQ(cells.parts.size(), 2u);
  EXPECT_EQ(cells.parts[0].depth1, std::nextafter(30.0f, 31.0f)) << "without the sky beside";
  EXPECT_EQ(cells.parts[1].depth0, 9.0f);
  EXPECT_EQ(cells.parts[1].depth1, std::nextafter(12.0f, 13.0f));
}

TEST(Tiled, a_tile_of_only_sky_has_an_empty_list_and_beside_the_picture_there_is_no_answer) {
  TwoTiles two({point_light({-5, 0, -10}, 50)});
  two.show({}, {9});
  for (const char* name : {"tiled", "tiled-2.5d", "flagged", "explicit"}) {
    const AssignerRun run = two.run(name);
    bool is_answered = false;
    EXPECT_EQ(at(run, two, {-5, 0, -9.5}, &is_answered), Lights()) << name;
    EXPECT_TRUE(is_answered) << name;
    EXPECT_EQ(at(run, two, {5, 0, -9}), Lights{0}) << name;
    EXPECT_EQ(at(run, two, {90, 0, -9}, &is_answered), Lights()) << name;
    EXPECT_FALSE(is_answered) << name;
    EXPECT_EQ(at(run, two, {5, 0, 9}, &is_answered), Lights()) << name;
    EXPECT_FALSE(is_answered) << name;
  }
}

TEST(Tiled, one_depth_alone_is_a_flat_tile_with_all_lights_that_touch_it) {
  TwoTiles two({point_light({5, 0, -8}, 2), point_light({5, 0, -8}, 1.9), point_light({5, 0, -13}, 3),
                spot_light({5, 0, -8}, 2, {0, 0, -1}, 0.3), spot_light({5, 0, -8}, 1.9, {0, 0, -1}, 0.3)});
  two.show({10}, {10});
  for (const char* name : {"tiled", "tiled-2.5d", "explicit"}) {
    const AssignerRun run = two.run(name);
    const ErrorCounts errors = errors_of(run, two.setting);
    EXPECT_EQ(errors.false_negatives, 0u) << name;
    EXPECT_EQ(errors.undecided, 0u) << name;
    EXPECT_EQ(errors.true_pairs, 3u) << name << ": touching counts";
    EXPECT_EQ(at(run, two, {5, 0, -10}), (Lights{0, 2, 3})) << name;
    EXPECT_EQ(run.structure()->occupied_cells().parts.at(0).depth0, 10.0f) << name;
    EXPECT_EQ(run.structure()->occupied_cells().parts.at(0).depth1, std::nextafter(10.0f, 11.0f)) << name;
  }
}

TEST(Tiled, the_box_alone_lists_what_lies_beside_the_frustum_and_the_sides_alone_what_lies_beyond_its_edges) {
  // The box around the left tile from 5 to 30 m ends 30 m to the right.
  TwoTiles two({point_light({9, 0, -6}, 0.5), point_light({31.5, 0, -31.5}, 2), point_light({3, 0, -6}, 0.5)}, 0.0);
  two.show({5, 30}, {});
  const auto listed = [&](const char* test) {
    return two.run("tiled", {{"test", std::string(test)}}).cell_lists().lights;
  };
  EXPECT_EQ(listed("aabb"), (Lights{0, 2}));
  EXPECT_EQ(listed("planes"), (Lights{1, 2}));
  EXPECT_EQ(listed("both"), Lights{2});
}

TEST(NaiveMask, loses_a_light_that_reaches_only_the_farthest_pixel_of_a_tile) {
  const auto lost = [](const char* name, const scene::WorldLight& light, const std::vector<float>& depths) {
    TwoTiles two({light});
    two.show({}, depths);
    return errors_of(two.run(name), two.setting).false_negatives;
  };
  // Parts of half a metre from 2 to 18 m. The light ends in the last one, and only the farthest pixel lies there.
  const scene::WorldLight last = point_light({4, 0, -18.6}, 1), all = point_light({4, 0, -10}, 9);
  EXPECT_EQ(lost("naive-mask", last, {2, 18}), 1u);
  EXPECT_EQ(lost("naive-mask", last, {2, 17.8f, 18}), 0u) << "another pixel has the bit";
  EXPECT_EQ(lost("naive-mask", all, {2, 18}), 0u);
  EXPECT_EQ(lost("naive-mask", point_light({4, 0, -19.5}, 4), {2, 18}), 1u) << "2.5 m deep into the light";
  for (const scene::WorldLight& light : {last, all}) EXPECT_EQ(lost("tiled-2.5d", light, {2, 18}), 0u);
}

TEST(Tiled25D, a_light_between_two_surfaces_is_left_out_and_one_at_either_is_not) {
  TwoTiles two({point_light({5, 0, -30}, 2), point_light({2, 0, -6}, 2), point_light({10, 0, -50}, 2)});
  two.show({}, {5, 60});
  EXPECT_EQ(two.run("tiled").cell_lists().lights, (Lights{0, 1, 2}));
  const AssignerRun run = two.run("tiled-2.5d");
  EXPECT_EQ(run.cell_lists().lights, Lights{1});
  EXPECT_EQ(errors_of(run, two.setting).false_positives, 0u);
  const grid::OccupiedCells cells = run.structure()->occupied_cells();
  ASSERT_EQ(cells.parts.size(), 2u);
  EXPECT_EQ(cells.parts[0].depth0, 5.0f);
  EXPECT_NEAR(cells.parts[0].depth1, 5.0 + 55.0 / 32, 1e-5);
  EXPECT_EQ(cells.parts[1].depth1, std::nextafter(60.0f, 61.0f));
  EXPECT_EQ(two.run("tiled-2.5d").structure()->occupied_cells().of(0).size(), 0u);
}

TEST(Tiled25D, the_mask_has_32_parts_and_no_33rd) {
  const assign::DepthParts parts(2.0f, 34.0f);
  EXPECT_EQ(parts.part_of(2.0f), 0);
  EXPECT_EQ(parts.part_of(2.999f), 0);
  EXPECT_EQ(parts.part_of(3.0f), 1);
  EXPECT_EQ(parts.part_of(33.5f), 31);
  EXPECT_EQ(parts.part_of(34.0f), 31) << "Wicked's clamp lets part 32 through";
  EXPECT_EQ(parts.part_of(-k_no_surface), 0);
  EXPECT_EQ(parts.part_of(k_no_surface), 31);
  EXPECT_EQ(parts.bits_between(-1.0f, 100.0f), ~0u);
  EXPECT_EQ(parts.bits_between(3.5f, 5.5f), 0b1110u);
  EXPECT_EQ(parts.bits_between(40.0f, 50.0f), 1u << 31) << "kept to the range by the test of depths";
  EXPECT_EQ(assign::DepthParts(7.0f, 7.0f).bits_between(6.0f, 8.0f), 1u);
  EXPECT_EQ(assign::DepthParts(7.0f, std::nextafter(7.0f, 8.0f)).part_of(std::nextafter(7.0f, 8.0f)), 31);
  EXPECT_EQ(assign::DepthParts(0.0f, std::numeric_limits<float>::denorm_min()).part_of(0.0f), 0);
}

TEST(Flagged, cells_without_pixels_have_no_list_and_explicit_ones_reach_no_farther_than_their_pixels) {
  // Both in the slice from 8 to 16 m of the right tile; one where no pixel lies.
  TwoTiles two({point_light({5, 0, -9}, 0.5), point_light({7, 0, -14}, 0.5), point_light({3, 0, -5}, 0.5)});
  two.show({}, {13.5f, 14, 20});
  const AssignerRun flagged = two.run("flagged"), cut = two.run("explicit");
  EXPECT_EQ(flagged.cell_lists().lights, (Lights{0, 1}));
  EXPECT_EQ(cut.cell_lists().lights, Lights{1});
  EXPECT_EQ(at(flagged, two, {3, 0, -5}), Lights()) << "in the air";
  EXPECT_EQ(flagged.structure()->occupied_cells().counts, Vec3i(2, 1, 5));
  EXPECT_EQ(flagged.structure()->occupied_cells().parts.size(), 2u);
  EXPECT_EQ(cut.structure()->occupied_cells().parts.at(0).depth0, 13.5f);
}

TEST(OccupiedCells, are_tighter_the_more_they_know_of_the_depths) {
  for (const Setting& setting : assign::testing::settings_for(*assign::find_assigner("tiled"), 57)) {
    const auto evaluated = [&](const char* name) {
      const AssignerDescriptor& row = *assign::find_assigner(name);
      return at_pixels(run_of(row, assign::Params(row.params), setting), setting, 307).evaluated;
    };
    EXPECT_LT(evaluated("tiled-2.5d"), evaluated("tiled")) << setting.name;
    EXPECT_LT(evaluated("flagged"), evaluated("tiled")) << setting.name;
    EXPECT_LT(evaluated("explicit"), evaluated("flagged")) << setting.name;
  }
}

TEST(OccupiedCells, depths_that_are_missing_or_of_another_picture_are_refused) {
  TwoTiles two({point_light({5, 0, -9}, 0.5)});
  const view::LightArrays lights = view::lights_in(two.setting.frame, two.setting.frame.view_space);
  const AssignerDescriptor& row = *assign::find_assigner("tiled");
  AssignerRun run(row, assign::Params(row.params), assign::Answer::structure);
  run.build(two.setting.grid);
  EXPECT_THROW(run.assign({two.setting.frame, lights}), Error);
  const depth::DepthImage coarse{depth::PixelGrid({20, 10}, 2), std::vector<float>(50, 3.0f)};
  EXPECT_THROW(run.assign({two.setting.frame, lights, &coarse}), Error);
}

}  // namespace
}  // namespace clusterbench::measure
