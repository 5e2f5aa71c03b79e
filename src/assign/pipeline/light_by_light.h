#pragma once
// The driver of the scalar methods: for each light it adds the light's cells to one buffer of pairs.

#include "assign/contract/assigner.h"
#include "assign/contract/lists.h"

namespace clusterbench::assign {

// Method derives from this and has
//   build(), which calls start_grid(),
//   start_frame(const view::LightArrays&),
//   add_light(const view::LightArrays&, std::uint32_t light), for each light that is not empty, ascending,
//   own_bytes() const: its memory besides the pairs'.
// Not virtual: a culled light costs a few nanoseconds, and most lights of a large level are culled.
template <class Method>
class LightByLight : public ListAssigner {
 public:
  void assign(const FrameInput& input, Lists& out) final {
    auto& method = static_cast<Method&>(*this);
    const view::LightArrays& lights = input.lights;
    tests_ = 0;
    method.start_frame(lights);
    pairs_.start(grid_->cell_count());
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      if (!lights.is_empty(light)) method.add_light(lights, light);
    pairs_.finish(out);
  }

  std::uint64_t tests_done() const final { return tests_; }
  // The pairs' memory doubles until a frame fits; that of a method is the grid's.
  EarlierFrames earlier_frames() const final { return EarlierFrames::do_not_matter; }
  std::size_t scratch_bytes() const final {
    return pairs_.capacity_bytes() + static_cast<const Method&>(*this).own_bytes();
  }

 protected:
  void start_grid(const grid::Grid& grid) {
    grid_ = &grid;
    cells_ = grid.cells();
  }
  std::uint32_t index_of(Vec3i cell) const { return grid::cell_index(cell, cells_); }

  const grid::Grid* grid_ = nullptr;
  Vec3i cells_{0};  // of the grid
  PairBuffer pairs_;
  std::uint64_t tests_ = 0;
};

}  // namespace clusterbench::assign
