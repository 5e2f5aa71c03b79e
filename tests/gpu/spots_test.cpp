// Spots on a device: the cone's test has the same result as its twin on the processor, pair by pair, and no spot is
// lost where the exact truth has it, at any angle, range and distance from the world's origin.

#include "effort.h"
#include "geom/light_meets_cell.h"
#include "gpu/device_test.h"
#include "gpu/reference_lists.h"

namespace clusterbench::gpu {
namespace {

using assign::Lists;
using assign::Params;
using assign::testing::Random;
using assign::testing::Setting;
namespace settings = assign::testing::settings;
namespace touching = assign::testing::touching;

class DeviceSpots : public testing::DeviceTest {};

constexpr double k_degree = M_PI / 180.0;
constexpr double k_angles[] = {0.01 * k_degree, 0.3 * k_degree, 5 * k_degree,    30 * k_degree,
                               45 * k_degree,   75 * k_degree,  89.9 * k_degree, 90 * k_degree};

// Spots that touch a cell by their apex, their cap or their side, from outside or inside by a hair that may be below
// the padding, above it, or nothing.
scene::WorldLight grazing_spot(const touching::Place& place, const view::Space& space, double angle, Random& random) {
  const Vec3d& out = place.contact.outward;
  const double roundoff = 0x1p-24 * (glm::length(place.contact.point) + place.range);
  const double hair = (random.unit() < 0.5 ? -1.0 : 1.0) * roundoff * random.log_between(1e-3, 100);
  Vec3d apex = place.contact.point + hair * out, axis = touching::turned(out, random.between(0, 0.4), random);
  const double kind = random.unit();
  if (kind < 0.3) {  // by the cap
    apex = place.contact.point + (place.range + hair) * out;
    axis = touching::turned(-out, angle * random.between(0, 0.999), random);
  } else if (kind < 0.8) {  // by the side: a generator runs along the surface of the cell
    const Vec3d along = glm::normalize(glm::cross(out, random.direction()));
    apex = place.contact.point - place.range * random.between(0.01, 0.99) * along + hair * out;
    axis = std::cos(angle) * along + std::sin(angle) * out;
  }
  return assign::testing::spot_light(touching::in_world(apex, space), place.range,
                                     glm::transpose(space.rotation) * axis, angle);
}

// The corner of a cell that the ball around it passes through, and the way out from its middle: there the test of a
// cone against that ball has nothing to spare.
void move_to_corner(touching::Place& place, const geom::FrustumCell& cell, const geom::Ball& ball) {
  const Vec3d middle(ball.center);
  double farthest = -1.0;
  for (const float depth : {cell.depth0, cell.depth1})
    for (const float x : {cell.x0, cell.x1})
      for (const float y : {cell.y0, cell.y1}) {
        const double scale = cell.orthographic ? 1.0 : static_cast<double>(depth);
        const Vec3d corner{x * scale, y * scale, -static_cast<double>(depth)};
        if (glm::length(corner - middle) <= farthest) continue;
        farthest = glm::length(corner - middle);
        place.contact.point = corner;
        place.contact.outward = (corner - middle) / farthest;
      }
}

// `origin`: of the view in the world. Ranges from a millionth of a cell to a million times that.
Setting grazing_setting(const Vec3d& origin, int count, std::uint64_t seed) {
  Random random(seed);
  const double size_m = random.log_between(1e-3, 1e3);
  const settings::Plan plan =
      settings::plan_of_size(*assign::find_assigner("brute-force"), grid::Kind::frustum, size_m, random);
  Setting setting;
  setting.name = "seed " + std::to_string(seed) + ", cells of about " + std::to_string(size_m) + " m";
  setting.frame = assign::testing::frame_of(plan.projection, {1000, 640}, {});
  setting.frame.view_space = settings::far_and_turned();
  setting.frame.view_space.origin = origin;
  setting.grid = assign::testing::grid_of(plan.spec, setting.frame);
  const std::vector<geom::Ball> balls = setting.grid.balls_around_cells();
  for (int i = 0; i < count; ++i) {
    const double longer = random.unit() < 0.3 ? random.log_between(1e-6, 1e6) : 1.0;
    touching::Place place = touching::random_place(setting.grid, setting.frame.view_space, random, longer * size_m);
    if (i % 2 == 0)
      move_to_corner(place, std::get<geom::FrustumCell>(setting.grid.cell(place.cell)), balls[place.cell]);
    const double angle = k_angles[static_cast<std::size_t>(random.between(0, std::size(k_angles)))];
    setting.frame.lights.push_back(grazing_spot(place, setting.frame.view_space, angle, random));
  }
  return setting;
}

// The pairs that are true but not listed, and those that are neither proven nor refuted.
struct Losses {
  int lost = 0, undecided = 0;
  std::string first;
};

Losses losses_of(const Lists& lists, const Setting& setting) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  Losses losses;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
    for (std::uint32_t light = 0; light < lights.size(); ++light) {
      if (lights.is_empty(light) || assign::testing::lists_light(lists, cell, light)) continue;
      const geom::Verdict verdict = geom::decide_meets(lights.volume(light), setting.grid.cell(cell));
      losses.undecided += verdict == geom::Verdict::uncertain;
      if (verdict == geom::Verdict::yes && ++losses.lost == 1)
        losses.first = setting.name + ": light " + std::to_string(light) + " is lost in cell " + std::to_string(cell);
    }
  return losses;
}

const Vec3d k_origins[] = {{0, 0, 0}, {2000, -30, 1000}, {3e8, -2e7, 1e9}, {-4e13, 1e12, 7e13}};

TEST_F(DeviceSpots, have_the_lists_of_the_same_steps_on_the_processor) {
  std::size_t turn = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Setting setting = grazing_setting(k_origins[seed % 4], 90, seed);
    for (const assign::AssignerDescriptor* row : testing::list_methods()) {
      const std::vector<Params> choices = testing::choices_with_cells_of_host(*row);
      const Params& params = choices[turn++ % choices.size()];
      EXPECT_EQ(testing::first_difference(testing::lists_of(*row, params, setting),
                                          testing::reference_lists(params, setting)),
                "")
          << row->name << " " << params.text("spot") << " on " << setting.name;
    }
    ++turn;
  }
}

// All methods have these lists, by the test above. Without the cones' slack some of these spots are lost.
TEST_F(DeviceSpots, are_lost_nowhere_where_the_exact_truth_has_them) {
  const assign::AssignerDescriptor& row = *assign::find_assigner("gpu-group");
  const Params cone_alone(row.params, {{"spot", std::string("cone-sphere")}});
  int undecided = 0, lost_without_slack = 0;
  for (std::uint64_t seed = 101; seed <= 100 + static_cast<std::uint64_t>(test::tries(40)); ++seed) {
    const Setting setting = grazing_setting(k_origins[seed % 4], 90, seed);
    const Losses losses = losses_of(testing::lists_of(row, Params(row.params), setting), setting);
    EXPECT_EQ(losses.lost, 0) << losses.first;
    undecided += losses.undecided;
    lost_without_slack += losses_of(testing::reference_lists(cone_alone, setting, 0.0f), setting).lost;
  }
  EXPECT_LT(undecided, 20);
  EXPECT_GT(lost_without_slack, 10);
}

// By each choice of the spot test, on cells and lights of all scales of the domain.
TEST_F(DeviceSpots, and_points_are_right_at_all_scales_of_the_domain) {
  std::size_t turn = 0;
  for (const Setting& setting : assign::testing::settings_of_any_size(*assign::find_assigner("gpu-group"), 20, 51))
    for (const assign::AssignerDescriptor* row : testing::list_methods()) {
      const std::vector<Params> choices = testing::choices_with_cells_of_host(*row);
      const Params& params = choices[turn++ % choices.size()];
      const Lists lists = testing::lists_of(*row, params, setting);
      EXPECT_EQ(testing::first_difference(lists, testing::reference_lists(params, setting)), "")
          << row->name << " " << params.text("spot") << " on " << setting.name;
      const Losses losses = losses_of(lists, setting);
      EXPECT_EQ(losses.lost, 0) << row->name << ": " << losses.first;
    }
}

}  // namespace
}  // namespace clusterbench::gpu
