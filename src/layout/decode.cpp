#include "layout/decode.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "core/error.h"
#include "core/memory.h"
#include "layout/part_reader.h"

namespace clusterbench::layout {
namespace {

// Sorts the list that begins at `begin` and keeps each light once. Returns how many entries that removes.
std::size_t tidy(std::vector<std::uint32_t>& lights, std::size_t begin) {
  const auto from = lights.begin() + static_cast<std::ptrdiff_t>(begin);
  if (!std::is_sorted(from, lights.end())) std::sort(from, lights.end());
  const auto end = std::unique(from, lights.end());
  const auto removed = static_cast<std::size_t>(lights.end() - end);
  lights.erase(end, lights.end());
  return removed;
}

std::string place_text(const Place& place) {
  return place.buffer == nullptr ? std::string("")
                                 : ", first at byte " + number(place.byte) + " of buffer '" + place.buffer->name + "'";
}

void check_pairs(std::size_t pairs, const std::string& pointer) {
  if (pairs <= memory_limit() / sizeof(std::uint32_t) && pairs <= std::numeric_limits<std::uint32_t>::max()) return;
  throw Error("", pointer,
              "its lists have more than " + number(pairs) +
                  " pairs of a cell and a light, which take more memory than " + number(memory_limit() >> 20) + " MiB");
}

// The lists of all parts, cell by cell.
class Decoder {
 public:
  Decoder(std::span<const ListPart> parts, std::span<const Buffer> buffers, const Shape& shape)
      : parts_(parts), shape_(shape) {
    const BufferReader reader(buffers);
    for (const ListPart& part : parts) readers_.push_back(make_reader(part, reader, shape));
  }

  void read_cell(std::uint32_t cell, Vec3i at) {
    std::vector<std::uint32_t>& lights = out_.lists.lights;
    const std::uint64_t unreadable = out_.faults.count;
    ListSink sink(lights);
    read_parts(cell, at, sink, out_.faults);
    const std::size_t removed = tidy(lights, out_.lists.begin.back());
    if (removed > 0 && out_.faults.count == unreadable) add_twice(cell, at, removed);
    check_pairs(lights.size(), parts_.front().pointer);
    out_.lists.begin.push_back(static_cast<std::uint32_t>(lights.size()));
  }
  Decoded& out() { return out_; }

 private:
  void read_parts(std::uint32_t cell, Vec3i at, ListSink& sink, Faults& faults) const {
    const std::uint64_t tile = shape_.order.tile(at, shape_.cells);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const result::DumpLists& lists = parts_[i].lists;
      const bool is_of_tiles = lists.per_tile.value_or(false) || lists.layout.starts_with("bits_and");
      const CellRow row{cell, is_of_tiles ? tile : shape_.order.cell(at, shape_.cells), tile,
                        shape_.order.slice(at.z, shape_.cells)};
      readers_[i]->read(row, sink, faults);
    }
  }

  // Reads the list again, now with the places of its entries.
  void add_twice(std::uint32_t cell, Vec3i at, std::size_t entries) {
    Faults& faults = out_.faults;
    faults.twice += entries;
    if (faults.first_twice.size() >= Faults::k_most_kept) return;
    std::vector<std::uint32_t> lights;
    std::vector<Place> places;
    ListSink sink(lights, &places);
    Faults none;
    read_parts(cell, at, sink, none);
    std::map<std::uint32_t, Place> first;
    for (std::size_t i = 0; i < lights.size() && faults.first_twice.size() < Faults::k_most_kept; ++i) {
      const auto [earlier, is_new] = first.emplace(lights[i], places[i]);
      if (is_new) continue;
      faults.first_twice.push_back(
          {places[i].buffer, places[i].byte, places[i].value, cell,
           "light " + number(lights[i]) + " is twice in its list" + place_text(earlier->second)});
    }
  }

  std::span<const ListPart> parts_;
  const Shape& shape_;
  std::vector<std::unique_ptr<PartReader>> readers_;
  Decoded out_;
};

}  // namespace

Decoded decode(std::span<const ListPart> parts, std::span<const Buffer> buffers, const Shape& shape) {
  Decoder decoder(parts, buffers, shape);
  const std::uint64_t cells = static_cast<std::uint64_t>(shape.cells.x) * static_cast<std::uint64_t>(shape.cells.y) *
                              static_cast<std::uint64_t>(shape.cells.z);
  check_memory("lists of cells", cells + 1, sizeof(std::uint32_t));
  decoder.out().lists.begin.reserve(cells + 1);
  decoder.out().lists.begin.push_back(0);
  std::uint32_t cell = 0;
  for (int z = 0; z < shape.cells.z; ++z)
    for (int y = 0; y < shape.cells.y; ++y)
      for (int x = 0; x < shape.cells.x; ++x) decoder.read_cell(cell++, {x, y, z});
  return std::move(decoder.out());
}

std::uint64_t bytes_of(std::span<const ListPart> parts, std::span<const Buffer> buffers) {
  std::set<std::string> names;
  for (const ListPart& part : parts) {
    if (part.lists.rows) names.insert(part.lists.rows->buffer);
    if (part.lists.entries && part.lists.entries->buffer) names.insert(*part.lists.entries->buffer);
    if (part.lists.ranges) names.insert(part.lists.ranges->buffer);
    if (part.lists.nodes) names.insert(part.lists.nodes->buffer);
  }
  std::uint64_t sum = 0;
  for (const Buffer& buffer : buffers)
    if (names.contains(buffer.name)) sum += buffer.bytes.size();
  return sum;
}

}  // namespace clusterbench::layout
