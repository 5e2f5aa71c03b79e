#include "assign/contract/storage.h"

#include <bit>

#include "assign/storages/list_encodings.h"
#include "core/memory.h"

namespace clusterbench::assign {
namespace {

// One bit per light and cell, in words of 32; no headers, and no cell overflows. Its size never changes.
class Bitfield final : public Storage {
 public:
  explicit Bitfield(const Params&) {}

  void start(std::uint32_t cell_count, const view::LightRanges& lights) override {
    cell_count_ = cell_count;
    words_per_cell_ = (lights.size() + k_bits - 1) / k_bits;
    check_memory("words of bits", std::uint64_t{cell_count} * words_per_cell_, sizeof(std::uint32_t));
    words_.assign(std::size_t{cell_count} * words_per_cell_, 0);
  }

  void store(const Lists& lists) override { write_bits(lists, words_per_cell_, words_.data()); }
  void count(const Lists&) override {}

  StructureUse use() const override {
    StructureUse use;
    use.index_entries = words_.size();
    use.index_bytes = use.upload_bytes = words_.size() * sizeof(std::uint32_t);
    return use;
  }

  StructureLimit limit() const override { return {words_.size(), words_.size() * sizeof(std::uint32_t)}; }

  std::vector<BufferNeed> buffers() const override {
    return {{"words", sizeof(std::uint32_t), words_.size(), words_.size()}};
  }

  void read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const override {
    for (std::uint32_t word = 0; word < words_per_cell_; ++word)
      for (std::uint32_t left = words_[std::size_t{cell} * words_per_cell_ + word]; left != 0; left &= left - 1)
        out.push_back(k_bits * word + static_cast<std::uint32_t>(std::countr_zero(left)));
  }

  // All words of the cell; up to 32 lights fit into a single one.
  Reads reads_of_cell(std::uint32_t) const override { return Reads::of(words_per_cell_, sizeof(std::uint32_t)); }

  bool fill_shader_buffers(ShaderBuffers& shader) const override {
    shader.begin_again({.walk = Walk::bitfield, .per_cell = words_per_cell_});
    shader.add("words", std::span<const std::uint32_t>(words_));
    return true;
  }
  std::uint32_t cell_count() const override { return cell_count_; }

  std::uint32_t index_bits() const override { return k_bits; }

 private:
  static constexpr std::uint32_t k_bits = 32;

  std::uint32_t cell_count_ = 0, words_per_cell_ = 0;
  std::vector<std::uint32_t> words_;
};

}  // namespace

extern const StorageDescriptor bitfield_descriptor;
const StorageDescriptor bitfield_descriptor{
    .name = "bitfield",
    .summary = "one bit per light and cell, in words of 32 bits; entries are words",
    .source = "Humus, Clustered Shading 2015; per tile: Drobot 2017, flat bit array",
    .params = {},
    .make = make_storage<Bitfield>,
};

}  // namespace clusterbench::assign
