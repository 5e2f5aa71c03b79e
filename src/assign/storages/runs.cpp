#include <algorithm>

#include "assign/contract/storage.h"
#include "assign/storages/index_array.h"
#include "core/memory.h"

namespace clusterbench::assign {
namespace {

// Runs of lights with consecutive indices: {first, length - 1} each, in the narrowest indices for all lights. Per cell
// an offset (u32) and the numbers of runs of points and of spots (u16 each; u32 if the rig has enough lights for more
// runs), and if the rig has boxes the number of their runs (u32).
class Runs final : public Storage {
 public:
  explicit Runs(const Params&) {}

  void start(std::uint32_t cell_count, const view::LightRanges& lights) override {
    lights_ = lights;
    is_wide_ = has_wide_counts();
    bits_ = narrowest_bits(lights.size());
    check_memory("headers of runs", cell_count, sizeof(Header));
    headers_.assign(cell_count, {});
    count_ = 0;
  }

  void set_types(const view::LightRanges& lights) override {
    lights_ = view::LightRanges(lights.points.count, lights_.size() - lights.points.count);
    is_wide_ = is_wide_ || has_wide_counts();
  }

  void store(const Lists& lists) override {
    runs_.clear();
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      const std::span<const std::uint32_t> list = ascending(lists.of(cell));
      const auto spots = std::lower_bound(list.begin(), list.end(), lights_.points.count);
      Header& header = headers_[cell];
      header.offset = run_count();
      const auto boxes = std::lower_bound(spots, list.end(), lights_.boxes.first);
      add_runs({list.begin(), spots});
      header.points = run_count() - header.offset;
      add_runs({spots, boxes});
      header.spots = run_count() - header.offset - header.points;
      add_runs({boxes, list.end()});
      header.boxes = run_count() - header.offset - header.points - header.spots;
    }
    count_ = run_count();
    indices_.make_room(runs_.size(), bits_);
    indices_.write(0, runs_.data(), runs_.size());
  }

  StructureUse use() const override {
    StructureUse use;
    use.index_entries = count_;
    use.index_bytes = count_ * run_bytes();
    use.header_bytes = header_bytes();
    use.upload_bytes = use.index_bytes + use.header_bytes;
    return use;
  }

  // The worst case: every second light.
  StructureLimit limit() const override { return {most_entries(), most_entries() * run_bytes() + header_bytes()}; }

  std::vector<BufferNeed> buffers() const override {
    return {{"runs", run_bytes(), count_, most_entries()},
            {"headers", header_size(), headers_.size(), headers_.size()}};
  }

  void read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const override {
    const Header& header = headers_[cell];
    for (std::uint32_t run = header.offset; run < header.offset + header.all(); ++run) {
      const std::uint32_t first = indices_.read(2 * std::size_t{run}),
                          last = first + indices_.read(2 * std::size_t{run} + 1);
      for (std::uint32_t light = first; light <= last; ++light) out.push_back(light);
    }
  }

  Reads reads_of_cell(std::uint32_t cell) const override {
    const Header& header = headers_[cell];
    return Reads::of(1, header_size()) + Reads::of(header.all(), run_bytes());
  }
  bool fill_shader_buffers(ShaderBuffers& shader) const override {
    shader.begin_again({.walk = Walk::runs,
                        .index_bytes = bits_ / 8,
                        .header_words = header_size() / 4,
                        .has_wide_counts = is_wide_,
                        .has_boxes = !lights_.boxes.empty()});
    std::vector<std::uint32_t>& words = shader.words;
    words.clear();
    for (const Header& header : headers_) add_header(header, words);
    shader.add("runs", indices_.bytes(2 * static_cast<std::size_t>(count_)), run_bytes());
    shader.add("headers", std::span<const std::uint32_t>(words), header_size());
    return true;
  }
  std::uint32_t cell_count() const override { return static_cast<std::uint32_t>(headers_.size()); }
  std::uint32_t index_bits() const override { return 2 * bits_; }

 private:
  struct Header {
    std::uint32_t offset = 0, points = 0, spots = 0, boxes = 0;

    std::uint32_t all() const { return points + spots + boxes; }
  };

  static std::uint64_t most_runs(std::uint32_t lights) { return (std::uint64_t{lights} + 1) / 2; }
  std::uint64_t most_entries() const {
    std::uint64_t most = 0;
    for (const view::LightRange& type : lights_.types()) most += most_runs(type.count);
    return headers_.size() * most;
  }
  std::uint32_t run_bytes() const { return 2 * (bits_ / 8); }
  bool has_wide_counts() const { return most_runs(std::max(lights_.points.count, lights_.spots.count)) > 0xffff; }
  std::uint32_t header_size() const { return (is_wide_ ? 12 : 8) + (lights_.boxes.empty() ? 0 : 4); }
  std::uint64_t header_bytes() const { return headers_.size() * std::uint64_t{header_size()}; }
  std::uint32_t run_count() const { return static_cast<std::uint32_t>(runs_.size() / 2); }

  // As it is uploaded.
  void add_header(const Header& header, std::vector<std::uint32_t>& words) const {
    words.push_back(header.offset);
    if (is_wide_)
      words.insert(words.end(), {header.points, header.spots});
    else
      words.push_back(header.points | header.spots << 16);
    if (!lights_.boxes.empty()) words.push_back(header.boxes);
  }

  // Lists may come in any order; ascending order gives the fewest runs.
  std::span<const std::uint32_t> ascending(std::span<const std::uint32_t> list) {
    if (std::is_sorted(list.begin(), list.end())) return list;
    sorted_.assign(list.begin(), list.end());
    std::sort(sorted_.begin(), sorted_.end());
    return sorted_;
  }

  void add_runs(std::span<const std::uint32_t> list) {
    for (std::size_t from = 0, to = 0; from < list.size(); from = to) {
      for (to = from + 1; to < list.size() && list[to] == list[to - 1] + 1;) ++to;
      runs_.push_back(list[from]);
      runs_.push_back(static_cast<std::uint32_t>(to - from - 1));
    }
  }

  view::LightRanges lights_;
  std::uint32_t bits_ = 8;
  bool is_wide_ = false;
  std::uint64_t count_ = 0;
  std::vector<Header> headers_;
  std::vector<std::uint32_t> runs_, sorted_;  // two numbers per run
  IndexArray indices_;
};

}  // namespace

extern const StorageDescriptor runs_descriptor;
const StorageDescriptor runs_descriptor{
    .name = "runs",
    .summary = "per cell the runs of consecutive light indices, first and length each; entries are runs",
    .source = "run-length coding; for lights that are sorted by position",
    .params = {},
    .make = make_storage<Runs>,
};

}  // namespace clusterbench::assign
