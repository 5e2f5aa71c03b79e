// The box around each light's volume in a world grid, without a test of the ball or cone.

#include <array>
#include <cmath>

#include "assign/contract/light_test.h"
#include "assign/pipeline/light_by_light.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

// Roundoffs, of a spot: the range along the axis, whose component is off by 1/2 (1.5); the range across, with the sine
// off by 1/2, the root of two squared components by 2.7 and two products (5.2); three sums, of numbers up to twice the
// reach (5). Boundaries are exact.
constexpr float k_light_box_roundoffs = 12.0f;

struct Extents {
  Vec3f lo, hi;
};

Extents extents_of(const view::LightArrays& lights, std::uint32_t light, float roundoffs) {
  const Vec3f at{lights.x[light], lights.y[light], lights.z[light]};
  const float r = lights.radius[light], padding = roundoffs * (0x1p-24f * lights.reach[light]);
  if (!lights.is_spot(light) || !std::isfinite(r)) return {at - (r + padding), at + (r + padding)};
  const std::uint32_t spot = light - lights.spots.first;
  const Vec3f axis{lights.axis_x[spot], lights.axis_y[spot], lights.axis_z[spot]};
  Extents box;
  for (int i = 0; i < 3; ++i) {
    // The cylinder around the sphere-capped cone.
    const float next = axis[(i + 1) % 3], other = axis[(i + 2) % 3];
    const float beside = r * lights.sin_angle[spot] * std::sqrt(next * next + other * other), along = r * axis[i];
    box.lo[i] = at[i] + std::min(0.0f, along) - beside - padding;
    box.hi[i] = at[i] + std::max(0.0f, along) + beside + padding;
  }
  return box;
}

class LightBoxes final : public LightByLight<LightBoxes> {
 public:
  explicit LightBoxes(const Params& params)
      : roundoffs_(static_cast<float>(params.number("inflation")) * (view::k_given_roundoffs + k_light_box_roundoffs)),
        lists_next_(params.text("upper_end") == "ceil") {}

  void build(const grid::Grid& grid, const LightKinds&) override {
    start_grid(grid);
    boundaries_ = {&grid.world().x, &grid.world().y, &grid.world().z};
  }

  void start_frame(const view::LightArrays&) {}
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const Extents box = extents_of(lights, light, roundoffs_);
    const grid::IndexRange xs = cells_within(0, box), ys = cells_within(1, box), zs = cells_within(2, box);
    if (xs.empty() || ys.empty() || zs.empty()) return;
    for (int z = zs.first; z <= zs.last; ++z)
      for (int y = ys.first; y <= ys.last; ++y) {
        ++tests_;
        pairs_.add_row(index_of({xs.first, y, z}), static_cast<std::uint32_t>(xs.count()), light);
      }
  }
  std::size_t own_bytes() const { return 0; }

 private:
  // Cells that the box meets along an axis. With upper_end `ceil` also the next cell, unless the box ends on the
  // boundary before the last.
  grid::IndexRange cells_within(int axis, const Extents& box) const {
    const std::vector<float>& boundaries = *boundaries_[static_cast<std::size_t>(axis)];
    grid::IndexRange range = grid::intervals_touched(boundaries, box.lo[axis], box.hi[axis]);
    const int most = static_cast<int>(boundaries.size()) - 2;
    if (lists_next_ && !range.empty() && range.last < most &&
        boundaries[static_cast<std::size_t>(range.last)] < box.hi[axis])
      ++range.last;
    return range;
  }

  float roundoffs_;
  bool lists_next_;
  std::array<const std::vector<float>*, 3> boundaries_{};  // of the grid
};

}  // namespace

extern const AssignerDescriptor light_boxes_descriptor;
const AssignerDescriptor light_boxes_descriptor{
    .name = "light-boxes",
    .summary = "all boxes of the world grid that the box around a light's volume meets; no sphere or cone is tested",
    .source = "PlayCanvas clustered lighting, which also lists the boxes after a light's last ones",
    .kinds = {grid::Kind::world},
    .by_name = true,
    .params = {inflation_param(),
               {.name = "upper_end",
                .summary =
                    "where a light's cells end along an axis. ceil: one after the last that its box meets, as in "
                    "PlayCanvas, which rounds up; floor: that one",
                .default_value = std::string("ceil"),
                .unit = "",
                .choices = {"ceil", "floor"}}},
    .make = make_list_assigner<LightBoxes>,
};

}  // namespace clusterbench::assign
