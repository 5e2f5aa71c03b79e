// Each naive form loses a light that the careful form of the same method finds.

#include <gtest/gtest.h>

#include "assign/contract/assigner_run.h"
#include "assign/dense_check.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure {
namespace {

using assign::testing::point_light;
using assign::testing::spot_light;

struct Case {
  view::Frame frame;
  grid::Grid grid;
};

Case case_of(const scene::WorldLight& light, Vec2i tiles, int slices, double first_m, double far_m,
             Vec2i viewport = {1920, 1080}) {
  Case made;
  const double aspect = static_cast<double>(viewport.x) / viewport.y;
  made.frame = assign::testing::frame_of(assign::testing::perspective(M_PI / 3, aspect, 0.1, far_m), viewport, {light});
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, tiles};
  spec.slices.scheme = first_m > 0.0 ? grid::Scheme::exponential_first : grid::Scheme::exponential;
  spec.slices.count = slices;
  spec.slices.near_m = 0.1;
  spec.slices.first_m = first_m;
  spec.slices.far_m = far_m;
  made.grid = grid::make_grid(spec, grid::grid_inputs(spec, made.frame, 0.0, {}, {}));
  return made;
}

// True cells that the method leaves out.
int lost_cells(const Case& case_text, const std::string& name,
               const std::map<std::string, assign::ParamValue>& params = {}) {
  const assign::AssignerDescriptor& row = *assign::find_assigner(name);
  const auto assigner = row.make(assign::Params(row.params, params));
  assigner->build(case_text.grid);
  assign::Lists lists;
  assigner->assign({case_text.frame, view::lights_in(case_text.frame, case_text.frame.view_space)}, lists);
  const Truth truth = find_truth(case_text.frame, case_text.grid, 1);
  EXPECT_EQ(truth.undecided, 0u);
  EXPECT_GT(truth.lists.pair_count(), 0u);
  int lost = 0;
  for (std::uint32_t cell = 0; cell < truth.lists.cell_count(); ++cell)
    lost += static_cast<int>(truth.lists.of(cell).size() > lists.of(cell).size());
  return lost;
}

int lost_by_flaw(const Case& case_text, const std::string& name, const std::string& flaw) {
  return lost_cells(case_text, name, {{"flaw", flaw}});
}

TEST(NaiveForm, a_centre_row_that_is_not_taken_again_loses_a_light) {
  const Case case_text = case_of(point_light({24.3343582, -12.6534967, -24.6891174}, 13), {12, 12}, 24, 0.0, 400);
  EXPECT_GT(lost_cells(case_text, "naive-refinement"), 0);
  EXPECT_EQ(lost_cells(case_text, "sphere-refinement"), 0);
}

TEST(NaiveForm, a_fast_logarithm_in_the_bounds_loses_a_slice) {
  const Case case_text = case_of(point_light({-16.7833176, 14.3895569, -103.066628}, 3), {12, 12}, 24, 0.141282, 400);
  EXPECT_GT(lost_by_flaw(case_text, "naive-bounds", "fast-log-slice"), 0);
  EXPECT_EQ(lost_cells(case_text, "bounds"), 0);
}

TEST(NaiveForm, another_base_of_the_logarithm_loses_a_slice_at_its_boundary) {
  // A light that ends one step before a boundary of a grid with many slices over a great range.
  int lost = 0;
  for (int slice = 8; slice < 56; ++slice) {
    Case case_text = case_of(point_light({0, 0, -10}, 1), {8, 8}, 64, 0.0, 1e6);
    const float boundary = case_text.grid.screen().slices.boundaries[static_cast<std::size_t>(slice)];
    const double radius = 0.125 * boundary;
    case_text.frame.lights = {point_light({0, 0, -static_cast<double>(boundary) - radius * (1 - 1e-7)}, radius)};
    lost += lost_by_flaw(case_text, "naive-bounds", "log-slice");
    EXPECT_EQ(lost_cells(case_text, "bounds"), 0);
  }
  EXPECT_GT(lost, 0);
}

// Huge lights whose tangent passes a tile's plane by less than cancellation leaves of it.
TEST(NaiveForm, tangents_that_cancel_lose_tiles_of_a_huge_light) {
  int lost = 0;
  for (int i = 0; i < 40; ++i) {
    const double r = 1e6, gap = 1.0 + 0.25 * i;
    Case case_text = case_of(point_light({0, 0, -10}, 1), {60, 34}, 16, 5.0, 1e6);
    const double tangent = std::atan(case_text.grid.screen().tiles.x[static_cast<std::size_t>(10 + i)]) - 2e-6;
    const double center = tangent + std::asin(r / (r + gap));
    case_text.frame.lights = {point_light({(r + gap) * std::sin(center), 0.0, -(r + gap) * std::cos(center)}, r)};
    lost += lost_by_flaw(case_text, "naive-bounds", "textbook-tangents");
    EXPECT_EQ(lost_cells(case_text, "bounds"), 0);
  }
  EXPECT_GT(lost, 0);
}

TEST(NaiveForm, whole_tiles_only_lose_the_right_edge_of_the_screen) {
  Case case_text = case_of(point_light({9.9, 0.0, -10}, 0.5), {16, 9}, 16, 5.0, 500, {1000, 700});
  case_text.grid = [&] {
    grid::GridSpec spec;
    spec.tiles = {{64, 64}, {0, 0}};
    spec.slices.near_m = 0.1;
    spec.slices.far_m = 500;
    return grid::make_grid(spec, grid::grid_inputs(spec, case_text.frame, 0.0, {}, {}));
  }();
  case_text.frame.lights = {point_light({case_text.frame.projection.right * 9.8, 0.0, -10}, 0.1)};
  EXPECT_GT(lost_by_flaw(case_text, "naive-bounds", "tile-division"), 0);
  EXPECT_EQ(lost_cells(case_text, "bounds"), 0);
}

TEST(NaiveForm, a_tile_size_that_is_rounded_up_loses_a_spot) {
  const Case case_text =
      case_of(spot_light({32.4449654, -17.4399338, -90.1848755}, 29.1207905, {.131388, -.724634, .676493}, .0865885),
              {61, 50}, 16, 5.0, 500);
  EXPECT_GT(lost_by_flaw(case_text, "naive-bounds", "padded-tiles"), 0);
  for (const char* careful : {"bounds", "aabb", "sphere-refinement", "exact"})
    EXPECT_EQ(lost_cells(case_text, careful), 0);
}

// A searchlight of 0.01 degrees is 16 m wide after 90 km; with a sine of 0 it is a line.
TEST(NaiveForm, a_sine_from_the_cosine_loses_a_narrow_spot) {
  const Case case_text =
      case_of(spot_light({-9e4, 0.3, -50}, 1e5, {1, 0, 0}, 0.01 * M_PI / 180), {60, 34}, 40, 5.0, 500);
  EXPECT_GT(lost_by_flaw(case_text, "naive-cone", "sine-from-cosine"), 0);
  for (const char* careful : {"aabb", "sphere-refinement", "exact"}) EXPECT_EQ(lost_cells(case_text, careful), 0);
}

// Lights that the structure of a method's own gives at a pixel, 10 m away.
std::vector<std::uint32_t> given_at(const Case& case_text, const std::string& name, double pixel_x, double pixel_y) {
  const assign::AssignerDescriptor& row = *assign::find_assigner(name);
  assign::AssignerRun run(row, assign::Params(row.params), assign::Answer::structure);
  run.build(case_text.grid);
  run.assign({case_text.frame, view::lights_in(case_text.frame, case_text.frame.view_space)});
  const view::Projection& sides = case_text.frame.projection;
  const Vec3d at{10 * (sides.left + (sides.right - sides.left) * pixel_x / case_text.frame.viewport.x),
                 10 * (sides.top + (sides.bottom - sides.top) * pixel_y / case_text.frame.viewport.y), -10};
  std::vector<std::uint32_t> lights;
  run.structure()->lights_at({static_cast<float>(pixel_x), static_cast<float>(pixel_y), Vec3f(at), at, Vec3d(0.0)},
                             grid::Log2::rounded, lights);
  return lights;
}

// 1000 x 700 pixels in 12 x 12 tiles: 83 x 58 pixels each, which end at 996 and 696.
TEST(NaiveForm, tile_sizes_of_whole_pixels_read_another_cell_behind_the_last_tile) {
  using Lights = std::vector<std::uint32_t>;
  const auto case_in = [](Vec2i viewport) {
    Case made = case_of(point_light({0, 0, -10}, 1), {12, 12}, 24, 0.0, 400, viewport);
    const view::Projection& sides = made.frame.projection;
    // One on the right edge of the picture, half down; one on the left edge, a row of tiles lower.
    const double row_m = 10 * (sides.top - sides.bottom) / 12;
    made.frame.lights = {point_light({10 * sides.right, -0.5 * row_m, -10}, 0.2),
                         point_light({10 * sides.left, -1.5 * row_m, -10}, 0.2)};
    made.frame.points = 2;
    return made;
  };
  const Case odd = case_in({1000, 700}), even = case_in({996, 696});
  EXPECT_EQ(given_at(odd, "naive-tile-size", 998.5, 379.5), Lights{1}) << "the next row's first tile";
  EXPECT_EQ(given_at(even, "naive-tile-size", 994.5, 377.5), Lights{0}) << "sizes that are whole";
  EXPECT_EQ(given_at(odd, "naive-tile-size", 1.5, 437.5), Lights{1});
  EXPECT_EQ(given_at(odd, "z-binning", 998.5, 379.5), Lights{0});
  EXPECT_EQ(given_at(odd, "naive-tile-size", 998.5, 698.5), Lights()) << "the next slice's second row";
}

TEST(NaiveForm, a_loose_form_loses_nothing_and_lists_more) {
  const Case case_text = case_of(spot_light({3, 1, -20}, 15, {0.5, -0.3, -0.8}, 0.6), {30, 17}, 16, 5.0, 500);
  const auto pairs = [&](const std::string& name, const std::map<std::string, assign::ParamValue>& params) {
    const assign::AssignerDescriptor& row = *assign::find_assigner(name);
    const auto assigner = row.make(assign::Params(row.params, params));
    assigner->build(case_text.grid);
    assign::Lists lists;
    assigner->assign({case_text.frame, view::lights_in(case_text.frame, case_text.frame.view_space)}, lists);
    return lists.pair_count();
  };
  for (const char* flaw : {"no-range", "flat-cap-sphere"}) {
    EXPECT_EQ(lost_by_flaw(case_text, "naive-cone", flaw), 0) << flaw;
    EXPECT_GT(pairs("naive-cone", {{"flaw", std::string(flaw)}}), pairs("sphere-refinement", {})) << flaw;
  }
  EXPECT_EQ(lost_cells(case_text, "naive-planes"), 0);
  EXPECT_GE(pairs("naive-planes", {}), pairs("planes", {}));
}

}  // namespace
}  // namespace clusterbench::measure
