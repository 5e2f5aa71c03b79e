#pragma once
// The lists that a user's shader left, as a light structure: sizes are those of its own buffers; samples read the same
// lists in the storage of that layout.

#include <memory>
#include <string>
#include <vector>

#include "assign/contract/storage.h"
#include "layout/decode.h"

namespace clusterbench::gpu {

// Of one frame: each kind of element of the shader's buffers, and how many are in use.
struct ShaderBufferUse {
  const char* name;  // "indices", "headers"
  std::uint64_t element_bytes = 0, used = 0, room = 0;
  bool is_header = false;
  std::uint64_t entries = 0, entry_room = 0;  // of lists, unless it has headers alone
};

class ShaderLists final : public assign::LightStructure {
 public:
  // `layout`: in whose storage samples read.
  ShaderLists(const std::string& layout, std::uint32_t index_bits);

  struct Contents {
    assign::Lists lists;
    std::vector<ShaderBufferUse> buffers;
    std::uint64_t entries = 0, entry_room = 0;
    std::uint64_t dropped_pairs = 0, overflowing_cells = 0, repeated_pairs = 0;
  };
  void take(Contents contents, const grid::Grid& grid, const view::LightRanges& lights, std::uint64_t per_cell);

  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override {
    return storage_->lights_at(sample, way, out);
  }
  assign::Reads reads_at(const grid::Sample& sample, grid::Log2 way) const override {
    return storage_->reads_at(sample, way);
  }
  assign::StructureUse use() const override;
  assign::StructureLimit limit() const override;
  std::vector<assign::BufferNeed> buffers() const override;
  std::uint32_t index_bits() const override { return index_bits_; }
  bool fill_shader_buffers(assign::ShaderBuffers& shader) const override {
    return storage_->fill_shader_buffers(shader);
  }
  bool has_cells() const override { return true; }
  void expand(assign::Lists& out) const override { out = contents_.lists; }

 private:
  std::unique_ptr<assign::Storage> new_storage(std::uint64_t per_cell) const;

  std::string layout_;
  std::uint32_t index_bits_;
  std::uint64_t per_cell_ = 0;
  std::unique_ptr<assign::Storage> storage_;
  Contents contents_;
};

// How many elements of which buffers a part takes, and its entries. `lists`: its formulas are replaced. `entries`:
// those that all of its lists have.
std::vector<ShaderBufferUse> buffer_use(const result::DumpLists& lists, std::uint64_t rows, std::uint64_t entries,
                                        const std::vector<layout::Buffer>& buffers);

// What counts say beyond the room of their lists (fixed, packed): each is set to what is kept. Returns what was
// dropped.
struct Dropped {
  std::uint64_t pairs = 0, cells = 0;
};
Dropped cut_counts(const result::DumpLists& lists, std::uint64_t rows, std::vector<layout::Buffer>& buffers);

}  // namespace clusterbench::gpu
