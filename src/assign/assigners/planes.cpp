// The cells of the light's extents whose six planes each leave a part of the ball inside. Boxy: it cannot exclude a
// ball that passes a cell's edge or corner. A frustum cell's planes are the grid's, and the extents are what those
// planes leave, so within the extents it excludes next to nothing; it stands here to show what it costs.

#include "assign/cell_box_method.h"

namespace clusterbench::assign {
namespace {

// Roundings: a float normal is off by 1, the three products and two sums of n·c by 3 more, the offset by 1 and the last
// difference by 2 (both its numbers are at most |c| + r where it matters): 7.
class SixPlanes {
 public:
  static constexpr float k_roundings = 7.0f;
  static constexpr bool k_whole_grid = false;

  void build(const grid::Grid& grid) {
    planes_.assign(grid.cell_count(), {});
    for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
      geom::outward_planes(std::get<geom::FrustumPiece>(grid.cell(cell)), planes_[cell].of);
  }
  bool touches(const geom::Ball& ball, std::uint32_t cell) const {
    return geom::ball_touches_planes(ball, planes_[cell].of, 6);
  }
  std::size_t capacity_bytes() const { return planes_.capacity() * sizeof(CellPlanes); }

 private:
  struct CellPlanes {
    geom::Plane of[6];
  };
  std::vector<CellPlanes> planes_;
};

}  // namespace

extern const AssignerRow planes_row;
const AssignerRow planes_row{
    .name = "planes",
    .summary = "the cells of the light's extents that none of their six planes excludes",
    .source = "Wicked Engine, and most tiled renderers",
    .kinds = {grid::Kind::frustum},
    .params = light_params(),
    .make = make_cell_box_method<SixPlanes>,
};

}  // namespace clusterbench::assign
