// Tiles whose size is a whole number of pixels, because the screen was divided in whole numbers: cells end before the
// picture does, and a pixel behind the last tile gets a column, or a row, that does not exist. Its cell number is that
// of another cell: of the next row's first tile, of the next slice, or of none.

#include <algorithm>
#include <vector>

#include "assign/contract/assigner.h"
#include "assign/contract/storage.h"

namespace clusterbench::assign {
namespace {

// Whole pixels per tile, rounded down.
Vec2i whole_size(const grid::Tiles& tiles) {
  return {std::max(1, tiles.viewport.x / tiles.count.x), std::max(1, tiles.viewport.y / tiles.count.y)};
}

// As many planes as before, `size` pixels apart.
std::vector<float> planes(const std::vector<float>& given, int size, int pixels) {
  std::vector<float> out;
  const float step = (given.back() - given.front()) * (static_cast<float>(size) / static_cast<float>(pixels));
  for (std::size_t i = 0; i < given.size(); ++i) out.push_back(given.front() + step * static_cast<float>(i));
  return out;
}

grid::Grid with_whole_tiles(const grid::Grid& grid) {
  grid::ScreenGrid out = grid.screen();
  const Vec2i size = whole_size(out.tiles);
  out.tiles.x = planes(out.tiles.x, size.x, out.tiles.viewport.x);
  out.tiles.y = planes(out.tiles.y, size.y, out.tiles.viewport.y);
  out.tiles.scale_x = 1.0f / static_cast<float>(size.x);
  out.tiles.scale_y = 1.0f / static_cast<float>(size.y);
  return {out};
}

class WholeTileLists final : public LightStructure {
 public:
  WholeTileLists() {
    const StorageDescriptor& packed = *find_storage("packed");
    packed_ = packed.make(Params(packed.params));
  }

  // `grid`, the frame's own, must outlive the structure.
  void store(const grid::Grid& grid, const Lists& lists, const view::LightRanges& lights) {
    grid_ = &grid;
    packed_->start(lists.cell_count(), lights);
    packed_->store(lists);
  }

  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override {
    out.clear();
    if (grid::lookup(*grid_, sample, way) < 0) return false;
    const std::uint32_t cell = mistaken_cell(sample, way);
    if (cell < packed_->cell_count()) packed_->read_cell(cell, out);
    return true;
  }
  // Beyond the buffer's end a GPU reads zeros; the header read counts all the same.
  Reads reads_at(const grid::Sample& sample, grid::Log2 way) const override {
    if (grid::lookup(*grid_, sample, way) < 0) return {};
    return packed_->reads_of_cell(std::min(mistaken_cell(sample, way), packed_->cell_count() - 1));
  }

  StructureUse use() const override { return packed_->use(); }
  StructureLimit limit() const override { return packed_->limit(); }
  std::vector<BufferNeed> buffers() const override { return packed_->buffers(); }
  std::uint32_t index_bits() const override { return packed_->index_bits(); }
  // A sample may get the lights of another cell.
  bool has_cells() const override { return false; }
  void expand(Lists& out) const override { packed_->expand(out); }

 private:
  // For a sample inside the grid.
  std::uint32_t mistaken_cell(const grid::Sample& sample, grid::Log2 way) const {
    const grid::Tiles& tiles = grid_->screen().tiles;
    const Vec2i size = whole_size(tiles);
    const auto tile = [](float pixel, int pixels, int of) {
      return std::min(static_cast<int>(pixel), pixels - 1) / of;
    };
    const int x = tile(sample.pixel_x, tiles.viewport.x, size.x), y = tile(sample.pixel_y, tiles.viewport.y, size.y);
    const auto slice =
        static_cast<int>(grid::lookup(*grid_, sample, way) / (std::int64_t{tiles.count.x} * tiles.count.y));
    return static_cast<std::uint32_t>(x + tiles.count.x * (y + tiles.count.y * slice));
  }

  std::unique_ptr<Storage> packed_;
  const grid::Grid* grid_ = nullptr;
};

class NaiveTileSize final : public AssignerOf<WholeTileLists> {
 public:
  explicit NaiveTileSize(const Params&) {
    const AssignerDescriptor& aabb = *find_assigner("aabb");
    lists_of_ = aabb.make(Params(aabb.params));
  }

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    grid_ = &grid;
    whole_ = with_whole_tiles(grid);
    lists_of_->build(whole_, kinds);
  }
  std::uint64_t tests_done() const override { return lists_of_->tests_done(); }
  std::size_t scratch_bytes() const override {
    return lists_of_->scratch_bytes() + (lists_.begin.capacity() + lists_.lights.capacity()) * sizeof(std::uint32_t);
  }

 protected:
  void fill(const FrameInput& input, WholeTileLists& out) override {
    lists_of_->assign(input, lists_);
    out.store(*grid_, lists_, input.lights);
  }

 private:
  std::unique_ptr<ListAssigner> lists_of_;
  const grid::Grid* grid_ = nullptr;
  grid::Grid whole_;
  Lists lists_;
};

}  // namespace

extern const AssignerDescriptor naive_tile_size_descriptor;
const AssignerDescriptor naive_tile_size_descriptor{
    .name = "naive-tile-size",
    .summary =
        "aabb in tiles of whole pixels, the screen's by the number of tiles and rounded down: behind the last tile a "
        "sample reads another cell's list",
    .source = "DaveH355's tutorial, where the division is one of whole numbers",
    .kinds = {grid::Kind::frustum},
    .conservative = false,
    .own_lists = true,
    .naive = true,
    .params = {},
    .make_own = make_structure_assigner<NaiveTileSize>,
};

}  // namespace clusterbench::assign
