// Spots as engines have tested them, each with one mistake on purpose, in the cells of the light's extents. Points get
// all cells of their boxes.

#include <cmath>

#include "assign/bounds/cell_bounds.h"
#include "assign/contract/light_test.h"
#include "assign/pipeline/light_by_light.h"
#include "core/arrays.h"

namespace clusterbench::assign {
namespace {

enum class ConeFlaw { sine_from_cosine, no_range, flat_cap_ball };

ConeFlaw cone_flaw(const std::string& name) {
  if (name == "sine-from-cosine") return ConeFlaw::sine_from_cosine;
  return name == "no-range" ? ConeFlaw::no_range : ConeFlaw::flat_cap_ball;
}

// The ball through apex and rim of a cone with a flat cap: contains the sphere-capped cone, and much more for wide
// angles.
geom::Ball flat_cap_ball(const geom::SphericalCone& cone) {
  const float along = cone.range / (2.0f * cone.cos_angle * cone.cos_angle);
  return {cone.apex + along * cone.axis, along};
}

class NaiveCone final : public LightByLight<NaiveCone> {
 public:
  explicit NaiveCone(const Params& params) : flaw_(cone_flaw(params.text("flaw"))) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    start_grid(grid);
    cell_balls_.clear();
    if (kinds.spots) cell_balls_ = grid.balls_around_cells();
  }

  void start_frame(const view::LightArrays& lights) { check_prepared(lights, cell_balls_); }
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    lights.is_spot(light) ? add_spot(lights, light) : add_point(lights, light);
  }
  std::size_t own_bytes() const { return bytes_of(cell_balls_); }

 private:
  void add_point(const view::LightArrays& lights, std::uint32_t light) {
    visit(cell_box(*grid_, lights.ball(light, view::k_given_roundoffs + k_cell_box_roundoffs)), light,
          [](std::uint32_t) { return true; });
  }

  void add_spot(const view::LightArrays& lights, std::uint32_t light) {
    geom::SphericalCone cone = lights.cone(light, view::k_given_roundoffs);
    if (flaw_ == ConeFlaw::flat_cap_ball)
      return visit(cell_box(*grid_, flat_cap_ball(cone)), light, [](std::uint32_t) { return true; });
    if (flaw_ == ConeFlaw::sine_from_cosine) cone.sin_angle = std::sqrt(1.0f - cone.cos_angle * cone.cos_angle);
    visit(cell_box(*grid_, {cone.apex, cone.range}), light, [&](std::uint32_t cell) { return touches(cone, cell); });
  }

  bool touches(const geom::SphericalCone& cone, std::uint32_t cell) const {
    const geom::Ball& ball = cell_balls_[cell];
    const Vec3f v = ball.center - cone.apex;
    const float along = glm::dot(v, cone.axis), squared = glm::dot(v, v);
    const float across = std::sqrt(std::max(0.0f, squared - along * along));
    if (cone.cos_angle * across - cone.sin_angle * along > ball.radius || along < -ball.radius) return false;
    return flaw_ == ConeFlaw::no_range || along <= cone.range + ball.radius;
  }

  template <class Keep>
  void visit(const CellBox& box, std::uint32_t light, Keep&& keep) {
    ++tests_;
    if (box.empty()) return;
    for (int z = box.first.z; z <= box.last.z; ++z)
      for (int y = box.first.y; y <= box.last.y; ++y)
        for (int x = box.first.x; x <= box.last.x; ++x) {
          const std::uint32_t cell = index_of({x, y, z});
          ++tests_;
          if (keep(cell)) pairs_.add(cell, light);
        }
  }

  ConeFlaw flaw_;
  std::vector<geom::Ball> cell_balls_;
};

}  // namespace

extern const AssignerDescriptor naive_cone_descriptor;
const AssignerDescriptor naive_cone_descriptor{
    .name = "naive-cone",
    .summary = "spots by a cone test with one mistake that engines have shipped",
    .source = "Wicked Engine (flat-cap-sphere), articles on cone culling (no-range, sine-from-cosine)",
    .kinds = {grid::Kind::frustum},
    .conservative = false,
    .naive = true,
    .params = {{.name = "flaw",
                .summary = "the mistake. sine-from-cosine: the sine of the angle is computed from its cosine; "
                           "no-range: no test against the range; flat-cap-sphere: the sphere of a cone with a flat cap",
                .default_value = std::string("sine-from-cosine"),
                .unit = "",
                .choices = {"sine-from-cosine", "no-range", "flat-cap-sphere"},
                .former = {{"flat-cap-ball", "flat-cap-sphere"}}}},
    .make = make_list_assigner<NaiveCone>,
};

}  // namespace clusterbench::assign
