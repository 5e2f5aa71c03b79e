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
};

struct Faults {
  static constexpr std::size_t k_most_kept = 8;
  std::uint64_t count = 0;
  std::vector<Fault> first;
  // Entries of lights that their list has already: such lists can be read. Only of cells without another fault.
  std::uint64_t twice = 0;
  std::vector<Fault> first_twice;

  bool are_readable() const { return count == 0; }
  void add(Fault fault) {
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

// A description one step away from the given one.
struct OtherDescription {
  std::string change;  // "entries as u16"
  std::vector<ListPart> parts;
};
// In the order in which they are believed.
std::vector<OtherDescription> other_descriptions(std::span<const ListPart> parts);

// Another description under which nothing is wrong, as a sentence: "with entries as u16 all 812 indices are below 300".
// The first of other_descriptions() that leaves at least half of the indices that are right in any of them, the given
// one included; nullopt if none of them fits.
std::optional<std::string> likely_reading(std::span<const ListPart> parts, std::span<const Buffer> buffers,
                                          const Shape& shape);

// Bytes of the buffers that these parts are read from, each buffer once.
std::uint64_t bytes_of(std::span<const ListPart> parts, std::span<const Buffer> buffers);

}  // namespace clusterbench::layout
