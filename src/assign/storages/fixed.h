#pragma once
// Room for the same number of lights in every cell: the storage `fixed`, and lists that a shader wrote in this form.

#include <algorithm>
#include <span>
#include <vector>

#include "assign/contract/storage.h"
#include "assign/storages/index_array.h"

namespace clusterbench::assign {

// A u32 count and room for `cap` indices per cell. Without counts, a list that is not full ends with an index that no
// light has. Lights that do not fit are dropped: the last of the list, which are the highest light indices if lists
// ascend.
class FixedLists final : public Storage {
 public:
  struct Form {
    std::uint32_t cap = 0;
    bool has_counts = true;
    std::uint32_t index_bits = 0;  // 0: the narrowest for the rig
    bool is_uploaded = true;       // false: a shader wrote it
  };

  explicit FixedLists(const Form& form) : form_(form) {}

  using Storage::start;
  void start(std::uint32_t cell_count, const view::LightRanges& lights) override;
  void store(const Lists& lists) override;
  void count(const Lists& lists) override;
  // In place of store(), with counts and indices of 32 bits: `counts` of each cell, before dropping; `entries`, `cap`
  // for each cell; `dropped`, a bit for each light that did not fit in some cell.
  void take(std::span<const std::uint32_t> counts, std::span<const std::uint32_t> entries,
            std::span<const std::uint32_t> dropped);

  StructureUse use() const override;
  StructureLimit limit() const override;
  std::vector<BufferNeed> buffers() const override;
  void read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const override;
  Reads reads_of_cell(std::uint32_t cell) const override;
  bool fill_shader_buffers(ShaderBuffers& shader) const override;
  std::uint32_t cell_count() const override { return cell_count_; }
  std::uint32_t index_bits() const override { return indices_.bits(); }

 private:
  void clear_use();
  void add_use(std::span<const std::uint32_t> list);
  void add_use(std::size_t length);
  std::size_t kept_of(std::size_t length) const { return std::min<std::size_t>(length, form_.cap); }
  void keep(std::uint32_t cell, const std::uint32_t* entries, std::size_t length);
  std::uint32_t length_of(std::uint32_t cell) const;
  void end_list(std::uint32_t cell, std::uint32_t length);

  Form form_;
  std::uint32_t lights_ = 0, cell_count_ = 0;
  std::uint64_t kept_ = 0, dropped_pairs_ = 0, overflowing_cells_ = 0;
  std::uint64_t longest_ = 0;  // before dropping
  std::vector<std::uint32_t> counts_;
  std::vector<bool> is_dropped_;
  IndexArray indices_;
};

// `cap`: the room for lights in each cell.
ParamSpec cap_param();

}  // namespace clusterbench::assign
