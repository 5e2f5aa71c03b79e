// Lists of gpu-refined: those of gpu-group without what the test of the cell itself drops. No true pair is dropped, and
// hardly a false one is left.

#include "effort.h"
#include "geom/light_meets_cell.h"
#include "gpu/device_test.h"
#include "gpu/reference_lists.h"

namespace clusterbench::gpu {
namespace {

using assign::Lists;
using assign::Params;
using assign::testing::Setting;
using testing::first_difference;
using testing::lists_of;

class DeviceRefined : public testing::DeviceTest {
 protected:
  static const assign::AssignerDescriptor& refined() { return *assign::find_assigner("gpu-refined"); }
  static const assign::AssignerDescriptor& group() { return *assign::find_assigner("gpu-group"); }
};

// --- apart.glsl, in the same steps ---

float inverse_in_steps(float x) {
  float guess = std::bit_cast<float>(0x7ef311c7u - std::bit_cast<std::uint32_t>(x));
  for (int turn = 0; turn < 3; ++turn) guess = guess * (2.0f - x * guess);
  return guess;
}

float side_beyond(float at, float lo, float hi, float depth) {
  return at < lo * depth ? lo : at > hi * depth ? hi : 0.0f;
}

std::pair<float, float> slopes_along(const Vec3f& n, const geom::FrustumCell& cell) {
  return {n.x > 0.0f ? cell.x1 : cell.x0, n.y > 0.0f ? cell.y1 : cell.y0};
}

// Both as (x, y, depth).
Vec3f way_out(const Vec3f& center, const geom::FrustumCell& cell) {
  float depth = std::clamp(center.z, cell.depth0, cell.depth1);
  for (int turn = 0; turn < 3; ++turn) {
    const float x = side_beyond(center.x, cell.x0, cell.x1, depth), y = side_beyond(center.y, cell.y0, cell.y1, depth);
    const float least = (center.z + x * center.x + y * center.y) * inverse_in_steps(1.0f + x * x + y * y);
    depth = std::clamp(least, cell.depth0, cell.depth1);
  }
  Vec3f way{center.x - std::clamp(center.x, cell.x0 * depth, cell.x1 * depth),
            center.y - std::clamp(center.y, cell.y0 * depth, cell.y1 * depth), center.z - depth};
  const auto [x, y] = slopes_along(way, cell);
  const float normal = -(way.x * x + way.y * y);
  way.z = depth <= cell.depth0 ? std::min(way.z, normal) : depth >= cell.depth1 ? std::max(way.z, normal) : normal;
  const float size = std::max({std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)});
  return way * std::bit_cast<float>((254u << 23) - (std::bit_cast<std::uint32_t>(size) & 0x7f800000u));
}

float least_gap(const Vec3f& n, const Vec3f& center, float x, float y, float depth, float slack) {
  const Vec3f corner{x * depth, y * depth, depth}, apart = center - corner;
  const float gap = n.x * apart.x + n.y * apart.y + n.z * apart.z;
  const float size = std::fabs(n.x) * (std::fabs(corner.x) + 4.0f * std::fabs(apart.x)) +
                     std::fabs(n.y) * (std::fabs(corner.y) + 4.0f * std::fabs(apart.y)) +
                     4.0f * std::fabs(n.z) * std::fabs(apart.z);
  return gap - slack * size;
}

bool is_apart(const geom::Ball& ball, const geom::FrustumCell& cell) {
  if (cell.orthographic) return false;
  const float slack = 0x1p-23f * testing::steps_of_device();
  const Vec3f center{ball.center.x, ball.center.y, -ball.center.z};
  Vec3f n = way_out(center, cell);
  const auto [x, y] = slopes_along(n, cell);
  const float moves = n.x * x + n.y * y + n.z, size = std::fabs(n.x * x) + std::fabs(n.y * y) + std::fabs(n.z);
  if (cell.depth1 > 4.0f * center.z && moves < 0.0009765625f * size)
    n.z -= std::max(moves + 16.0f * slack * size, 0.0f);
  const float near = least_gap(n, center, x, y, cell.depth0, slack),
              far = least_gap(n, center, x, y, cell.depth1, slack);
  if (!(near > 0.0f && far > 0.0f)) return false;
  const float gap = std::min(near, far);
  return gap * gap > ball.radius * ball.radius * (n.x * n.x + n.y * n.y + n.z * n.z);
}

Lists lists_in_steps(const Params& params, const Setting& setting) {
  const testing::PackedLights lights(params, setting.grid,
                                     view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame)), 1.0f);
  Lists lists;
  lists.begin.push_back(0);
  for (std::uint32_t index = 0; index < setting.grid.cell_count(); ++index) {
    const auto cell = std::get<geom::FrustumCell>(setting.grid.cell(index));
    const geom::Box box = geom::box_around(cell);
    for (std::uint32_t light = 0; light < lights.count(); ++light)
      if (lights.touches(light, box, index) && !is_apart(lights.ball(light), cell)) lists.lights.push_back(light);
    lists.begin.push_back(lists.pair_count());
  }
  return lists;
}

// Views of the contract, whose lights touch cells by a hair, and cells and lights of all sizes of the domain.
std::vector<Setting> settings_of_cells(const assign::AssignerDescriptor& row, std::uint64_t seed) {
  std::vector<Setting> all = assign::testing::settings_for(row, seed);
  for (Setting& setting : test::some(assign::testing::settings_of_any_size(row, 200, seed)))
    all.push_back(std::move(setting));
  return all;
}

TEST_F(DeviceRefined, lists_are_those_of_the_same_steps_on_the_processor) {
  std::size_t turn = 0;
  for (const Setting& setting : settings_of_cells(refined(), 31)) {
    const Setting thin = testing::thinned(setting, 3, static_cast<std::uint32_t>(turn));
    for (const Params& params : test::every_nth(testing::choices_with_cells_of_host(refined()), 3, turn++ % 3))
      EXPECT_EQ(first_difference(lists_of(refined(), params, thin), lists_in_steps(params, thin)), "") << setting.name;
  }
}

TEST_F(DeviceRefined, lists_do_not_depend_on_where_bounds_of_cells_are_made) {
  for (const Setting& setting : settings_of_cells(refined(), 33)) {
    const auto made_on = [&](const char* place) {
      return lists_of(refined(),
                      Params(refined().params, {{"cells", std::string(place)}, {"spot", std::string("sphere")}}),
                      setting);
    };
    EXPECT_EQ(first_difference(made_on("device"), made_on("host")), "") << setting.name;
  }
}

// Pairs of two lists of which the first one must be the longer, as a visit of each that the second lacks.
template <class Visit>
void each_dropped(const Lists& more, const Lists& fewer, const Visit& visit) {
  ASSERT_EQ(more.cell_count(), fewer.cell_count());
  for (std::uint32_t cell = 0; cell < more.cell_count(); ++cell) {
    const auto all = more.of(cell), kept = fewer.of(cell);
    EXPECT_TRUE(std::ranges::includes(all, kept)) << cell;
    for (const std::uint32_t light : all)
      if (!std::ranges::binary_search(kept, light)) visit(cell, light);
  }
}

TEST_F(DeviceRefined, lists_lose_no_true_pair_of_those_of_gpu_group) {
  std::uint64_t dropped = 0, touching = 0;
  for (const std::uint64_t seed : {35u, 36u, 37u})
    for (const Setting& setting : settings_of_cells(refined(), seed)) {
      const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
      const Lists found = lists_of(refined(), Params(refined().params), setting);
      each_dropped(lists_of(group(), Params(group().params), setting), found,
                   [&](std::uint32_t cell, std::uint32_t light) {
                     EXPECT_NE(geom::decide_meets(lights.volume(light), setting.grid.cell(cell)), geom::Verdict::yes)
                         << setting.name << ", light " << light << ", cell " << cell;
                     ++dropped;
                   });
      for (const Setting::Touch& touch : setting.touches)
        EXPECT_TRUE(assign::testing::lists_light(found, touch.cell, touch.light)) << setting.name;
      touching += setting.touches.size();
    }
  EXPECT_GT(dropped, 1000u);
  EXPECT_GT(touching, 1000u);
}

TEST_F(DeviceRefined, lists_are_those_of_gpu_group_in_orthographic_views) {
  int views = 0;
  for (const Setting& setting : settings_of_cells(refined(), 39)) {
    if (!setting.grid.screen().tiles.orthographic) continue;
    EXPECT_EQ(first_difference(lists_of(refined(), Params(refined().params), setting),
                               lists_of(group(), Params(group().params), setting)),
              "")
        << setting.name;
    ++views;
  }
  EXPECT_GE(views, 2);
}

using WorldLights = std::vector<scene::WorldLight>;

Setting with_lights(const std::string& name, WorldLights lights, const Vec3i& cells, double far_m = 100) {
  Setting setting;
  setting.name = name + ", " + std::to_string(cells.x) + " x " + std::to_string(cells.y) + " x " +
                 std::to_string(cells.z) + " cells";
  setting.frame = assign::testing::frame_of({false, -1, 1, -1, 1, 1, 100}, {4096, 4096}, std::move(lights));
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {cells.x, cells.y}};
  spec.slices = {
      .scheme = grid::Scheme::exponential, .count = cells.z, .near_m = 1, .far_m = far_m, .boundaries_m = {}};
  setting.grid = assign::testing::grid_of(spec, setting.frame);
  return setting;
}

// Lights in view whose ranges are some cells long.
Setting street(const Vec3i& cells, double far_m = 100) {
  assign::testing::Random random(41);
  WorldLights lights;
  for (int i = 0; i < 200; ++i) {
    // One after the other: compilers evaluate arguments in orders of their own.
    const double depth = random.log_between(0.8, 110), range_m = random.log_between(0.3, 4);
    const double x = random.between(-1.1, 1.1) * depth, y = random.between(-1.1, 1.1) * depth;
    lights.push_back(assign::testing::point_light({x, y, -depth}, range_m));
  }
  return with_lights("street", std::move(lights), cells, far_m);
}

// Small lights close beside sides of tiles, whose cells are deep: each is beside a side of one of 16 columns, by 1.05
// to 1.5 of its range.
Setting beside_sides(int slices) {
  assign::testing::Random random(43);
  WorldLights lights;
  for (int i = 0; i < 400; ++i) {
    const double slope = -1.0 + 0.125 * std::floor(random.between(1, 16)), depth = random.log_between(10, 90);
    const double range_m = random.log_between(0.01, 0.1), gap_m = range_m * random.between(1.05, 1.5);
    const double y = random.between(-0.9, 0.9) * depth;
    lights.push_back(
        assign::testing::point_light({slope * depth + gap_m * std::hypot(1.0, slope), y, -depth}, range_m));
  }
  return with_lights("beside sides", std::move(lights), {16, 16, slices});
}

TEST_F(DeviceRefined, lists_of_any_number_of_cells_are_right) {
  for (const Vec3i& cells :
       {Vec3i{1, 1, 1}, {2, 1, 1}, {1, 3, 1}, {1, 1, 3}, {5, 5, 5}, {257, 1, 1}, {1, 130, 2}, {31, 33, 2}}) {
    const Setting setting = street(cells);
    const Params params(refined().params);
    EXPECT_EQ(first_difference(lists_of(refined(), params, setting), lists_in_steps(params, setting)), "")
        << setting.name;
  }
}

// Also where cells reach far beyond their lights, so that roundoffs at their far corners are large, and where lights
// are small against their depth, so that their way out is the difference of two places that are almost the same.
TEST_F(DeviceRefined, lists_have_hardly_a_false_pair) {
  for (const Setting& setting :
       {street({16, 16, 24}), street({48, 48, 1}, 1e5), street({48, 48, 1}, 1e12), beside_sides(4), beside_sides(24)}) {
    const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
    const auto false_pairs = [&](const Lists& lists) {
      std::uint64_t count = 0;
      for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
        for (const std::uint32_t light : lists.of(cell))
          count += geom::decide_meets(lights.volume(light), setting.grid.cell(cell)) == geom::Verdict::no ? 1 : 0;
      return count;
    };
    const Lists refined_lists = lists_of(refined(), Params(refined().params), setting);
    const std::uint64_t of_boxes = false_pairs(lists_of(group(), Params(group().params), setting)),
                        left = false_pairs(refined_lists);
    EXPECT_GT(of_boxes, refined_lists.pair_count() / 25) << setting.name;
    EXPECT_LE(left, refined_lists.pair_count() / 10'000) << setting.name << ", " << of_boxes << " of gpu-group";
  }
}

}  // namespace
}  // namespace clusterbench::gpu
