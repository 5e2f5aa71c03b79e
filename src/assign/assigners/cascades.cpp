// Nested view-space boxes: per level the index range of a light's box, then the squared distance per axis. Cells that
// lie in the finer level's box are skipped.

#include <memory>
#include <vector>

#include "assign/assigner.h"
#include "assign/box_rows.h"
#include "assign/light_test.h"

namespace clusterbench::assign {
namespace {

std::uint32_t index_of(Vec3i cells, Vec3i cell) {
  return static_cast<std::uint32_t>((cell.z * cells.y + cell.y) * cells.x + cell.x);
}

// The boxes of one level. Its extents are read from cells of the top row, the left column and the farthest layer, which
// are never holes.
BoxGrid boxes_of_level(const grid::Grid& grid, int level) {
  const grid::CascadesGrid& cascades = grid.cascades();
  const Vec3i cells = grid.cells(), of_level = cascades.cells;
  const int z0 = level * of_level.z, farthest = z0 + of_level.z - 1;
  const auto box = [&](int x, int y, int z) { return std::get<geom::Box>(grid.cell(index_of(cells, {x, y, z}))); };
  BoxGrid boxes;
  boxes.first_cell = index_of(cells, {0, 0, z0});
  for (int x = 0; x < of_level.x; ++x) {
    const geom::Box cell = box(x, 0, farthest);
    boxes.x.push_back({cell.lo.x, cell.hi.x});
  }
  for (int y = 0; y < of_level.y; ++y) {
    const geom::Box cell = box(0, y, farthest);
    boxes.y.push_back({cell.lo.y, cell.hi.y});
  }
  for (int z = z0; z <= farthest; ++z) {
    const geom::Box cell = box(0, 0, z);
    boxes.z.push_back({cell.lo.z, cell.hi.z});
  }
  if (level > 0) {
    boxes.hole_x = {of_level.x / 4, of_level.x * 3 / 4 - 1};
    boxes.hole_y = {of_level.y / 4, of_level.y * 3 / 4 - 1};
    boxes.hole_z = {0, of_level.z / 2 - 1};
  }
  return boxes;
}

class Cascades final : public Assigner {
 public:
  explicit Cascades(const Params& params) : test_(params, k_box_roundings) {}

  void build(const grid::Grid& grid) override {
    grid_ = &grid;
    test_.start_grid(grid);
    levels_.clear();
    for (int level = 0; level < grid.cascades().levels; ++level) levels_.push_back(boxes_of_level(grid, level));
  }

  void assign(const view::LightArrays& lights, Lists& out) override {
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

std::unique_ptr<Assigner> make(const Params& params) {
  return std::make_unique<Cascades>(params);
}

}  // namespace

extern const AssignerRow cascades_row;
const AssignerRow cascades_row{
    .name = "cascades",
    .summary = "sphere against the cubical cells of nested view-space boxes, level by level",
    .source = "nested camera-space cascades of light volumes; squared distance per axis as in Arvo 1990",
    .kinds = {grid::Kind::cascades},
    .params = light_params(),
    .make = make,
};

}  // namespace clusterbench::assign
