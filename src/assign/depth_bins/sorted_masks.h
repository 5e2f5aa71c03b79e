#pragma once
// Light structures of engines without lists: lights sorted by depth, one bit per light for each tile of the screen, and
// the first and the last light for each range of depth. A sample's lights are its tile's bits within its range.

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

#include "assign/bounds/cell_bounds.h"
#include "assign/bounds/frustum_bounds.h"
#include "assign/cone/bounding_spheres.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"
#include "assign/lists/radix_sort.h"
#include "core/memory.h"
#include "grid/index_range.h"

namespace clusterbench::assign {

// The elements that have their own range: slices (shared by all tiles), with ranks of 32 bits; or cells, with ranks as
// narrow as the rig allows, since there are many cells.
enum class RangesOf { slices, cells };

// Variants of the structure.
struct MaskForm {
  bool has_bin_masks = false;  // each slice also has a bit for each of its lights (Unity URP)
  // Points and spots are sorted together, and share one range (Babylon.js); otherwise each type has its own.
  bool is_one_order = false;
};

// Tiles and slices are the grid's, so a cell is the intersection of its tile and its slice.
template <RangesOf ranges_of>
class SortedMasks final : public LightStructure {
 public:
  // For this number of lights, of which `listed` will be added.
  void start(const grid::Grid& grid, std::uint32_t lights, std::uint32_t listed, MaskForm form = {}) {
    grid_ = &grid;
    form_ = form;
    lights_ = lights;
    const Vec3i cells = grid.cells();
    tiles_ = static_cast<std::uint32_t>(cells.x * cells.y);
    words_ = words_for(listed);
    check_memory("words of tile masks", std::uint64_t{tiles_} * words_, sizeof(std::uint32_t));
    masks_.assign(std::size_t{tiles_} * words_, 0);
    bin_masks_.assign(form.has_bin_masks ? static_cast<std::size_t>(cells.z) * words_ : 0, 0);
    order_.resize(listed);
    if (ranks_are_narrow() != std::holds_alternative<Ranges<std::uint16_t>>(ranges_)) {
      if (ranks_are_narrow())
        ranges_.template emplace<Ranges<std::uint16_t>>();
      else
        ranges_.template emplace<Ranges<std::uint32_t>>();
    }
    const std::size_t count = ranges_of == RangesOf::cells ? grid.cell_count() : static_cast<std::size_t>(cells.z);
    std::visit(
        [count](auto& ranges) {
          check_memory("ranges of lights", count, sizeof ranges[0]);
          ranges.assign(count, {});
        },
        ranges_);
  }

  // Adds the light of a rank among the sorted ones. Ranks ascend, points before spots.
  void add(std::uint32_t rank, std::uint32_t light, std::size_t type, const CellBox& box) {
    order_[rank] = light;
    for (int y = box.first.y; y <= box.last.y; ++y) mark(rank, y, {box.first.x, box.last.x});
    std::visit([&](auto& ranges) { include(rank, type, box, ranges); }, ranges_);
  }
  // A slice's range begins with the first of all lights, whatever else it contains.
  void begin_with_first(int slice) requires(ranges_of == RangesOf::slices) {
    std::visit(
        [&](auto& ranges) {
          auto& range = ranges[static_cast<std::size_t>(slice)][0];
          range.first = 0;
          range.end = std::max<decltype(range.end)>(range.end, 1);
        },
        ranges_);
  }
  // Empties a slice's range.
  void begin_anew(int slice) requires(ranges_of == RangesOf::slices) {
    std::visit([&](auto& ranges) { ranges[static_cast<std::size_t>(slice)][0] = {}; }, ranges_);
  }
  // Adds a light with its own columns in each row of tiles, from `first_row` on.
  void add(std::uint32_t rank, std::uint32_t light, std::size_t type, const grid::IndexRange& slices, int first_row,
           std::span<const grid::IndexRange> columns) requires(ranges_of == RangesOf::slices) {
    order_[rank] = light;
    for (std::size_t i = 0; i < columns.size(); ++i) mark(rank, first_row + static_cast<int>(i), columns[i]);
    const CellBox box{{0, 0, slices.first}, {0, 0, slices.last}};
    std::visit([&](auto& ranges) { include(rank, type, box, ranges); }, ranges_);
  }

  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override {
    out.clear();
    const std::int64_t cell = grid::lookup(*grid_, sample, way);
    if (cell < 0) return false;
    read(static_cast<std::uint32_t>(cell), out);
    return true;
  }

  // Reads the range, the words of the tile's mask that it covers, and the light of each bit that is set there.
  Reads reads_at(const grid::Sample& sample, grid::Log2 way) const override {
    const std::int64_t cell = grid::lookup(*grid_, sample, way);
    if (cell < 0) return {};
    std::uint64_t words = 0, lights = 0;
    each_word(static_cast<std::uint32_t>(cell), [&](std::uint32_t, std::uint32_t bits) {
      words += form_.has_bin_masks ? 2 : 1;
      lights += static_cast<std::uint64_t>(std::popcount(bits));
    });
    return Reads::of(1, range_bytes()) + Reads::of(words + lights, sizeof(std::uint32_t));
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
    const char* const name = ranges_of == RangesOf::cells ? "ranges" : "bins";
    std::vector<BufferNeed> all{
        {"masks", sizeof(std::uint32_t), masks_.size(), std::uint64_t{tiles_} * words_for(lights_), tiles_},
        {name, range_bytes(), range_count(), range_count()},
        {"order", sizeof(std::uint32_t), order_.size(), lights_}};
    if (form_.has_bin_masks)
      all.push_back({"bin_masks", sizeof(std::uint32_t), bin_masks_.size(), slices() * words_for(lights_), slices()});
    return all;
  }

  bool fill_shader_buffers(ShaderBuffers& shader) const override {
    shader.begin_again({.walk = Walk::masks,
                        .per_cell = words_,
                        .rank_bytes = range_bytes() / (2 * static_cast<std::uint32_t>(view::k_punctual_types)),
                        .has_range_per_cell = ranges_of == RangesOf::cells,
                        .has_bin_masks = form_.has_bin_masks});
    shader.add("masks", std::span<const std::uint32_t>(masks_));
    std::visit(
        [&shader](const auto& ranges) {
          shader.add(ranges_of == RangesOf::cells ? "ranges" : "bins", std::span(ranges));
        },
        ranges_);
    shader.add("order", std::span<const std::uint32_t>(order_));
    if (form_.has_bin_masks) shader.add("bin_masks", std::span<const std::uint32_t>(bin_masks_));
    return true;
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
  static constexpr std::uint32_t k_bits = 32;  // of a word

  // Ranks among the sorted lights, from `first` to before `end`.
  template <class Rank>
  struct Range {
    Rank first = std::numeric_limits<Rank>::max(), end = 0;

    void include(std::uint32_t rank) {
      first = std::min(first, static_cast<Rank>(rank));
      end = static_cast<Rank>(rank + 1);
    }
  };
  template <class Rank>
  using Ranges = std::vector<std::array<Range<Rank>, view::k_punctual_types>>;  // one range per type

  bool ranks_are_narrow() const {
    return ranges_of == RangesOf::cells && lights_ <= std::numeric_limits<std::uint16_t>::max();
  }
  std::uint64_t slices() const { return static_cast<std::uint64_t>(grid_->cells().z); }
  static std::uint32_t words_for(std::uint32_t lights) { return (lights + k_bits - 1) / k_bits; }
  std::uint32_t range_bytes() const {
    return std::visit([](const auto& ranges) { return static_cast<std::uint32_t>(sizeof ranges[0]); }, ranges_);
  }
  std::uint64_t range_count() const {
    return std::visit([](const auto& ranges) { return std::uint64_t{ranges.size()}; }, ranges_);
  }
  std::uint64_t header_bytes(std::uint64_t listed) const {
    const std::uint64_t bin_words = form_.has_bin_masks ? slices() * words_for(static_cast<std::uint32_t>(listed)) : 0;
    return range_count() * range_bytes() + (listed + bin_words) * sizeof(std::uint32_t);
  }

  void mark(std::uint32_t rank, int row, const grid::IndexRange& columns) {
    const std::uint32_t bit = 1u << rank % k_bits;
    const auto row_tiles = static_cast<std::size_t>(grid_->screen().tiles.count.x);
    std::size_t word = (static_cast<std::size_t>(row) * row_tiles + static_cast<std::size_t>(columns.first)) * words_;
    word += rank / k_bits;
    for (int x = columns.first; x <= columns.last; ++x, word += words_) masks_[word] |= bit;
  }

  template <class Rank>
  void include(std::uint32_t rank, std::size_t type, const CellBox& box, Ranges<Rank>& ranges) {
    if constexpr (ranges_of == RangesOf::slices) {
      for (int z = box.first.z; z <= box.last.z; ++z) {
        const auto slice = static_cast<std::size_t>(z);
        ranges[slice][form_.is_one_order ? 0 : type].include(rank);
        if (form_.has_bin_masks) bin_masks_[slice * words_ + rank / k_bits] |= 1u << rank % k_bits;
      }
    } else {
      for (int z = box.first.z; z <= box.last.z; ++z)
        for (int y = box.first.y; y <= box.last.y; ++y) {
          std::size_t cell = grid::cell_index({box.first.x, y, z}, grid_->cells());
          for (int x = box.first.x; x <= box.last.x; ++x) ranges[cell++][type].include(rank);
        }
    }
  }

  void read(std::uint32_t cell, std::vector<std::uint32_t>& out) const {
    const auto begin = static_cast<std::ptrdiff_t>(out.size());
    each_word(cell, [&](std::uint32_t first, std::uint32_t bits) {
      for (; bits != 0; bits &= bits - 1)
        out.push_back(order_[first + static_cast<std::uint32_t>(std::countr_zero(bits))]);
    });
    if (form_.is_one_order) std::sort(out.begin() + begin, out.end());  // a list has points before spots
  }

  // Calls visit(rank of the first bit, bits) for each word of the tile's mask that the cell's ranges cover; bits
  // outside of the range are cleared.
  template <class Visit>
  void each_word(std::uint32_t cell, Visit&& visit) const {
    const std::uint32_t* mask = masks_.data() + std::size_t{cell % tiles_} * words_;
    std::visit(
        [&](const auto& ranges) {
          for (const auto& range : ranges[ranges_of == RangesOf::cells ? cell : cell / tiles_])
            each_word_between(mask, range.first, range.end, [&](std::uint32_t first, std::uint32_t bits) {
              visit(first, form_.has_bin_masks ? bits & bin_masks_[cell / tiles_ * words_ + first / k_bits] : bits);
            });
        },
        ranges_);
  }

  template <class Visit>
  static void each_word_between(const std::uint32_t* mask, std::uint32_t first, std::uint32_t end, Visit&& visit) {
    for (std::uint32_t from = first; from < end; from = (from / k_bits + 1) * k_bits) {
      std::uint32_t bits = mask[from / k_bits] & ~0u << from % k_bits;
      if (end / k_bits == from / k_bits) bits &= (1u << end % k_bits) - 1;
      visit(from / k_bits * k_bits, bits);
    }
  }

  const grid::Grid* grid_ = nullptr;
  std::uint32_t lights_ = 0, tiles_ = 0, words_ = 0;
  MaskForm form_;
  std::vector<std::uint32_t> masks_;      // tile by tile
  std::vector<std::uint32_t> bin_masks_;  // slice by slice; empty without bin masks
  std::variant<Ranges<std::uint32_t>, Ranges<std::uint16_t>> ranges_;
  std::vector<std::uint32_t> order_;  // the light of each rank
};

// Fills the structure. A spot is the ball around its cone.
//
// Roundoffs: the only tests are those of the balls' cell boxes, as in `bounds-fast`.
template <RangesOf ranges_of>
class SortedMasksMethod final : public AssignerOf<SortedMasks<ranges_of>> {
 public:
  explicit SortedMasksMethod(const Params& params) : test_(as_balls(params), 0.0f) {}

  void build(const grid::Grid& grid, const LightKinds&) override {
    grid_ = &grid;
    bounds_.build(grid.screen());
  }

  void fill(const FrameInput& input, SortedMasks<ranges_of>& out) override {
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
  static Params as_balls(const Params& params) {
    return Params(light_params(), {{"spot", std::string("sphere")}, {"inflation", params.number("inflation")}});
  }

  // The centres of balls are also the middles of their ranges of depth. Balls of equal depth are sorted by their
  // slices, so that a range's content does not depend on the order of the lights.
  void add_sorted(std::uint32_t begin, std::uint32_t end, std::size_t type, SortedMasks<ranges_of>& out) {
    auto& entries = by_depth_.entries;
    entries.resize(end - begin);
    for (std::uint32_t i = begin; i < end; ++i) entries[i - begin] = {ordered_bits(bounded_.depth[i]), i};
    by_depth_.sort();
    const auto slices = [this](const auto& entry) {
      return std::tuple(bounded_.first_slice[entry.value], bounded_.last_slice[entry.value], entry.value);
    };
    for (auto from = entries.begin(), to = from; from != entries.end(); from = to) {
      while (to != entries.end() && to->key == from->key) ++to;
      if (to - from > 1) std::sort(from, to, [&slices](const auto& a, const auto& b) { return slices(a) < slices(b); });
    }
    std::uint32_t rank = begin;
    for (const auto& [key, ball] : entries) out.add(rank++, bounded_.light[ball], type, bounded_.box(ball));
  }

  LightTest test_;
  const grid::Grid* grid_ = nullptr;
  FrustumBounds bounds_;
  BallArrays spots_;
  BoundedBalls bounded_;
  RadixSort<std::uint32_t> by_depth_;
  std::uint64_t tests_ = 0;
};

}  // namespace clusterbench::assign
