#include "assign/contract/storage.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <span>

#include "assign/storages/index_array.h"
#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::assign {

extern const StorageDescriptor packed_descriptor;

namespace {

// offset u32 + point count u16 + spot count u16 per cell; 12 bytes with u32 counts if the rig has more lights of one
// type than 16 bits can count: a shader reads one format, so it depends on the rig and not on a frame's lists. If the
// rig has boxes, one more u32 follows, their count: 12 or 16 bytes. With header_size counts are u32, and the rest of
// the header belongs to other kinds of objects (Bevy's has 32 bytes). Sparse: only cells with lights have headers; a
// shader finds them through one block per 32 cells, {mask u32, rank u32}: header rank + the number of mask bits below
// the cell's. Shared: a list that equals that of the cell before it or of the cell a row before it is not written
// again. With max_entries the index list begins with all lights that are in any list of the frame. If a list has no
// room left, its cell and all later cells with lights read that first list (Filament's Froxelizer).
class Packed final : public Storage {
 public:
  explicit Packed(const Params& params)
      : wanted_bits_(params.text("index_bits")),
        is_sparse_(params.text("headers") == "sparse"),
        shares_(params.text("equal_lists") == "shared"),
        max_entries_(static_cast<std::uint64_t>(params.number("max_entries"))),
        least_header_size_((static_cast<std::uint32_t>(params.number("header_size")) + 3) / 4 * 4) {}

  void start(std::uint32_t cell_count, const view::LightRanges& lights) override {
    lights_ = lights.size();
    points_ = lights.points.count;
    spots_ = lights.spots.count;
    const std::uint32_t needed = narrowest_bits(lights_);
    bits_ = wanted_bits_ == "auto" ? needed : static_cast<std::uint32_t>(std::stoul(wanted_bits_));
    if (bits_ < needed)
      throw Error("", "index_bits",
                  "is " + wanted_bits_ + ", but " + std::to_string(lights_) + " lights need " + std::to_string(needed) +
                      " bits");
    if (has_limit() && lights_ > max_entries_)
      throw Error("", "max_entries",
                  "is " + std::to_string(max_entries_) +
                      ", and a list of all lights, which is read where there is no room, "
                      "can take " +
                      std::to_string(lights_));
    cell_count_ = cell_count;
    is_in_a_list_.assign(has_limit() ? lights_ : 0, false);
    check_memory("headers of packed lists", cell_count, sizeof(Header));
    is_wide_ = has_wide_counts() || least_header_size_ > 0;
    headers_.resize(is_wide_ ? 0 : cell_count);
    wide_headers_.resize(is_wide_ ? cell_count : 0);
    box_counts_.resize(has_boxes() ? cell_count : 0);
    if (is_sparse_) blocks_.resize((cell_count + k_block - 1) / k_block);
  }

  // Headers keep their width, unless these lights do not fit.
  void set_types(const view::LightRanges& lights) override {
    points_ = lights.points.count;
    spots_ = lights_ - points_;
    if (is_wide_ || !has_wide_counts()) return;
    is_wide_ = true;
    wide_headers_.resize(cell_count_);
  }

  void store(const Lists& lists) override {
    if (chooses()) choose_lists(lists);
    const std::vector<std::uint32_t>& written = chooses() ? kept_ : lists.lights;
    indices_.make_room(written.size(), bits_);
    indices_.write(0, written.data(), written.size());
    entries_ = written.size();
    if (is_wide_)
      write_headers(lists, wide_headers_);
    else
      write_headers(lists, headers_);
  }

  void count(const Lists& lists) override {
    if (chooses()) return store(lists);
    entries_ = lists.lights.size();
    header_count_ = lists.cell_count();
    if (!is_sparse_) return;
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) header_count_ -= lists.of(cell).empty() ? 1 : 0;
  }

  StructureUse use() const override {
    StructureUse use;
    use.index_entries = entries_;
    use.index_bytes = entries_ * (bits_ / 8);
    use.header_bytes = std::uint64_t{header_count_} * header_size() + blocks_.size() * sizeof(Block);
    use.upload_bytes = use.index_bytes + use.header_bytes;
    use.fallback_cells = fallback_cells_;
    return use;
  }

  StructureLimit limit() const override {
    const std::uint64_t entries = most_entries();
    return {entries,
            entries * (bits_ / 8) + std::uint64_t{cell_count_} * header_size() + blocks_.size() * sizeof(Block)};
  }

  // Room for all lists, whatever the limit.
  std::vector<BufferNeed> buffers() const override {
    std::vector<BufferNeed> all{{"indices", bits_ / 8, entries_ + unwritten_,
                                 std::uint64_t{cell_count_} * lights_ + (has_limit() ? lights_ : 0)},
                                {"headers", header_size(), header_count_, cell_count_}};
    if (is_sparse_) all.push_back({"header_blocks", sizeof(Block), blocks_.size(), blocks_.size()});
    return all;
  }

  void read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const override {
    const Counts header = found_header(cell);
    for (std::uint32_t i = 0; i < header.all(); ++i) out.push_back(indices_.read(header.offset + i));
  }

  Reads reads_of_cell(std::uint32_t cell) const override {
    const std::uint64_t lights = found_header(cell).all();
    const Reads block = Reads::of(is_sparse_ ? 1 : 0, sizeof(Block));
    if (is_sparse_ && lights == 0) return block;  // its bit shows that it has no header
    return block + Reads::of(1, header_size()) + Reads::of(lights, bits_ / 8);
  }

  bool fill_shader_buffers(ShaderBuffers& shader) const override {
    shader.begin_again({.walk = Walk::packed,
                        .index_bytes = bits_ / 8,
                        .header_words = header_size() / 4,
                        .has_wide_counts = is_wide_,
                        .has_boxes = has_boxes(),
                        .is_sparse = is_sparse_});
    std::vector<std::uint32_t>& words = shader.words;
    words.clear();
    for (std::uint32_t header = 0; header < header_count_; ++header) {
      add_header(header_at(header), words);
      words.resize((header + std::size_t{1}) * shader.header_words);
    }
    shader.add("indices", indices_.bytes(entries_), bits_ / 8);
    shader.add("headers", std::span<const std::uint32_t>(words), header_size());
    if (is_sparse_) shader.add("header_blocks", std::span<const Block>(blocks_));
    return true;
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
  // The content of a header, of any size.
  struct Counts {
    std::uint32_t offset = 0, points = 0, spots = 0, boxes = 0;

    std::uint32_t all() const { return points + spots + boxes; }
  };
  static constexpr std::uint32_t k_block = 32;  // cells
  struct Block {
    std::uint32_t mask = 0, rank = 0;
  };

  bool has_wide_counts() const { return std::max(points_, spots_) > k_narrow_count; }
  bool has_boxes() const { return lights_ > points_ + spots_; }
  // The one function that defines the width of headers: for use(), limit(), buffers() and the reads of samples.
  std::uint32_t header_size() const {
    const auto least = static_cast<std::uint32_t>((is_wide_ ? sizeof(WideHeader) : sizeof(Header)) +
                                                  (has_boxes() ? sizeof(std::uint32_t) : 0));
    return std::max(least, least_header_size_);
  }

  // As it is uploaded, but for what belongs to other kinds of objects.
  void add_header(const Counts& header, std::vector<std::uint32_t>& words) const {
    words.push_back(header.offset);
    if (is_wide_)
      words.insert(words.end(), {header.points, header.spots});
    else
      words.push_back(header.points | header.spots << 16);
    if (has_boxes()) words.push_back(header.boxes);
  }

  bool has_limit() const { return max_entries_ > 0; }
  // Do the written lists differ from the given ones?
  bool chooses() const { return shares_ || has_limit(); }
  std::uint64_t most_entries() const {
    const std::uint64_t of_cells = std::uint64_t{cell_count_} * lights_;
    return has_limit() ? std::min(max_entries_, of_cells + lights_) : of_cells;
  }

  // The list to which a cell's header points.
  std::span<const std::uint32_t> list_of(const Lists& lists, std::uint32_t cell) const {
    const auto list = lists.of(cell);
    return cell < full_from_ || list.empty() ? list : std::span(kept_).first(all_lights_);
  }

  // The first list of the index list: all lights that any cell lists, points before spots.
  void keep_all_lights(const Lists& lists) {
    std::fill(is_in_a_list_.begin(), is_in_a_list_.end(), false);
    for (const std::uint32_t light : lists.lights) is_in_a_list_[light] = true;
    for (std::uint32_t light = 0; light < lights_; ++light)
      if (is_in_a_list_[light]) kept_.push_back(light);
    all_lights_ = kept_.size();
  }

  // Does its list equal that of the cell `cells_back` before it, so that it is not written again?
  bool equals_earlier(const Lists& lists, std::uint32_t cell, std::uint32_t cells_back) const {
    return shares_ && cells_back > 0 && cell >= cells_back &&
           std::ranges::equal(lists.of(cell), lists.of(cell - cells_back));
  }

  // Writes no more lists: `cell` and those after it read the list of all lights.
  void fall_back(const Lists& lists, std::uint32_t cell) {
    full_from_ = cell;
    for (; cell < lists.cell_count(); ++cell) {
      kept_at_[cell] = 0;
      fallback_cells_ += lists.of(cell).empty() ? 0 : 1;
      const bool is_shared = equals_earlier(lists, cell, 1) || equals_earlier(lists, cell, columns());
      unwritten_ += is_shared ? 0 : lists.of(cell).size();
    }
  }

  void choose_lists(const Lists& lists) {
    kept_.clear();
    kept_at_.resize(lists.cell_count());
    full_from_ = lists.cell_count();
    fallback_cells_ = unwritten_ = 0;
    if (has_limit()) keep_all_lights(lists);
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      const auto list = lists.of(cell);
      if (equals_earlier(lists, cell, 1)) {
        kept_at_[cell] = kept_at_[cell - 1];
      } else if (equals_earlier(lists, cell, columns())) {
        kept_at_[cell] = kept_at_[cell - columns()];
      } else if (has_limit() && kept_.size() + list.size() > max_entries_) {
        return fall_back(lists, cell);
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
      using Count = decltype(H::points);
      const Counts counts = counts_of(lists, cell);
      if (has_boxes()) box_counts_[header_count_] = counts.boxes;
      headers[header_count_++] = {counts.offset, static_cast<Count>(counts.points), static_cast<Count>(counts.spots)};
    }
  }

  Counts counts_of(const Lists& lists, std::uint32_t cell) const {
    const auto list = list_of(lists, cell);
    const auto from = [&list](std::uint32_t first) {
      const bool has_some = !list.empty() && list.back() >= first;
      return has_some ? std::ranges::partition_point(list, [first](std::uint32_t light) { return light < first; })
                      : list.end();
    };
    const auto spots = from(points_), boxes = has_boxes() ? from(points_ + spots_) : list.end();
    return {chooses() ? kept_at_[cell] : lists.begin[cell], static_cast<std::uint32_t>(spots - list.begin()),
            static_cast<std::uint32_t>(boxes - spots), static_cast<std::uint32_t>(list.end() - boxes)};
  }

  // Sets the cell's bit in its block. False if it gets no header.
  bool claim_slot(std::uint32_t cell, bool has_lights) {
    Block& block = blocks_[cell / k_block];
    if (cell % k_block == 0) block = {0, header_count_};
    if (has_lights) block.mask |= 1u << cell % k_block;
    return has_lights;
  }

  // As a shader would.
  Counts found_header(std::uint32_t cell) const {
    if (!is_sparse_) return header_at(cell);
    const Block& block = blocks_[cell / k_block];
    const std::uint32_t bit = 1u << cell % k_block;
    if ((block.mask & bit) == 0) return {};
    return header_at(block.rank + static_cast<std::uint32_t>(std::popcount(block.mask & (bit - 1))));
  }

  Counts header_at(std::uint32_t cell) const {
    const std::uint32_t boxes = has_boxes() ? box_counts_[cell] : 0;
    const auto counts = [boxes](const auto& header) {
      return Counts{header.offset, header.points, header.spots, boxes};
    };
    return is_wide_ ? counts(wide_headers_[cell]) : counts(headers_[cell]);
  }

  std::string wanted_bits_;
  bool is_sparse_, shares_, is_wide_ = false;
  std::uint32_t bits_ = 8, lights_ = 0, points_ = 0, spots_ = 0;
  std::uint32_t cell_count_ = 0, header_count_ = 0;
  std::uint64_t entries_ = 0;
  std::vector<Header> headers_;
  std::vector<WideHeader> wide_headers_;   // in place of headers_, if the rig has that many lights
  std::vector<std::uint32_t> box_counts_;  // the last word of either, if the rig has boxes
  std::vector<Block> blocks_;
  IndexArray indices_;
  std::uint64_t max_entries_;        // 0: no limit
  std::uint32_t least_header_size_;  // 0: as wide as needed
  std::vector<std::uint32_t> kept_,
      kept_at_;  // if lists are chosen: the written lists, and where each cell's list begins
  std::uint32_t full_from_ = std::numeric_limits<std::uint32_t>::max();  // the first cell whose list has no room
  std::size_t all_lights_ = 0;                                           // entries of the first list; with a limit
  std::uint64_t fallback_cells_ = 0,
                unwritten_ = 0;  // cells that read the first list; entries of the lists without room
  std::vector<bool> is_in_a_list_;
};

std::optional<Params> with_room(const Params& params) {
  if (params.number("max_entries") == 0.0) return std::nullopt;
  std::map<std::string, ParamValue> values = params.values();
  values["max_entries"] = 0.0;
  return Params(packed_descriptor.params, values);
}

}  // namespace

const StorageDescriptor packed_descriptor{
    .name = "packed",
    .summary = "offset and counts per cell (8 bytes), one tight index list for all cells",
    .source = "Persson 2015, Practical Clustered Shading",
    .params = {{.name = "index_bits",
                .summary = "bits of a light index. auto: the fewest that can number all lights",
                .default_value = std::string("auto"),
                .unit = "",
                .choices = {"auto", "8", "16", "32"}},
               {.name = "headers",
                .summary = "cells that have a header. dense: all; sparse: those with lights, found through 8 bytes per "
                           "32 cells (mask and rank, Jacobson 1989)",
                .default_value = std::string("dense"),
                .unit = "",
                .choices = {"dense", "sparse"}},
               {.name = "equal_lists",
                .summary = "what becomes of a list that equals that of the cell before, or of the cell a row before. "
                           "repeated: it is written again; shared: its header points to the other one (Filament)",
                .default_value = std::string("repeated"),
                .unit = "",
                .choices = {"repeated", "shared"},
                .is_late = true},
               {.name = "max_entries",
                .summary =
                    "entries that there is room for; 0: for all. Beyond them no list is written: its cell and all "
                    "after it that have lights read one list of all lights in any cell of the frame, which is "
                    "always written first and counts (Filament)",
                .default_value = 0.0,
                .unit = "entries",
                .min = 0.0,
                .max = 4294967295.0,
                .choices = {},
                .whole = true,
                .is_late = true},
               {.name = "header_size",
                .summary =
                    "bytes of a cell's header, rounded up to 4; 0: as few as the offset and the counts take. In a "
                    "header of a given size offset and counts have 32 bits each, and the rest is what an engine "
                    "keeps there of other objects (Bevy: 32)",
                .default_value = 0.0,
                .unit = "bytes",
                .min = 0.0,
                .max = 256.0,
                .choices = {},
                .whole = true,
                .is_late = true}},
    .make = make_storage<Packed>,
    .without_fallback = with_room,
};

}  // namespace clusterbench::assign
