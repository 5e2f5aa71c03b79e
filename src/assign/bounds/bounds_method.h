#pragma once
// The common part of the plain box methods: light by light, the cells of a frustum grid in the light's box of cells (or
// all cells), filtered by one predicate.

#include <vector>

#include "assign/bounds/cell_bounds.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/pipeline/light_by_light.h"
#include "geom/single_precision/box_tests.h"

namespace clusterbench::assign {

// The candidate cells of a light: all cells; the cells of the light's box; or those, accepted without a test.
enum class Candidates { all_cells, in_box, untested_box };

// A method without boxes.
struct NoBoxTest {
  static constexpr bool k_tests_boxes = false;
  std::size_t capacity_bytes() const { return 0; }
};

// CellTest: build(const grid::Grid&), bool touches(const geom::Ball&, std::uint32_t cell) const, capacity_bytes()
// const, k_candidates, and k_roundoffs: the error of touches(). With Candidates::untested_box there is no touches().
// BoxTest: k_tests_boxes, and if it is true build(const grid::Grid&), bool touches(const geom::PaddedBox&, const
// CellTest&, std::uint32_t cell) const, k_roundoffs: the error that the padding has to cover; capacity_bytes() const.
template <class CellTest, class BoxTest = NoBoxTest>
class CellBoxMethod final : public LightByLight<CellBoxMethod<CellTest, BoxTest>> {
  using LightByLight<CellBoxMethod>::cells_;
  using LightByLight<CellBoxMethod>::grid_;
  using LightByLight<CellBoxMethod>::pairs_;
  using LightByLight<CellBoxMethod>::tests_;

 public:
  explicit CellBoxMethod(const Params& params) : test_(params, CellTest::k_roundoffs) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    this->start_grid(grid);
    cell_test_.build(grid);
    if constexpr (BoxTest::k_tests_boxes)
      if (kinds.boxes) box_test_.build(grid);
    view_ = ViewCull(grid.screen());
    test_.start_grid(grid, kinds);
  }

  void start_frame(const view::LightArrays& lights) { test_.start_frame(lights); }
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const CellBox box =
        CellTest::k_candidates == Candidates::all_cells ? CellBox{Vec3i(0), cells_ - 1} : extents(lights, light);
    if (box.empty()) return;
    if constexpr (BoxTest::k_tests_boxes)
      if (lights.is_box(light)) return add_box(lights, light, box);
    const TestedLight tested = test_.tested(lights, light);
    if constexpr (CellTest::k_candidates == Candidates::untested_box) {
      add_rows(box, tested);
    } else if (tested.has_cone) {
      visit(box, light, [&](std::uint32_t cell) {
        return cell_test_.touches(tested.ball, cell) && test_.cone_touches(tested, cell);
      });
    } else {
      visit(box, light, [&](std::uint32_t cell) { return cell_test_.touches(tested.ball, cell); });
    }
  }
  std::size_t own_bytes() const {
    return test_.capacity_bytes() + cell_test_.capacity_bytes() + box_test_.capacity_bytes();
  }

 private:
  CellBox extents(const view::LightArrays& lights, std::uint32_t light) const {
    const geom::Ball ball = test_.ball(lights, light, k_cell_box_roundoffs);
    return view_.misses(ball) ? CellBox{} : cell_box(*grid_, ball);
  }

  void add_box(const view::LightArrays& lights, std::uint32_t light, const CellBox& cells) {
    // test_.padding() also covers errors from earlier steps: the middle's roundoff, which the tests count as well, and
    // the roundoff of padding a radius, which boxes do not have.
    const float roundoffs = test_.padding(BoxTest::k_roundoffs - view::k_given_roundoffs);
    const geom::PaddedBox box = geom::padded(lights.box(light), roundoffs * (0x1p-24f * lights.reach[light]));
    visit(cells, light, [&](std::uint32_t cell) { return box_test_.touches(box, cell_test_, cell); });
  }

  void add_rows(const CellBox& box, const TestedLight& light) {
    const auto columns = static_cast<std::uint32_t>(box.last.x - box.first.x + 1);
    for (int z = box.first.z; z <= box.last.z; ++z)
      for (int y = box.first.y; y <= box.last.y; ++y) {
        ++tests_;
        test_.add_row(light, this->index_of({box.first.x, y, z}), columns, pairs_, tests_);
      }
  }

  template <class Keep>
  void visit(const CellBox& box, std::uint32_t light, Keep&& keep) {
    for (int z = box.first.z; z <= box.last.z; ++z) {
      for (int y = box.first.y; y <= box.last.y; ++y) {
        const std::uint32_t row = this->index_of({0, y, z});
        for (int x = box.first.x; x <= box.last.x; ++x) {
          const std::uint32_t cell = row + static_cast<std::uint32_t>(x);
          if (keep(cell)) pairs_.add(cell, light);
        }
        tests_ += static_cast<std::uint64_t>(box.last.x - box.first.x + 1);
      }
    }
  }

  CellTest cell_test_;
  BoxTest box_test_;
  LightTest test_;
  ViewCull view_;
};

// Ball against the view-space boxes around the cells, made once per grid.
//
// Roundoffs: as for box_rows.h, the boxes being rounded outward.
class CellAabbs {
 public:
  static constexpr float k_roundoffs = 4.0f;

  void build(const grid::Grid& grid);
  bool touches(const geom::Ball& ball, std::uint32_t cell) const { return geom::ball_touches_box(ball, boxes_[cell]); }
  const geom::Box& bounds(std::uint32_t cell) const { return boxes_[cell]; }
  std::size_t capacity_bytes() const { return boxes_.capacity() * sizeof(geom::Box); }

 private:
  std::vector<geom::Box> boxes_;
};

// The same, but only for the cells of a light's extents.
struct AabbsInExtents : CellAabbs {
  static constexpr Candidates k_candidates = Candidates::in_box;
};

// Boxes against the cells' axis-aligned bounds by their own: the coarse test.
struct CoarseBoxTest {
  static constexpr bool k_tests_boxes = true;
  static constexpr float k_roundoffs = geom::k_bounds_roundoffs;

  void build(const grid::Grid&) {}
  bool touches(const geom::PaddedBox& box, const CellAabbs& cells, std::uint32_t cell) const {
    return geom::bounds_touch(box, cells.bounds(cell));
  }
  std::size_t capacity_bytes() const { return 0; }
};

// The cells themselves, for box tests that need more than the cells' bounds.
class FrustumCells {
 public:
  static constexpr bool k_tests_boxes = true;

  void build(const grid::Grid& grid);
  std::size_t capacity_bytes() const { return cells_.capacity() * sizeof(geom::FrustumCell); }

 protected:
  std::vector<geom::FrustumCell> cells_;
};

// Ball against the six planes of the cells, made once per grid.
//
// Roundoffs: a float normal is off by 1, the three products and two sums of n·c by 3 more, the offset by 1 and the last
// difference by 2 (both its numbers are at most |c| + r where it matters): 7.
class CellPlanes {
 public:
  static constexpr float k_roundoffs = 7.0f;

  void build(const grid::Grid& grid);
  bool touches(const geom::Ball& ball, std::uint32_t cell) const {
    return geom::ball_touches_planes(ball, planes_[cell].of, 6);
  }
  std::size_t capacity_bytes() const { return planes_.capacity() * sizeof(SixPlanes); }

 private:
  struct SixPlanes {
    geom::Plane of[6];
  };
  std::vector<SixPlanes> planes_;
};

}  // namespace clusterbench::assign
