// A light is listed in the cells whose box its ball touches: every light against every cell, on every kind of grid.

#include <vector>

#include "clusterbench_plugin.hpp"

namespace sdk = clusterbench::sdk;

namespace {

class CellBoxes : public sdk::Method {
 public:
  static sdk::Description description() {
    sdk::Description out;
    out.name = "cell-boxes";
    out.summary = "all cells whose bounding box is touched by its ball";
    out.source = "an example";
    out.grid_kinds = CLUSTERBENCH_FRUSTUM | CLUSTERBENCH_DISTANCE | CLUSTERBENCH_CASCADES | CLUSTERBENCH_WORLD;
    out.light_types = CLUSTERBENCH_POINTS | CLUSTERBENCH_SPOTS | CLUSTERBENCH_BOXES;
    out.flags = CLUSTERBENCH_CONSERVATIVE | CLUSTERBENCH_ORTHOGRAPHIC | CLUSTERBENCH_ALL_PAIRS;
    out.parameters = {sdk::number("inflation", 1.0, 0.0, 100.0)
                          .says("padding of a light for roundings, in units of the one that is proven to be enough")
                          .conservative_from(1.0)};
    return out;
  }

  explicit CellBoxes(const sdk::Values& values) : inflation_(static_cast<float>(values.number("inflation"))) {}

  void build(const clusterbench_grid& grid, std::uint32_t) override {
    boxes_.clear();
    cells_.clear();
    cell_count_ = grid.cell_count;
    for (std::uint32_t cell = 0; cell < grid.cell_count; ++cell) {
      if (sdk::is_hole(grid, cell)) continue;
      cells_.push_back(cell);
      boxes_.push_back(sdk::cell_box(grid, cell));
    }
  }

  // Roundings, in units of 2^-24 of the light's reach: 2 of what is given, 1 of each coordinate's difference, which
  // makes less than 2 of their length, and less than 2 of squares, their sums and the comparison: 6. A box beyond the
  // light's reach is not touched whatever its own size is.
  void assign(const clusterbench_frame&, const clusterbench_lights& lights, clusterbench_lists& out) override {
    constexpr float k_roundoffs = 6.0f;
    pairs_.start(cell_count_);
    for (std::uint32_t light = 0; light < sdk::light_count(lights); ++light) {
      const float radius = sdk::padded_radius(lights, light, inflation_ * k_roundoffs);
      if (!(radius > 0.0f)) continue;
      for (std::size_t i = 0; i < cells_.size(); ++i)
        if (sdk::squared_distance(boxes_[i], lights.x[light], lights.y[light], lights.z[light]) <= radius * radius)
          pairs_.add(cells_[i], light);
    }
    out.tests_done = std::uint64_t{sdk::light_count(lights)} * cells_.size();
    out.scratch_bytes =
        pairs_.bytes() + boxes_.capacity() * sizeof(sdk::Box) + cells_.capacity() * sizeof(std::uint32_t);
    pairs_.finish(out);
  }

 private:
  float inflation_;
  std::uint32_t cell_count_ = 0;
  std::vector<std::uint32_t> cells_;  // that have space
  std::vector<sdk::Box> boxes_;
  sdk::Pairs pairs_;
};

}  // namespace

CLUSTERBENCH_PLUGIN("example", "An example of docs/plugins.md", "1.0", CellBoxes)
