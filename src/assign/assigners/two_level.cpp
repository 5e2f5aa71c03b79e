// Scatter, then gather: each light is added to the coarse tiles that its extents cover, and each cell tests the lights
// of its coarse tile.
//
// Roundoffs: the coarse tiles are blocks of the cells of `bounds`; the test of a cell is that of `aabb`.

#include "assign/bounds/bounds_method.h"

namespace clusterbench::assign {
namespace {

class TwoLevel final : public ListAssigner {
 public:
  explicit TwoLevel(const Params& params)
      : test_(params, CellAabbs::k_roundoffs), side_(static_cast<int>(params.number("coarse"))) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    grid_ = &grid;
    cells_ = grid.cells();
    coarse_ = {(cells_.x + side_ - 1) / side_, (cells_.y + side_ - 1) / side_, cells_.z};
    view_ = ViewCull(grid.screen());
    boxes_.build(grid);
    test_.start_grid(grid, kinds);
  }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    test_.start_frame(lights);
    tests_ = 0;
    scatter(lights);
    out.lights.clear();
    out.begin.assign(1, 0);
    for (int z = 0; z < cells_.z; ++z)
      for (int y = 0; y < cells_.y; ++y)
        for (int x = 0; x < cells_.x; ++x) gather({x, y, z}, out);
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override {
    return test_.capacity_bytes() + boxes_.capacity_bytes() + pairs_.capacity_bytes() +
           bytes_of(tested_, coarse_lists_.begin, coarse_lists_.lights);
  }

 private:
  void scatter(const view::LightArrays& lights) {
    pairs_.start(static_cast<std::uint32_t>(coarse_.x * coarse_.y * coarse_.z));
    tested_.clear();
    for (std::uint32_t light = 0; light < lights.size(); ++light) {
      if (lights.is_empty(light)) continue;
      const geom::Ball ball = test_.ball(lights, light, k_cell_box_roundoffs);
      ++tests_;
      if (view_.misses(ball)) continue;
      const CellBox box = cell_box(*grid_, ball);
      if (box.empty()) continue;
      const auto slot = static_cast<std::uint32_t>(tested_.size());
      tested_.push_back(test_.tested(lights, light));
      const int first = box.first.x / side_;
      const auto columns = static_cast<std::uint32_t>(box.last.x / side_ - first + 1);
      for (int z = box.first.z; z <= box.last.z; ++z)
        for (int y = box.first.y / side_; y <= box.last.y / side_; ++y)
          pairs_.add_row(grid::cell_index({first, y, z}, coarse_), columns, slot);
    }
    pairs_.finish(coarse_lists_);
  }

  void gather(const Vec3i& cell, Lists& out) {
    const std::uint32_t index = grid::cell_index(cell, cells_);
    const auto candidates = coarse_lists_.of(grid::cell_index({cell.x / side_, cell.y / side_, cell.z}, coarse_));
    tests_ += candidates.size();
    for (const std::uint32_t slot : candidates) {
      const TestedLight& light = tested_[slot];
      if (boxes_.touches(light.ball, index) && (!light.has_cone || test_.cone_touches(light, index)))
        out.lights.push_back(light.index);
    }
    check_pair_count(out.lights.size());
    out.begin.push_back(out.pair_count());
  }

  LightTest test_;
  int side_;  // of a coarse tile, in tiles
  const grid::Grid* grid_ = nullptr;
  Vec3i cells_{0}, coarse_{0};
  ViewCull view_;
  CellAabbs boxes_;
  PairBuffer pairs_;
  Lists coarse_lists_;               // of indices in `tested_`
  std::vector<TestedLight> tested_;  // the lights in view, ascending
  std::uint64_t tests_ = 0;
};

std::vector<ParamSpec> two_level_params() {
  std::vector<ParamSpec> params = light_params();
  params.push_back({.name = "coarse",
                    .summary = "tiles along a side of a coarse tile",
                    .default_value = 4.0,
                    .unit = "tiles",
                    .min = 1.0,
                    .max = 64.0,
                    .choices = {},
                    .whole = true});
  return params;
}

}  // namespace

extern const AssignerDescriptor two_level_descriptor;
const AssignerDescriptor two_level_descriptor{
    .name = "two-level",
    .summary = "each light into the coarse tiles of its extents; each cell asks its coarse tile's lights, as aabb does",
    .source = "Wicked Engine 2018, Optimizing tile-based light culling; Unity's HDRP",
    .kinds = {grid::Kind::frustum},
    .by_name = true,
    .params = two_level_params(),
    .make = make_list_assigner<TwoLevel>,
};

}  // namespace clusterbench::assign
