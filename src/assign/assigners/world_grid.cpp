// The world's box grid: lights come relative to its origin, along the world's axes.

#include "assign/assigner.h"
#include "assign/box_rows.h"
#include "assign/light_test.h"

namespace clusterbench::assign {
namespace {

BoxAxis axis_of(const std::vector<float>& boundaries) {
  BoxAxis axis;
  for (std::size_t i = 0; i + 1 < boundaries.size(); ++i) axis.push_back({boundaries[i], boundaries[i + 1]});
  return axis;
}

class WorldGridAssigner final : public Assigner {
 public:
  explicit WorldGridAssigner(const Params& params) : test_(params, k_box_roundings) {}

  void build(const grid::Grid& grid) override {
    grid_ = &grid;
    test_.start_grid(grid);
    const grid::WorldGrid& world = grid.world();
    boxes_.x = axis_of(world.x);
    boxes_.y = axis_of(world.y);
    boxes_.z = axis_of(world.z);
  }

  void assign(const view::LightArrays& lights, Lists& out) override {
    tests_ = 0;
    test_.start_frame(lights);
    pairs_.start(grid_->cell_count());
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      add_light(boxes_, test_, lights, light, pairs_, tests_);
    pairs_.finish(out);
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override {
    return pairs_.capacity_bytes() + test_.capacity_bytes() + boxes_.capacity_bytes();
  }

 private:
  LightTest test_;
  const grid::Grid* grid_ = nullptr;
  BoxGrid boxes_;
  PairBuffer pairs_;
  std::uint64_t tests_ = 0;
};

std::unique_ptr<Assigner> make(const Params& params) {
  return std::make_unique<WorldGridAssigner>(params);
}

}  // namespace

extern const AssignerRow world_grid_row;
const AssignerRow world_grid_row{
    .name = "world-grid",
    .summary = "sphere against the boxes of a fixed world grid, row by row",
    .source = "PlayCanvas clustered lighting",
    .kinds = {grid::Kind::world},
    .params = light_params(),
    .make = make,
};

}  // namespace clusterbench::assign
