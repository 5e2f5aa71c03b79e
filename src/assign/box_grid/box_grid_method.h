#pragma once
// The common part of `cascades` and `world-grid`: every light against the boxes of every level, row by row.

#include <vector>

#include "assign/box_grid/box_levels.h"
#include "assign/box_grid/box_rows.h"
#include "assign/contract/light_test.h"
#include "assign/pipeline/light_by_light.h"

namespace clusterbench::assign {

class BoxGridMethod final : public LightByLight<BoxGridMethod> {
 public:
  explicit BoxGridMethod(const Params& params) : test_(params, k_box_roundoffs) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    start_grid(grid);
    test_.start_grid(grid, kinds);
    levels_ = box_levels(grid);
  }

  void start_frame(const view::LightArrays& lights) { test_.start_frame(lights); }
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const TestedLight tested = test_.tested(lights, light);
    for (const BoxGrid& boxes : levels_) add_boxes(boxes, test_, tested, pairs_, tests_);
  }
  std::size_t own_bytes() const {
    std::size_t bytes = test_.capacity_bytes();
    for (const BoxGrid& boxes : levels_) bytes += boxes.capacity_bytes();
    return bytes;
  }

 private:
  LightTest test_;
  std::vector<BoxGrid> levels_;
};

}  // namespace clusterbench::assign
