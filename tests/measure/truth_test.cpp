#include "measure/truth/truth.h"
#include "assign/contract/assigner_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include "assign/contract/assigner.h"
#include "core/random.h"
#include "geom/filter/light_filter.h"
#include "geom/light_meets_cell.h"
#include "geom/shapes/verdict.h"
#include "measure/truth/truth_cells.h"
#include "places.h"
#include "scene/camera_path.h"

namespace clusterbench::measure {
namespace {

using geom::Verdict;
using grid::Kind;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

// Coordinates on a lattice of the grid's own boundaries make many exact ties; the rest is anywhere.
double place(SplitMix64& random, double lo, double hi) {
  const double value = random.between(lo, hi);
  return random.below(3) == 0 ? std::round(value) : value;
}

view::Frame frame_with(int points, int spots, std::uint64_t seed, bool orthographic) {
  SplitMix64 random(seed);
  view::Frame frame;
  frame.viewport = {160, 90};
  frame.projection = {orthographic, -1.0, 1.0, -0.75, 0.5, 0.5, 64.0};
  if (orthographic) frame.projection = {true, -16.0, 16.0, -8.0, 8.0, -2.0, 40.0};
  for (int i = 0; i < points + spots; ++i) {
    scene::WorldLight light;
    light.rig_index = i;
    light.type = i < points ? scene::LightType::point : scene::LightType::spot;
    light.position = {place(random, -25, 25), place(random, -15, 15), place(random, -50, 8)};
    light.range_m = place(random, 1.0, 14.0);
    light.direction = glm::normalize(Vec3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
    light.outer_cone_rad = random.between(0.02, 1.57);
    frame.lights.push_back(light);
  }
  frame.points = static_cast<std::uint32_t>(points);
  return frame;
}

grid::Grid small_grid(Kind kind, const view::Frame& frame) {
  grid::GridSpec spec;
  spec.kind = kind;
  spec.tiles.count = {8, 6};
  spec.slices = {.scheme = grid::Scheme::linear, .count = 8, .far_m = 40.0, .boundaries_m = {}};
  spec.cells = kind == Kind::cascades ? Vec3i{8, 8, 4} : Vec3i{8, 6, 7};
  spec.levels = 3;
  spec.finest_m = 2.0;
  return grid::make_grid(spec, grid::grid_inputs(spec, frame, 40.0, {-30, -20, -60}, {30, 20, 20}));
}

// Every light against every cell, each decided on its own.
assign::Lists decided_one_by_one(const view::Frame& frame, const grid::Grid& grid) {
  const view::Space space = grid::space_of(grid, frame);
  assign::PairBuffer pairs;
  pairs.start(grid.cell_count());
  for (std::uint32_t i = 0; i < frame.lights.size(); ++i) {
    const scene::WorldLight& light = frame.lights[i];
    const geom::LightVolume volume = view::volume_of(light, space);
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
      if (grid.is_hole(cell)) continue;
      Verdict verdict = geom::filter_meets(volume, grid.cell(cell));
      if (verdict == Verdict::uncertain) verdict = geom::prove_meets(volume, grid.cell(cell));
      if (verdict != Verdict::no) pairs.add(cell, i);
    }
  }
  assign::Lists lists;
  pairs.finish(lists);
  return lists;
}

struct KindOfView {
  Kind kind;
  bool orthographic;
};

class TruthOn : public testing::TestWithParam<KindOfView> {};

TEST_P(TruthOn, rows_and_tiles_find_what_deciding_every_cell_alone_finds) {
  const view::Frame frame = frame_with(60, 60, 17, GetParam().orthographic);
  const grid::Grid grid = small_grid(GetParam().kind, frame);
  const Truth truth = find_truth(frame, grid, 1);
  EXPECT_EQ(truth.lists, decided_one_by_one(frame, grid));
  EXPECT_GT(truth.lists.pair_count(), 400u);
  EXPECT_GT(truth.filter_decided, truth.lists.pair_count() / 2);
}

// Cells that no grid has: each is a cell of a grid and the one before it. Without an accelerator.
class PairsOfCells final : public TruthCells {
 public:
  PairsOfCells(const view::Frame& frame, const grid::Grid& grid) : grid_(grid), space_(grid::space_of(grid, frame)) {}

  std::uint32_t cell_count() const override { return grid_.cell_count(); }
  const view::Space& space() const override { return space_; }
  void decide(std::uint32_t cell, const grid::IndexRange&, LightSearch& search) const override {
    search.decide(cell, [&] {
      return meets_any(parts(cell), [&](std::uint32_t part) { return search.decided(grid_.cell(part)); });
    });
  }
  static std::vector<std::uint32_t> parts(std::uint32_t cell) { return {cell, cell == 0 ? 0 : cell - 1}; }

 private:
  const grid::Grid& grid_;
  view::Space space_;
};

TEST_P(TruthOn, cells_of_any_kind_need_no_more_than_a_decision) {
  const view::Frame frame = frame_with(30, 30, 19, GetParam().orthographic);
  const grid::Grid grid = small_grid(GetParam().kind == Kind::cascades ? Kind::world : GetParam().kind, frame);
  const assign::Lists alone = decided_one_by_one(frame, grid);
  const Truth truth = find_truth(frame, PairsOfCells(frame, grid), 2);
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
    std::set<std::uint32_t> wanted;
    for (const std::uint32_t part : PairsOfCells::parts(cell))
      wanted.insert(alone.of(part).begin(), alone.of(part).end());
    EXPECT_TRUE(std::ranges::equal(truth.lists.of(cell), wanted)) << cell;
  }
  EXPECT_GT(truth.lists.pair_count(), alone.pair_count());
}

TEST_P(TruthOn, the_number_of_threads_does_not_show) {
  const view::Frame frame = frame_with(200, 50, 23, GetParam().orthographic);
  const grid::Grid grid = small_grid(GetParam().kind, frame);
  const Truth single = find_truth(frame, grid, 1), two = find_truth(frame, grid, 2);
  EXPECT_EQ(single.lists, two.lists);
  EXPECT_EQ(single.filter_decided, two.filter_decided);
  EXPECT_EQ(single.exact_decided, two.exact_decided);
}

TEST_P(TruthOn, no_conservative_assigner_misses_a_true_pair) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const view::Frame frame = frame_with(150, 150, seed, GetParam().orthographic);
    const grid::Grid grid = small_grid(GetParam().kind, frame);
    const Truth truth = find_truth(frame, grid, 2);
    const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
    for (const assign::AssignerDescriptor* row : assign::assigner_descriptors()) {
      if (!row->conservative || !row->takes(GetParam().kind) || (GetParam().orthographic && !row->orthographic))
        continue;
      if (row->needs.depth) continue;  // their cells are not the grid's: occupied_cells_test.cpp
      const assign::Params params(row->params);
      for (const assign::Answer answer : assign::answers_with_cells(*row, params)) {
        assign::AssignerRun run(*row, params, answer);
        run.build(grid);
        run.assign({frame, lights});
        const assign::Lists& lists = run.cell_lists();
        for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
          const auto wanted = truth.lists.of(cell), listed = lists.of(cell);
          EXPECT_TRUE(std::includes(listed.begin(), listed.end(), wanted.begin(), wanted.end()))
              << row->name << " cell " << cell << " seed " << seed;
        }
      }
    }
  }
}

TEST_P(TruthOn, a_light_without_range_is_nowhere_and_one_without_end_is_in_every_cell) {
  view::Frame frame = frame_with(2, 0, 3, GetParam().orthographic);
  frame.lights[0].range_m = 0.0;
  frame.lights[1].range_m = k_infinity;
  const grid::Grid grid = small_grid(GetParam().kind, frame);
  const Truth truth = find_truth(frame, grid, 1);
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
    const std::vector<std::uint32_t> listed(truth.lists.of(cell).begin(), truth.lists.of(cell).end());
    EXPECT_EQ(listed, grid.is_hole(cell) ? std::vector<std::uint32_t>{} : std::vector<std::uint32_t>{1});
  }
}

TEST_P(TruthOn, lists_do_not_change_when_camera_and_lights_move_far_away_together) {
  view::Frame frame = frame_with(60, 20, 31, GetParam().orthographic);
  for (scene::WorldLight& light : frame.lights) light.position = glm::round(light.position * 64.0) / 64.0;
  const grid::Grid grid = small_grid(GetParam().kind, frame);
  if (GetParam().kind == Kind::world) GTEST_SKIP() << "a world grid does not move with the camera";
  const Truth here = find_truth(frame, grid, 1);
  const Vec3d offset{1e7, -1e6, 4e6};
  frame.view_space.origin += offset;
  for (scene::WorldLight& light : frame.lights) light.position += offset;
  EXPECT_EQ(find_truth(frame, grid, 1).lists, here.lists);
}

// A range that ends far beyond the grid tells as much as one that ends just beyond it, and costs no more.
TEST_P(TruthOn, a_range_far_beyond_the_grid_needs_no_exact_decisions) {
  view::Frame frame = frame_with(10, 20, 31, GetParam().orthographic);
  const grid::Grid grid = small_grid(GetParam().kind, frame);
  for (scene::WorldLight& light : frame.lights) light.range_m = 300.0;
  const Truth near = find_truth(frame, grid, 1);
  for (scene::WorldLight& light : frame.lights) light.range_m = 1e15;
  const Truth far = find_truth(frame, grid, 1);
  EXPECT_EQ(near.lists, far.lists);
  EXPECT_EQ(far.lists, decided_one_by_one(frame, grid));
  EXPECT_LE(far.exact_decided, near.exact_decided);
  EXPECT_EQ(far.undecided, 0u);
}

// A camera far away and askew: places in its space are no numbers of double precision.
view::Space far_and_turned() {
  const Vec3d back = glm::normalize(Vec3d{0.3, 0.2, 0.9}), right = glm::normalize(glm::cross(Vec3d{0.1, 1, 0}, back));
  return {{2000, -30, 1000}, glm::transpose(Mat3d{right, glm::cross(back, right), back})};
}

// The least range with which the light touches the cell, to the last bit.
double touching_range(const geom::LightVolume& light, const geom::Cell& cell) {
  double apart = 0.0, touching = 256.0;
  for (;;) {
    const double range = 0.5 * (apart + touching);
    if (range <= apart || range >= touching) return touching;
    const geom::LightVolume shorter = geom::with_range(light, range);
    Verdict verdict = geom::filter_meets(shorter, cell);
    if (verdict == Verdict::uncertain) verdict = geom::prove_meets(shorter, cell);
    (verdict == Verdict::no ? apart : touching) = range;
  }
}

// Rows are found in double precision, which is wrong about half of these lights; the slack has to leave them to exact
// arithmetic.
TEST_P(TruthOn, a_light_whose_range_ends_at_a_cell_is_there_and_one_that_is_a_bit_shorter_is_not) {
  view::Frame frame = frame_with(GetParam().kind == Kind::distance ? 20 : 200, 0, 71, GetParam().orthographic);
  frame.view_space = far_and_turned();
  const grid::Grid grid = small_grid(GetParam().kind, frame);
  const view::Space space = grid::space_of(grid, frame);
  SplitMix64 random(72);
  std::vector<scene::WorldLight> lights;
  std::vector<std::uint32_t> cells;
  for (scene::WorldLight light : frame.lights) {
    const auto cell = static_cast<std::uint32_t>(random.below(grid.cell_count()));
    if (grid.is_hole(cell)) continue;
    light.position = glm::transpose(space.rotation) * light.position + space.origin;
    light.range_m = touching_range(view::volume_of(light, space), grid.cell(cell));
    if (light.range_m < 1e-3) continue;  // in the cell
    lights.push_back(light);
    light.range_m = std::nextafter(light.range_m, 0.0);
    lights.push_back(light);
    cells.push_back(cell);
  }
  frame.lights = lights;
  frame.points = static_cast<std::uint32_t>(lights.size());
  const Truth truth = find_truth(frame, grid, 2);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto listed = truth.lists.of(cells[i]);
    const auto lists = [&](std::size_t light) {
      return std::binary_search(listed.begin(), listed.end(), static_cast<std::uint32_t>(light));
    };
    EXPECT_TRUE(lists(2 * i)) << "cell " << cells[i];
    EXPECT_FALSE(lists(2 * i + 1)) << "cell " << cells[i];
  }
  EXPECT_GT(cells.size(), 9u);
}

INSTANTIATE_TEST_SUITE_P(Grids, TruthOn,
                         testing::Values(KindOfView{Kind::frustum, false}, KindOfView{Kind::frustum, true},
                                         KindOfView{Kind::distance, false}, KindOfView{Kind::cascades, false},
                                         KindOfView{Kind::world, false}),
                         [](const auto& setting) {
                           return std::string(grid::kind_name(setting.param.kind)) +
                                  (setting.param.orthographic ? "_orthographic" : "");
                         });

// Candidates far from the eye were once off by more than the filter's tolerance, and a "no" rested on them.
TEST(Truth, has_the_shell_that_a_narrow_spot_of_a_metre_reaches_745_m_away) {
  view::Frame frame;
  frame.viewport = {1920, 1080};
  const double top = std::tan(0.5 * 1.0471975511965976), right = top * 1920.0 / 1080.0;
  frame.projection = {false, -right, right, -top, top, 0.1, 1000.0};
  scene::WorldLight light;
  light.type = scene::LightType::spot;
  light.position = {282.75256402860356, 20.690891589702524, -688.8109666164794};
  light.range_m = 0.7624139998386921;
  light.direction = {0.13774809289466936, -0.71480981173595926, 0.68561825818007845};
  light.outer_cone_rad = 0.09055462037691484;
  // Which roundoffs lose the shell is chance.
  for (int ulps = 0; ulps < 64; ++ulps) {
    frame.lights.push_back(light);
    light.direction.y = std::nextafter(light.direction.y, 0.0);
  }
  grid::GridSpec spec;
  spec.kind = Kind::distance;
  spec.tiles.pixels = {64, 64};
  spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {0.1, 744.811279296875, 1000.0}};
  const grid::Grid grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
  const Truth truth = find_truth(frame, grid, 1);
  EXPECT_EQ(truth.lists.pair_count(), 8u * frame.lights.size());
  EXPECT_EQ(truth.lists.of(230).size(), frame.lights.size());
}

TEST(RelativeDistance, is_the_share_of_the_range_at_which_the_light_begins_to_touch_the_cell) {
  view::Frame frame = frame_with(1, 0, 1, false);
  frame.lights[0].position = {0.0, 0.0, -10.0};
  frame.lights[0].range_m = 20.0;
  grid::GridSpec spec;
  spec.tiles.count = {1, 1};
  spec.slices = {.scheme = grid::Scheme::list, .boundaries_m = {0.5, 15.0, 64.0}};
  const grid::Grid grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
  EXPECT_NEAR(relative_distance(frame, grid, 1, 0), 0.25, 1e-9);
  EXPECT_NEAR(relative_distance(frame, grid, 0, 0), 0.0, 1e-9);
}

struct Workload {
  const char* name;
  Vec2i tiles;
  grid::Scheme scheme;
  int slices;
  double far_m;
  std::uint32_t true_pairs;
  std::uint32_t bevy_reported = 0, bevy_lost = 0;  // by Bevy itself; 0: not compared
};

class PeerWorkload : public testing::TestWithParam<Workload> {};

// Figures of an oracle that was written independently of this project. W5 there has 30 x 17 equal tiles.
TEST_P(PeerWorkload, has_the_true_pairs_that_an_independent_oracle_found) {
  const Workload& work = GetParam();
  scene::Scene scene = scene::load_gltf(test::source_dir() + "/scenes/peers/" + std::string(work.name) + ".gltf");
  scene::resolve_ranges(scene, {});
  const auto paths = scene::camera_paths(scene, {});
  const view::Frame frame = view::make_frame(scene, paths.at(0).shots.at(0), 0, {1920, 1080});
  grid::GridSpec spec;
  spec.tiles = {.pixels = {0, 0}, .count = work.tiles};
  spec.slices = {.scheme = work.scheme,
                 .count = work.slices,
                 .near_m = 0.1,
                 .first_m = 5.0,
                 .far_m = work.far_m,
                 .boundaries_m = {}};
  const grid::Grid grid = grid::make_grid(spec, grid::grid_inputs(spec, frame, 0.0, {}, {}));
  const Truth truth = find_truth(frame, grid, 2);
  EXPECT_EQ(truth.lists.pair_count(), work.true_pairs);
  EXPECT_EQ(truth.undecided, 0u);
  if (work.bevy_reported == 0) return;
  const auto bevy = assign::find_assigner("bevy-refinement")->make({});
  bevy->build(grid);
  assign::Lists lists;
  bevy->assign({frame, view::lights_in(frame, frame.view_space)}, lists);
  EXPECT_EQ(lists.pair_count(), work.bevy_reported);
  std::uint32_t lost = 0;
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    for (const std::uint32_t light : truth.lists.of(cell))
      lost += std::ranges::find(lists.of(cell), light) == lists.of(cell).end() ? 1 : 0;
  EXPECT_EQ(lost, work.bevy_lost);
}

INSTANTIATE_TEST_SUITE_P(
    Peers, PeerWorkload,
    testing::Values(Workload{"W1", {12, 12}, grid::Scheme::exponential, 24, 400.0, 15006, 16224, 19},
                    Workload{"W2", {12, 12}, grid::Scheme::exponential, 24, 400.0, 4649, 4837, 1},
                    Workload{"W3", {12, 12}, grid::Scheme::exponential, 24, 400.0, 5032, 5121, 2},
                    Workload{"W4", {12, 12}, grid::Scheme::exponential, 24, 400.0, 6077, 6493, 0},
                    Workload{"W5", {30, 17}, grid::Scheme::exponential_first, 16, 500.0, 4154},
                    Workload{"W7", {32, 18}, grid::Scheme::exponential, 64, 120.0, 98044, 110042, 121}),
    [](const auto& work) { return std::string(work.param.name); });

}  // namespace
}  // namespace clusterbench::measure
