#include "assign/contract/storage.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "assign/storages/index_array.h"
#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::assign {
namespace {

// offset u32 + point count u16 + spot count u16 per cell; 12 bytes with u32 counts where a count needs it. Sparse: only
// for cells with lights; a shader finds them through one block per 32 cells, {mask u32, rank u32}: header rank + the
// number of mask bits below the cell's. Shared: a list that equals that of the cell before it or of the cell a row
// before it is not written again.
class Packed final : public Storage {
 public:
  explicit Packed(const Params& params)
      : wanted_bits_(params.text("index_bits")),
        is_sparse_(params.text("headers") == "sparse"),
        shares_(params.text("equal_lists") == "shared") {}

  void start(std::uint32_t cell_count, const view::LightRanges& lights) override {
    lights_ = lights.size();
    points_ = lights.points.count;
    const std::uint32_t needed = narrowest_bits(lights_);
    bits_ = wanted_bits_ == "auto" ? needed : static_cast<std::uint32_t>(std::stoul(wanted_bits_));
    if (bits_ < needed)
      throw Error("", "index_bits",
                  "is " + wanted_bits_ + ", but " + std::to_string(lights_) + " lights need " + std::to_string(needed) +
                      " bits");
    cell_count_ = cell_count;
    check_memory("headers of packed lists", cell_count, sizeof(Header));
    headers_.resize(cell_count);
    wide_headers_.resize(can_be_wide() ? cell_count : 0);
    if (is_sparse_) blocks_.resize((cell_count + k_block - 1) / k_block);
  }

  void store(const Lists& lists) override {
    if (shares_) leave_out_equal(lists);
    const std::vector<std::uint32_t>& written = shares_ ? kept_ : lists.lights;
    indices_.make_room(written.size(), bits_);
    indices_.write(0, written.data(), written.size());
    entries_ = written.size();
    is_wide_ = can_be_wide() && has_wide_count(lists);
    if (is_wide_)
      write_headers(lists, wide_headers_);
    else
      write_headers(lists, headers_);
  }

  StructureUse use() const override {
    StructureUse use;
    use.index_entries = entries_;
    use.index_bytes = entries_ * (bits_ / 8);
    use.header_bytes =
        header_count_ * (is_wide_ ? sizeof(WideHeader) : sizeof(Header)) + blocks_.size() * sizeof(Block);
    use.upload_bytes = use.index_bytes + use.header_bytes;
    return use;
  }

  StructureLimit limit() const override {
    const std::uint64_t entries = std::uint64_t{cell_count_} * lights_;
    const std::uint64_t header_size = can_be_wide() ? sizeof(WideHeader) : sizeof(Header);
    return {entries, entries * (bits_ / 8) + cell_count_ * header_size + blocks_.size() * sizeof(Block)};
  }

  // A shader has one format of headers for all frames: the wide one where any frame can need it.
  std::vector<BufferNeed> buffers() const override {
    const std::uint32_t header_size = can_be_wide() ? sizeof(WideHeader) : sizeof(Header);
    std::vector<BufferNeed> all{{"indices", bits_ / 8, entries_, std::uint64_t{cell_count_} * lights_},
                                {"headers", header_size, header_count_, cell_count_}};
    if (is_sparse_) all.push_back({"header_blocks", sizeof(Block), blocks_.size(), blocks_.size()});
    return all;
  }

  void read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const override {
    const WideHeader header = found_header(cell);
    for (std::uint32_t i = 0; i < header.points + header.spots; ++i) out.push_back(indices_.read(header.offset + i));
  }

  Reads reads_of_cell(std::uint32_t cell) const override {
    const WideHeader header = found_header(cell);
    const std::uint64_t lights = std::uint64_t{header.points} + header.spots;
    const Reads block = Reads::of(is_sparse_ ? 1 : 0, sizeof(Block));
    if (is_sparse_ && lights == 0) return block;  // its bit says that it has no header
    return block + Reads::of(1, is_wide_ ? sizeof(WideHeader) : sizeof(Header)) + Reads::of(lights, bits_ / 8);
  }

  std::uint32_t cell_count() const override { return cell_count_; }

  std::uint32_t index_bits() const override { return bits_; }

 private:
  static constexpr std::uint32_t k_narrow_count = std::numeric_limits<std::uint16_t>::max();
  struct Header {
    std::uint32_t offset;
    std::uint16_t points, spots;
  };
  struct WideHeader {
    std::uint32_t offset, points, spots;
  };
  static_assert(sizeof(Header) == 8 && sizeof(WideHeader) == 12);
  static constexpr std::uint32_t k_block = 32;  // cells
  struct Block {
    std::uint32_t mask = 0, rank = 0;
  };

  bool can_be_wide() const { return std::max(points_, lights_ - points_) > k_narrow_count; }

  bool has_wide_count(const Lists& lists) const {
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      if (lists.of(cell).size() <= k_narrow_count) continue;
      const WideHeader header = header_of<WideHeader>(lists, cell);
      if (std::max(header.points, header.spots) > k_narrow_count) return true;
    }
    return false;
  }

  void leave_out_equal(const Lists& lists) {
    kept_.clear();
    kept_at_.resize(lists.cell_count());
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      const auto list = lists.of(cell);
      const auto equals = [&](std::uint32_t cells_back) {
        return cells_back > 0 && cell >= cells_back && std::ranges::equal(list, lists.of(cell - cells_back));
      };
      if (equals(1)) {
        kept_at_[cell] = kept_at_[cell - 1];
      } else if (equals(columns())) {
        kept_at_[cell] = kept_at_[cell - columns()];
      } else {
        kept_at_[cell] = static_cast<std::uint32_t>(kept_.size());
        kept_.insert(kept_.end(), list.begin(), list.end());
      }
    }
  }

  template <class H>
  void write_headers(const Lists& lists, std::vector<H>& headers) {
    header_count_ = 0;
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      if (is_sparse_ && !claim_slot(cell, !lists.of(cell).empty())) continue;
      headers[header_count_++] = header_of<H>(lists, cell);
    }
  }

  template <class H>
  H header_of(const Lists& lists, std::uint32_t cell) const {
    using Count = decltype(H::points);
    const auto list = lists.of(cell);
    const bool has_spots = !list.empty() && list.back() >= points_;
    const auto is_point = [this](std::uint32_t light) { return light < points_; };
    const auto spots_from = has_spots ? std::partition_point(list.begin(), list.end(), is_point) : list.end();
    return {shares_ ? kept_at_[cell] : lists.begin[cell], static_cast<Count>(spots_from - list.begin()),
            static_cast<Count>(list.end() - spots_from)};
  }

  // In the cell's block. False if it gets no header.
  bool claim_slot(std::uint32_t cell, bool has_lights) {
    Block& block = blocks_[cell / k_block];
    if (cell % k_block == 0) block = {0, header_count_};
    if (has_lights) block.mask |= 1u << cell % k_block;
    return has_lights;
  }

  // As a shader would.
  WideHeader found_header(std::uint32_t cell) const {
    if (!is_sparse_) return header_at(cell);
    const Block& block = blocks_[cell / k_block];
    const std::uint32_t bit = 1u << cell % k_block;
    if ((block.mask & bit) == 0) return {};
    return header_at(block.rank + static_cast<std::uint32_t>(std::popcount(block.mask & (bit - 1))));
  }

  WideHeader header_at(std::uint32_t cell) const {
    if (is_wide_) return wide_headers_[cell];
    const Header& header = headers_[cell];
    return {header.offset, header.points, header.spots};
  }

  std::string wanted_bits_;
  bool is_sparse_, shares_, is_wide_ = false;
  std::uint32_t bits_ = 8, lights_ = 0, points_ = 0;
  std::uint32_t cell_count_ = 0, header_count_ = 0;
  std::uint64_t entries_ = 0;
  std::vector<Header> headers_;
  std::vector<WideHeader> wide_headers_;  // in place of them, where the rig can need them
  std::vector<Block> blocks_;
  IndexArray indices_;
  std::vector<std::uint32_t> kept_, kept_at_;  // where lists are shared: those that are written, and each cell's begin
};

}  // namespace

extern const StorageDescriptor packed_descriptor;
const StorageDescriptor packed_descriptor{
    .name = "packed",
    .summary = "offset and counts per cell (8 bytes), one tight index list for all cells",
    .source = "Persson 2015, Practical Clustered Shading",
    .params = {{.name = "index_bits",
                .summary = "bits of a light index. auto: the fewest that can number all lights",
                .standard = std::string("auto"),
                .unit = "",
                .choices = {"auto", "8", "16", "32"}},
               {.name = "headers",
                .summary = "cells that have a header. dense: all; sparse: those with lights, found through 8 bytes per "
                           "32 cells (mask and rank, Jacobson 1989)",
                .standard = std::string("dense"),
                .unit = "",
                .choices = {"dense", "sparse"}},
               {.name = "equal_lists",
                .summary = "what becomes of a list that equals that of the cell before, or of the cell a row before. "
                           "repeated: it is written again; shared: its header points to the other one (Filament)",
                .standard = std::string("repeated"),
                .unit = "",
                .choices = {"repeated", "shared"},
                .is_late = true}},
    .make = make_storage<Packed>,
};

}  // namespace clusterbench::assign
