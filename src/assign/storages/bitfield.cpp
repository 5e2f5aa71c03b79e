#include "assign/storage.h"

#include <bit>

#include "assign/simd/list_forms.h"
#include "core/memory.h"

namespace clusterbench::assign {
namespace {

// One bit per light and cell, in words of 32; no headers, and no cell overflows. Its size never changes.
class Bitfield final : public Storage {
 public:
  explicit Bitfield(const Params&) {}

  void start(std::uint32_t cell_count, std::uint32_t points, std::uint32_t spots) override {
    cell_count_ = cell_count;
    words_per_cell_ = (points + spots + k_bits - 1) / k_bits;
    check_memory("words of bits", std::uint64_t{cell_count} * words_per_cell_, sizeof(std::uint32_t));
    words_.assign(std::size_t{cell_count} * words_per_cell_, 0);
  }

  void store(const Lists& lists) override { write_bits(lists, words_per_cell_, words_.data()); }

  StorageUse use() const override {
    StorageUse use;
    use.index_entries = words_.size();
    use.index_bytes = use.upload_bytes = words_.size() * sizeof(std::uint32_t);
    return use;
  }

  StorageLimit limit() const override { return {words_.size(), words_.size() * sizeof(std::uint32_t)}; }

  Lists read_back() const override {
    Lists lists;
    lists.begin.push_back(0);
    for (std::size_t cell = 0; cell < cell_count_; ++cell) {
      for (std::uint32_t word = 0; word < words_per_cell_; ++word)
        for (std::uint32_t left = words_[cell * words_per_cell_ + word]; left != 0; left &= left - 1)
          lists.lights.push_back(k_bits * word + static_cast<std::uint32_t>(std::countr_zero(left)));
      lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
    }
    return lists;
  }

  std::uint32_t index_bits() const override { return k_bits; }

 private:
  static constexpr std::uint32_t k_bits = 32;

  std::uint32_t cell_count_ = 0, words_per_cell_ = 0;
  std::vector<std::uint32_t> words_;
};

std::unique_ptr<Storage> make(const Params& params) {
  return std::make_unique<Bitfield>(params);
}

}  // namespace

extern const StorageRow bitfield_row;
const StorageRow bitfield_row{
    .name = "bitfield",
    .summary = "one bit per light and cell, in words of 32 bits; entries are words",
    .source = "Humus, Clustered Shading 2015; per tile: Drobot 2017, flat bit array",
    .params = {},
    .make = make,
};

}  // namespace clusterbench::assign
