#pragma once
// The one decoder: from buffers in any layout to lists per cell. What cannot be right is found on the way: offsets and
// counts beyond their buffer, indices of lights that do not exist, a light twice in a cell.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assign/contract/lists.h"
#include "layout/buffers.h"
#include "layout/cell_order.h"

namespace clusterbench::layout {

// One part of the lists with its place in the dump, for messages: "/lists/2".
struct ListPart {
  result::DumpLists lists;
  std::string pointer;
};

struct Shape {
  Vec3i cells{0};
  CellOrder order;
  std::uint32_t lights = 0;
};

// A value that cannot be right.
struct Fault {
  const Buffer* buffer = nullptr;  // null: in the dump itself
  std::uint64_t byte = 0;          // in the buffer's file
  std::uint64_t value = 0;
  std::uint32_t cell = 0;  // numbered as the grid's
  std::string message;     // "index 412 is not below the 300 lights"
  bool is_twice = false;   // a light that is twice in its list, which is readable all the same
};

struct Faults {
  static constexpr std::size_t k_most_kept = 8;
  std::uint64_t count = 0, twice = 0;  // all; of them lights that are twice in their list
  std::vector<Fault> first;

  bool are_readable() const { return count == twice; }
  void add(Fault fault) {
    twice += fault.is_twice ? 1 : 0;
    if (count++ < k_most_kept) first.push_back(std::move(fault));
  }
};

struct Decoded {
  assign::Lists lists;  // cells as the grid's (x fastest, from the top, from the near end), lights ascending, each once
  Faults faults;
};

// The union of the parts. A cell's list ends before what is wrong in it. Throws Error ("", JSON pointer) where the
// description itself does not fit: an unknown buffer, a missing field, rows beyond the end of a buffer, more pairs than
// the limit on memory allows.
Decoded decode(std::span<const ListPart> parts, std::span<const Buffer> buffers, const Shape& shape);

// Another description under which nothing is wrong, as a sentence: "with entries as u16 all 812 indices are below 300".
// The nearest to the given one; nullopt if none of those that are tried fits.
std::optional<std::string> likely_reading(std::span<const ListPart> parts, std::span<const Buffer> buffers,
                                          const Shape& shape);

// Bytes of the buffers that these parts are read from, each buffer once.
std::uint64_t bytes_of(std::span<const ListPart> parts, std::span<const Buffer> buffers);

}  // namespace clusterbench::layout
