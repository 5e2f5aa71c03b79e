#include "assign/contract/lists.h"

#include <algorithm>
#include <limits>

#include "assign/simd/descents.h"
#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::assign {

void check_pair_count(std::uint64_t pairs) {
  if (pairs > std::numeric_limits<std::uint32_t>::max())
    throw Error("", "lists", "hold " + std::to_string(pairs) + " pairs; at most 2^32 - 1 fit");
}

std::uint32_t Lists::fullest_cell() const {
  std::uint32_t longest = 0, fullest = 0;
  for (std::uint32_t cell = 0; cell < cell_count(); ++cell) {
    const std::uint32_t count = begin[cell + 1] - begin[cell];
    if (count > longest) {
      longest = count;
      fullest = cell;
    }
  }
  return fullest;
}

std::string lists_fault(const Lists& lists, std::uint32_t cell_count, const view::LightRanges& ranges) {
  std::vector<std::uint32_t> scratch;
  return lists_fault(lists, cell_count, ranges, scratch);
}

std::string lists_fault(const Lists& lists, std::uint32_t cell_count, const view::LightRanges& ranges,
                        std::vector<std::uint32_t>& listed_in) {
  if (lists.begin.size() != cell_count + std::size_t{1}) return "not one list per cell";
  if (lists.begin.front() != 0 || lists.begin.back() != lists.lights.size()) return "lists do not cover the indices";
  listed_in.assign(ranges.size(), cell_count);
  for (std::uint32_t cell = 0; cell < cell_count; ++cell) {
    const auto here = [cell](const char* fault) { return fault + (" (cell " + std::to_string(cell) + ")"); };
    if (lists.begin[cell] > lists.begin[cell + 1]) return here("a list of negative length");
    if (lists.begin[cell + 1] > lists.lights.size()) return here("a list that ends behind the indices");
    std::size_t type = 0;
    for (const std::uint32_t light : lists.of(cell)) {
      if (light >= listed_in.size()) return here("a light that does not exist");
      if (listed_in[light] == cell) return here("lights not each once");
      listed_in[light] = cell;
      if (ranges.type_of(light) < type) return here(type == 1 ? "a point light behind spots" : "a light behind boxes");
      type = ranges.type_of(light);
    }
  }
  return "";
}

// If all lists ascend, descents occur only between the end of one list and the beginning of the next. Counting the
// descents over all entries at once is many times faster than list by list.
bool are_ascending(const Lists& lists) {
  const std::uint32_t* const lights = lists.lights.data();
  std::uint32_t between_lists = 0;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const std::uint32_t at = lists.begin[cell];
    if (at > lists.begin.front() && at < lists.begin[cell + 1]) between_lists += lights[at] < lights[at - 1];
  }
  return descents(lights + lists.begin.front(), lists.begin.back() - lists.begin.front()) == between_lists;
}

void make_ascending(Lists& lists) {
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
    std::sort(lists.lights.begin() + lists.begin[cell], lists.lights.begin() + lists.begin[cell + 1]);
}

void PairBuffer::start(std::uint32_t cell_count) {
  check_memory("lists of cells", std::uint64_t{cell_count} + 1, sizeof(std::uint32_t));
  cell_count_ = cell_count;
  pairs_ = 0;
  most_pairs_ = memory_limit() / sizeof(std::uint32_t);
  spans_.clear();
}

void PairBuffer::add_row(std::uint32_t first_cell, std::uint32_t count, std::uint32_t light) {
  if (spans_.size() == spans_.capacity()) grow();
  spans_.push_back({first_cell, count, light});
  pairs_ += count;
  if (pairs_ > most_pairs_) check_memory("pairs of light lists", pairs_, sizeof(std::uint32_t));
}

// Grows as a vector would, but checks the memory limit first.
void PairBuffer::grow() {
  const std::size_t wider = std::max<std::size_t>(1, 2 * spans_.capacity());
  check_memory("spans of light lists", wider, sizeof(Span));
  spans_.reserve(wider);
}

void PairBuffer::finish(Lists& out) {
  check_memory("pairs of light lists", pairs_, sizeof(std::uint32_t));
  check_pair_count(pairs_);

  // begin[c] is first the count of cell c, then its list's start, and its end once the lights are written. Shifted by
  // one place, the ends are the starts again.
  out.begin.assign(cell_count_ + std::size_t{1}, 0);
  for (const Span& span : spans_)
    for (std::uint32_t cell = span.first_cell; cell < span.first_cell + span.count; ++cell) ++out.begin[cell];
  out.lights.resize(pairs_);
  std::uint32_t start = 0;
  for (std::uint32_t& entry : out.begin) {
    const std::uint32_t count = entry;
    entry = start;
    start += count;
  }
  for (const Span& span : spans_)
    for (std::uint32_t cell = span.first_cell; cell < span.first_cell + span.count; ++cell)
      out.lights[out.begin[cell]++] = span.light;
  for (std::size_t cell = cell_count_; cell > 0; --cell) out.begin[cell] = out.begin[cell - 1];
  out.begin[0] = 0;
}

std::size_t PairBuffer::capacity_bytes() const {
  return spans_.capacity() * sizeof(Span);
}

}  // namespace clusterbench::assign
