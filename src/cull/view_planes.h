#pragma once
// The planes around the camera's view, against which pre-culls test lights.

#include <array>
#include <cstdint>

#include "geom/shapes/ball_and_cone.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::cull {

// Padding of a light by the pre-culls in unit roundoffs (2^-24 of a light's reach), so that no light is removed that
// shares a point with the tested volume: the single-precision error of the centre and of the padded radius
// (view::k_given_roundoffs), 1 for the sum that pads it, 3 for the error of a spot's axis and angle in the ball around
// its cone. The planes themselves are in double precision, whose 2^-53 are far below the rest.
inline constexpr float k_cull_roundoffs = 8.0f;
// Additional padding in metres: for roundoffs of numbers too small for single precision.
inline constexpr double k_cull_least_m = 0x1p-126;

// The picture's four sides, and two depths. In the grid's space.
class ViewPlanes {
 public:
  // The two depths. camera: its near and far plane, as engines cull; all samples of the view lie between them. cells:
  // the range of these and of the grid's slices, which may begin before the near plane and end beyond the far one.
  enum class Depths : std::uint8_t { camera, cells };

  ViewPlanes(const view::Frame& frame, const grid::Grid& grid, Depths depths);

  // Whether the ball lies wholly outside of one of the planes. A ball outside of an edge or a corner may not.
  bool are_missed_by(const geom::Ball& ball) const;

 private:
  struct Plane {
    Vec3d normal{0.0};  // outward
    double offset = 0.0;
  };

  std::array<Plane, 6> planes_;
};

// No cell of the grid is farther from the eye, in metres; +inf if cells do not end with the camera's view (cascades and
// world grids).
double farthest_of_cells(const grid::Grid& grid);

}  // namespace clusterbench::cull
