#pragma once
// Readers of one part of a dump's lists, one for each layout.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "layout/decode.h"

namespace clusterbench::layout {

inline std::string number(std::uint64_t value) {
  return std::to_string(value);
}

template <class T>
const T& needed(const std::optional<T>& part, const ListPart& of, const char* key) {
  if (part) return *part;
  throw Error("", of.pointer + "/" + key, "is missing: layout '" + of.lists.layout + "' needs it");
}

// The lights of one part.
struct PartLights {
  std::uint64_t first = 0, count = 0;

  PartLights(const ListPart& part, std::uint32_t lights) {
    first = part.lists.first_light.value_or(0);
    if (first > lights)
      throw Error("", part.pointer + "/first_light",
                  "is " + number(first) + "; the dump has " + number_of(lights, "light"));
    count = part.lists.lights.value_or(lights - first);
    if (count > lights - first)
      throw Error("", part.pointer + "/lights",
                  "is " + number(count) + " from " + number(first) + " on; the dump has " + number_of(lights, "light"));
  }
};

// An entry of a list, as it lies in its buffer.
struct Place {
  const Buffer* buffer = nullptr;  // null: in the dump itself
  std::uint64_t byte = 0, value = 0;
};

// The lists as they grow, and where the entries of one list are if that is asked for.
class ListSink {
 public:
  explicit ListSink(std::vector<std::uint32_t>& lights, std::vector<Place>* places = nullptr)
      : lights_(lights), places_(places) {}
  std::size_t size() const { return lights_.size(); }
  void add(std::uint64_t light, const Place& place) {
    lights_.push_back(static_cast<std::uint32_t>(light));
    if (places_ != nullptr) places_->push_back(place);
  }

 private:
  std::vector<std::uint32_t>& lights_;
  std::vector<Place>* places_;
};

// Where a list is read.
struct CellRow {
  std::uint32_t cell = 0;
  std::uint64_t row = 0, tile = 0, slice = 0;  // in the part's own order
};

// Reads the lists of one part. A reader's constructor checks all that does not depend on values.
class PartReader {
 public:
  PartReader(const ListPart& part, const Shape& shape) : lights_(part, shape.lights) {}
  virtual ~PartReader() = default;
  PartReader(const PartReader&) = delete;
  PartReader& operator=(const PartReader&) = delete;

  // Appends lights of the dump.
  virtual void read(const CellRow& at, ListSink& out, Faults& faults) const = 0;

 protected:
  std::string lights_text() const { return "the " + number_of(lights_.count, "light"); }

  // False if there is no such light. `first`: the value that means light 0.
  bool add(std::uint64_t value, std::uint64_t first, const Rows& rows, std::uint64_t row, std::uint64_t at,
           const CellRow& cell, ListSink& out, Faults& faults) const {
    const Place place{&rows.buffer(), rows.byte_of(row) + at, value};
    if (value >= first && value - first < lights_.count) {
      out.add(lights_.first + (value - first), place);
      return true;
    }
    faults.add({place.buffer, place.byte, value, cell.cell, index_fault(value, first)});
    return false;
  }
  std::string index_fault(std::uint64_t value, std::uint64_t first) const {
    if (value == k_no_whole) return "an index is no whole number";
    if (value < first) return "index " + number(value) + " is below that of the first light, " + number(first);
    return "index " + number(value) + " is not below " + lights_text() +
           (first > 0 ? ", which begin at " + number(first) : "");
  }

  PartLights lights_;
};

// --- What several readers need. All throw Error ("", JSON pointer) for a description that does not fit ---

// Cells of the part, or tiles.
std::uint64_t rows_of_cells(const ListPart& part, const Shape& shape);
// The part's `rows`, of which the first `row_bytes` bytes are read each.
Rows cell_rows(const BufferReader& reader, const ListPart& part, std::uint64_t rows, std::uint64_t row_bytes);
// The first byte behind all fields.
std::uint64_t end_of(std::span<const Field> fields);

std::unique_ptr<PartReader> make_packed_reader(const ListPart& part, const BufferReader& reader, const Shape& shape);
std::unique_ptr<PartReader> make_fixed_reader(const ListPart& part, const BufferReader& reader, const Shape& shape);
std::unique_ptr<PartReader> make_bits_reader(const ListPart& part, const BufferReader& reader, const Shape& shape);
// Of the part's layout.
std::unique_ptr<PartReader> make_reader(const ListPart& part, const BufferReader& reader, const Shape& shape);

}  // namespace clusterbench::layout
