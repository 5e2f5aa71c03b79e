// Lights sorted by depth; per depth bin the first and the last of them that reach it; per tile of the screen a bit for
// each. A sample's lights are its tile's bits within its bin's range. Tiles and bins are the grid's tiles and slices,
// so that a cell is what its tile and its slice have in common.
//
// Roundoffs: all that is tested are the cell boxes of balls, as `bounds-fast` finds them.

#include <algorithm>
#include <bit>
#include <limits>

#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/frustum_bounds.h"
#include "assign/cone/spot_bounding_spheres.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"
#include "assign/lists/radix_sort.h"
#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::assign {
namespace {

constexpr std::uint32_t k_bits = 32;  // of a word

// Ranks among the sorted lights, from `first` to before `end`.
struct Range {
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max(), end = 0;

  void take(std::uint32_t rank) {
    first = std::min(first, rank);
    end = rank + 1;
  }
};

using Bin = std::array<Range, view::k_light_types>;  // of each type

class BinsAndMasks final : public LightStructure {
 public:
  void start(const grid::Grid& grid, std::uint32_t lights, std::uint32_t listed) {
    grid_ = &grid;
    lights_ = lights;
    const Vec3i cells = grid.cells();
    tiles_ = static_cast<std::uint32_t>(cells.x * cells.y);
    words_ = words_for(listed);
    check_memory("words of tile masks", std::uint64_t{tiles_} * words_, sizeof(std::uint32_t));
    masks_.assign(std::size_t{tiles_} * words_, 0);
    bins_.assign(static_cast<std::size_t>(cells.z), {});
    order_.resize(listed);
  }

  // The light of a rank among the sorted ones, which come in this order, points before spots.
  void add(std::uint32_t rank, std::uint32_t light, std::size_t type, const CellBox& box) {
    order_[rank] = light;
    for (int z = box.first.z; z <= box.last.z; ++z) bins_[static_cast<std::size_t>(z)][type].take(rank);
    const std::uint32_t bit = 1u << rank % k_bits;
    const auto columns = static_cast<std::size_t>(grid_->screen().tiles.count.x);
    for (int y = box.first.y; y <= box.last.y; ++y) {
      std::size_t word = (static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(box.first.x)) * words_;
      word += rank / k_bits;
      for (int x = box.first.x; x <= box.last.x; ++x, word += words_) masks_[word] |= bit;
    }
  }

  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override {
    out.clear();
    const std::int64_t cell = grid::lookup(*grid_, sample, way);
    if (cell < 0) return false;
    read(static_cast<std::uint32_t>(cell), out);
    return true;
  }

  StructureUse use() const override {
    StructureUse use;
    use.index_entries = masks_.size();
    use.index_bytes = masks_.size() * sizeof(std::uint32_t);
    use.header_bytes = header_bytes(order_.size());
    use.upload_bytes = use.index_bytes + use.header_bytes;
    return use;
  }

  StructureLimit limit() const override {
    const std::uint64_t entries = std::uint64_t{tiles_} * words_for(lights_);
    return {entries, entries * sizeof(std::uint32_t) + header_bytes(lights_)};
  }

  std::vector<BufferNeed> buffers() const override {
    return {{"masks", sizeof(std::uint32_t), masks_.size(), std::uint64_t{tiles_} * words_for(lights_), tiles_},
            {"bins", sizeof(Bin), bins_.size(), bins_.size()},
            {"order", sizeof(std::uint32_t), order_.size(), lights_}};
  }

  std::uint32_t index_bits() const override { return k_bits; }
  bool has_cells() const override { return true; }

  void expand(Lists& out) const override {
    out.lights.clear();
    out.begin.assign(1, 0);
    for (std::uint32_t cell = 0; cell < grid_->cell_count(); ++cell) {
      read(cell, out.lights);
      check_memory("pairs of light lists", out.lights.size(), sizeof(std::uint32_t));
      check_pair_count(out.lights.size());
      out.begin.push_back(out.pair_count());
    }
  }

 private:
  static std::uint32_t words_for(std::uint32_t lights) { return (lights + k_bits - 1) / k_bits; }
  std::uint64_t header_bytes(std::uint64_t listed) const {
    return bins_.size() * sizeof(Bin) + listed * sizeof(std::uint32_t);
  }

  void read(std::uint32_t cell, std::vector<std::uint32_t>& out) const {
    const std::uint32_t* mask = masks_.data() + std::size_t{cell % tiles_} * words_;
    const Bin& bin = bins_[cell / tiles_];
    for (const Range& range : bin)
      for (std::uint32_t from = range.first; from < range.end; from = (from / k_bits + 1) * k_bits) {
        std::uint32_t left = mask[from / k_bits] & ~0u << from % k_bits;
        if (range.end / k_bits == from / k_bits) left &= (1u << range.end % k_bits) - 1;
        for (; left != 0; left &= left - 1)
          out.push_back(order_[from / k_bits * k_bits + static_cast<std::uint32_t>(std::countr_zero(left))]);
      }
  }

  const grid::Grid* grid_ = nullptr;
  std::uint32_t lights_ = 0, tiles_ = 0, words_ = 0;
  std::vector<std::uint32_t> masks_;  // tile by tile
  std::vector<Bin> bins_;
  std::vector<std::uint32_t> order_;  // the light of each rank
};

// Spots as the balls around their cones.
Params as_balls(const Params& params) {
  return Params(light_params(), {{"spot", std::string("ball")}, {"inflation", params.number("inflation")}});
}

class ZBinning final : public AssignerOf<BinsAndMasks> {
 public:
  explicit ZBinning(const Params& params) : test_(as_balls(params), 0.0f) {}

  void build(const grid::Grid& grid, const LightKinds&) override {
    grid_ = &grid;
    bounds_.build(grid.screen());
  }

  void fill(const FrameInput& input, BinsAndMasks& out) override {
    const view::LightArrays& lights = input.lights;
    tests_ = lights.size();
    bounded_.count = 0;
    bounded_.reserve(lights.size());
    bounds_.start_frame(lights.size());
    const float padding = test_.padding(k_cell_box_roundoffs);
    bounds_.find(given_points(lights), {padding, padding}, bounded_);
    const std::uint32_t points = bounded_.count;
    if (!lights.spots.empty()) {
      find_spot_balls(lights, padding, true, spots_);
      bounds_.find(given_spots(lights, spots_), {0.0f, 0.0f}, bounded_);
    }
    out.start(*grid_, lights.size(), bounded_.count);
    add_sorted(0, points, 0, out);
    add_sorted(points, bounded_.count, 1, out);
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override {
    return bounds_.capacity_bytes() + bounded_.capacity_bytes() + spots_.capacity_bytes() + by_depth_.capacity_bytes();
  }

 private:
  // The middles of what balls reach in depth are their centres.
  void add_sorted(std::uint32_t begin, std::uint32_t end, std::size_t type, BinsAndMasks& out) {
    by_depth_.entries.resize(end - begin);
    for (std::uint32_t i = begin; i < end; ++i) by_depth_.entries[i - begin] = {ordered_bits(bounded_.depth[i]), i};
    by_depth_.sort();
    std::uint32_t rank = begin;
    for (const auto& [key, ball] : by_depth_.entries) out.add(rank++, bounded_.light[ball], type, bounded_.box(ball));
  }

  LightTest test_;
  const grid::Grid* grid_ = nullptr;
  FrustumBounds bounds_;
  BallArrays spots_;
  BoundedBalls bounded_;
  RadixSort<std::uint32_t> by_depth_;
  std::uint64_t tests_ = 0;
};

}  // namespace

extern const AssignerDescriptor z_binning_descriptor;
const AssignerDescriptor z_binning_descriptor{
    .name = "z-binning",
    .summary =
        "lights sorted by depth: the first and last index per depth bin, bit masks per tile; a sample loops over "
        "its tile's bits within its bin's range",
    .source = "Drobot 2017, Improved Culling for Tiled and Clustered Rendering; Unity's URP",
    .kinds = {grid::Kind::frustum},
    .params = {inflation_param()},
    .make_own = make_structure_assigner<ZBinning>,
};

}  // namespace clusterbench::assign
