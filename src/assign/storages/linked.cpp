#include <algorithm>

#include "assign/contract/storage.h"
#include "core/memory.h"

namespace clusterbench::assign {
namespace {

// A u32 head per cell, and a pool of nodes {light u32, next u32}. A full pool drops the same pairs as if lights came
// one after the other: the last lights, and for one light the last cells.
class Linked final : public Storage {
 public:
  explicit Linked(const Params& params) : nodes_per_cell_(params.number("nodes_per_cell")) {}

  void start(std::uint32_t cell_count, const view::LightRanges& lights) override {
    check_memory("heads of linked lists", cell_count, sizeof(std::uint32_t));
    heads_.assign(cell_count, k_end);
    capacity_ = static_cast<std::uint64_t>(nodes_per_cell_ * cell_count);
    room_.assign(lights.size(), 0);
    is_dropped_.assign(lights.size(), false);
  }

  void store(const Lists& lists) override {
    const std::uint64_t kept = std::min<std::uint64_t>(capacity_, lists.pair_count());
    if (nodes_.size() < kept) {
      check_memory("nodes of linked lists", kept, sizeof(Node));
      nodes_.resize(kept);
    }
    used_ = 0;
    overflowing_cells_ = 0;
    dropped_pairs_ = lists.pair_count() - kept;
    is_dropped_.assign(room_.size(), false);
    if (dropped_pairs_ > 0) share_room(lists);
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) store_cell(cell, lists.of(cell));
  }

  StructureUse use() const override {
    StructureUse use;
    use.index_entries = used_;
    use.index_bytes = used_ * sizeof(Node);
    use.header_bytes = heads_.size() * sizeof(std::uint32_t);
    use.upload_bytes = use.index_bytes + use.header_bytes;
    use.dropped_pairs = dropped_pairs_;
    use.overflowing_cells = overflowing_cells_;
    for (std::uint32_t light = 0; light < is_dropped_.size(); ++light)
      if (is_dropped_[light]) use.dropped_lights.push_back(light);
    return use;
  }

  StructureLimit limit() const override {
    const std::uint64_t entries = std::min(capacity_, std::uint64_t{heads_.size()} * room_.size());
    return {entries, entries * sizeof(Node) + heads_.size() * sizeof(std::uint32_t)};
  }

  // A node for every pair, whatever the pool.
  std::vector<BufferNeed> buffers() const override {
    const std::uint64_t cells = heads_.size();
    return {{"nodes", sizeof(Node), used_ + dropped_pairs_, cells * room_.size()},
            {"heads", sizeof(std::uint32_t), cells, cells}};
  }

  void read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const override {
    for (std::uint32_t node = heads_[cell]; node != k_end; node = nodes_[node].next) out.push_back(nodes_[node].light);
  }

  Reads reads_of_cell(std::uint32_t cell) const override {
    std::uint64_t nodes = 0;
    for (std::uint32_t node = heads_[cell]; node != k_end; node = nodes_[node].next) ++nodes;
    return Reads::of(1, sizeof(std::uint32_t)) + Reads::of(nodes, sizeof(Node));
  }

  bool fill_shader_buffers(ShaderBuffers& shader) const override {
    shader.begin_again({.walk = Walk::linked});
    shader.add("nodes", std::span<const Node>(nodes_).first(used_));
    shader.add("heads", std::span<const std::uint32_t>(heads_));
    return true;
  }
  std::uint32_t cell_count() const override { return static_cast<std::uint32_t>(heads_.size()); }

  std::uint32_t index_bits() const override { return 8 * sizeof(Node); }

 private:
  static constexpr std::uint32_t k_end = 0xffffffff;
  struct Node {
    std::uint32_t light, next;
  };

  // The number of nodes that each light gets.
  void share_room(const Lists& lists) {
    std::fill(room_.begin(), room_.end(), 0);
    for (const std::uint32_t light : lists.lights) ++room_[light];
    std::uint64_t left = capacity_;
    for (std::uint32_t& room : room_) {
      room = static_cast<std::uint32_t>(std::min<std::uint64_t>(room, left));
      left -= room;
    }
  }

  bool has_room(std::uint32_t light) {
    if (dropped_pairs_ == 0) return true;
    if (room_[light] == 0) {
      is_dropped_[light] = true;
      return false;
    }
    --room_[light];
    return true;
  }

  // New nodes are inserted at the front, starting with the last light, so that the list keeps its order.
  void store_cell(std::uint32_t cell, std::span<const std::uint32_t> list) {
    const std::uint32_t used_before = used_;
    std::uint32_t head = k_end;
    for (std::size_t i = list.size(); i-- > 0;) {
      if (!has_room(list[i])) continue;
      nodes_[used_] = {list[i], head};
      head = used_++;
    }
    heads_[cell] = head;
    if (used_ - used_before < list.size()) ++overflowing_cells_;
  }

  double nodes_per_cell_;
  std::uint64_t capacity_ = 0, dropped_pairs_ = 0, overflowing_cells_ = 0;
  std::uint32_t used_ = 0;
  std::vector<std::uint32_t> heads_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> room_;  // of each light, if the pool is too small
  std::vector<bool> is_dropped_;
};

}  // namespace

extern const StorageDescriptor linked_descriptor;
const StorageDescriptor linked_descriptor{
    .name = "linked",
    .summary =
        "head per cell (4 bytes), nodes of light and next (8 bytes) from one pool; what does not fit is dropped, "
        "the last lights first; entries are nodes",
    .source = "Örtegren and Persson 2016, GPU Pro 7; Unreal's light grid",
    .params = {{.name = "nodes_per_cell",
                .summary = "nodes in the pool, per cell of the grid",
                .default_value = 32.0,
                .unit = "nodes",
                .min = 0.01,
                .max = 65535.0,
                .choices = {}}},
    .make = make_storage<Linked>,
};

}  // namespace clusterbench::assign
