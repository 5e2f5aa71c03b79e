#pragma once
// What `cascades` and `world-grid` share: every light against the boxes of every level, row by row.

#include <memory>
#include <vector>

#include "assign/box_grid/box_levels.h"
#include "assign/box_grid/box_rows.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"

namespace clusterbench::assign {

class BoxGridMethod final : public ListAssigner {
 public:
  explicit BoxGridMethod(const Params& params) : test_(params, k_box_roundings) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    grid_ = &grid;
    test_.start_grid(grid, kinds);
    levels_ = box_levels(grid);
  }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    tests_ = 0;
    test_.start_frame(lights);
    pairs_.start(grid_->cell_count());
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      for (const BoxGrid& boxes : levels_) add_light(boxes, test_, lights, light, pairs_, tests_);
    pairs_.finish(out);
  }

  std::uint64_t tests_done() const override { return tests_; }

  std::size_t scratch_bytes() const override {
    std::size_t bytes = pairs_.capacity_bytes() + test_.capacity_bytes();
    for (const BoxGrid& boxes : levels_) bytes += boxes.capacity_bytes();
    return bytes;
  }

 private:
  LightTest test_;
  const grid::Grid* grid_ = nullptr;
  std::vector<BoxGrid> levels_;
  PairBuffer pairs_;
  std::uint64_t tests_ = 0;
};

inline std::unique_ptr<ListAssigner> make_box_grid_method(const Params& params) {
  return std::make_unique<BoxGridMethod>(params);
}

}  // namespace clusterbench::assign
