#pragma once
// Light lists per cell: the format of every assigner's result and of the truth.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "view/frame.h"

namespace clusterbench::assign {

// The lights of cell c are lights[begin[c]] .. lights[begin[c + 1] - 1]: points before spots before boxes, each once,
// otherwise in any order. The truth's lists ascend.
struct Lists {
  std::vector<std::uint32_t> begin;  // cell count + 1
  std::vector<std::uint32_t> lights;

  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(begin.size()) - 1; }
  std::uint32_t pair_count() const { return static_cast<std::uint32_t>(lights.size()); }
  std::span<const std::uint32_t> of(std::uint32_t cell) const {
    return {lights.data() + begin[cell], begin[cell + 1] - begin[cell]};
  }
  // The first cell with the longest list.
  std::uint32_t fullest_cell() const;
  friend bool operator==(const Lists&, const Lists&) = default;
};

// The reason why these are not valid lists for this number of cells and these lights, as a sentence; "" if they are
// valid.
std::string lists_fault(const Lists& lists, std::uint32_t cell_count, const view::LightRanges& ranges);
// The same in memory that is kept: it does not allocate for as many lights as before or fewer.
std::string lists_fault(const Lists& lists, std::uint32_t cell_count, const view::LightRanges& ranges,
                        std::vector<std::uint32_t>& scratch);

// How the lights of each list are ordered. Any order is enough where only their number matters.
enum class ListOrder { any, ascending };

// Does every list ascend, as merges and binary searches need? And a function that sorts them.
bool are_ascending(const Lists& lists);
void make_ascending(Lists& lists);

// Throws Error beyond 2^32 - 1 pairs, the limit of the offsets into lists.
void check_pair_count(std::uint64_t pairs);

// Collects pairs light by light and sorts them by cell with one counting pass. Keeps its memory between frames. Throws
// Error if it would need more than the memory limit (core/memory.h).
class PairBuffer {
 public:
  void start(std::uint32_t cell_count);
  // Lights must come in ascending order; the cells of one light in any order, each once.
  void add(std::uint32_t cell, std::uint32_t light) { add_row(cell, 1, light); }
  // Cells first_cell .. first_cell + count - 1.
  void add_row(std::uint32_t first_cell, std::uint32_t count, std::uint32_t light);
  // Throws Error beyond 2^32 - 1 pairs.
  void finish(Lists& out);
  std::size_t capacity_bytes() const;

 private:
  void grow();

  struct Span {
    std::uint32_t first_cell, count, light;
  };
  std::vector<Span> spans_;
  std::uint64_t pairs_ = 0, most_pairs_ = 0;
  std::uint32_t cell_count_ = 0;
};

}  // namespace clusterbench::assign
