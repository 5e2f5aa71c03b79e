#include "assign/storages/fixed.h"

#include <algorithm>

#include "core/memory.h"

namespace clusterbench::assign {

void FixedLists::start(std::uint32_t cell_count, const view::LightRanges& lights) {
  lights_ = lights.size();
  cell_count_ = cell_count;
  const std::uint32_t bits =
      form_.index_bits != 0 ? form_.index_bits : narrowest_bits(form_.has_counts ? lights_ : lights_ + 1);
  check_memory("entries of fixed lists", std::uint64_t{cell_count} * form_.cap, bits / 8);
  indices_.make_room(static_cast<std::size_t>(cell_count) * form_.cap, bits);
  if (form_.has_counts) check_memory("counts of fixed lists", cell_count, sizeof(std::uint32_t));
  counts_.assign(form_.has_counts ? cell_count : 0, 0);
  if (!form_.has_counts)
    for (std::uint32_t cell = 0; cell < cell_count; ++cell) end_list(cell, 0);
  clear_use();
}

void FixedLists::store(const Lists& lists) {
  clear_use();
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    add_use(lists.of(cell));
    keep(cell, lists.of(cell).data(), lists.of(cell).size());
  }
}

void FixedLists::count(const Lists& lists) {
  clear_use();
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) add_use(lists.of(cell));
}

void FixedLists::take(std::span<const std::uint32_t> counts, std::span<const std::uint32_t> entries,
                      std::span<const std::uint32_t> dropped) {
  clear_use();
  for (std::uint32_t cell = 0; cell < cell_count_; ++cell) {
    add_use(counts[cell]);
    keep(cell, entries.data() + std::size_t{cell} * form_.cap, counts[cell]);
  }
  for (std::uint32_t light = 0; light < lights_; ++light)
    is_dropped_[light] = (dropped[light / 32] >> light % 32 & 1u) != 0;
}

void FixedLists::clear_use() {
  kept_ = dropped_pairs_ = overflowing_cells_ = longest_ = 0;
  is_dropped_.assign(lights_, false);
}

void FixedLists::add_use(std::span<const std::uint32_t> list) {
  add_use(list.size());
  for (const std::uint32_t light : list.subspan(kept_of(list.size()))) is_dropped_[light] = true;
}

// Of a list before dropping.
void FixedLists::add_use(std::size_t length) {
  const std::size_t kept = kept_of(length);
  longest_ = std::max<std::uint64_t>(longest_, length);
  kept_ += kept;
  dropped_pairs_ += length - kept;
  overflowing_cells_ += length > kept ? 1 : 0;
}

// The first of `length` entries.
void FixedLists::keep(std::uint32_t cell, const std::uint32_t* entries, std::size_t length) {
  const std::size_t kept = kept_of(length);
  indices_.write(static_cast<std::size_t>(cell) * form_.cap, entries, kept);
  end_list(cell, static_cast<std::uint32_t>(kept));
}

StructureUse FixedLists::use() const {
  StructureUse use;
  use.index_entries = kept_;
  use.index_bytes = std::uint64_t{cell_count_} * form_.cap * (indices_.bits() / 8);
  use.header_bytes = counts_.size() * sizeof(std::uint32_t);
  use.upload_bytes = form_.is_uploaded ? use.index_bytes + use.header_bytes : 0;
  use.dropped_pairs = dropped_pairs_;
  use.overflowing_cells = overflowing_cells_;
  for (std::uint32_t light = 0; light < lights_; ++light)
    if (is_dropped_[light]) use.dropped_lights.push_back(light);
  return use;
}

// Its size never changes.
StructureLimit FixedLists::limit() const {
  const std::uint64_t entries = std::uint64_t{cell_count_} * form_.cap;
  return {entries, entries * (indices_.bits() / 8) + counts_.size() * sizeof(std::uint32_t)};
}

// Room for the longest list in every cell, whatever the cap.
std::vector<BufferNeed> FixedLists::buffers() const {
  const std::uint64_t cells = cell_count_;
  std::vector<BufferNeed> all{{"indices", indices_.bits() / 8, cells * longest_, cells * lights_, cells}};
  if (form_.has_counts) all.push_back({"counts", sizeof(std::uint32_t), cells, cells});
  return all;
}

void FixedLists::read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const {
  const std::uint32_t length = length_of(cell);
  for (std::uint32_t i = 0; i < length; ++i) out.push_back(indices_.read(std::size_t{cell} * form_.cap + i));
}

Reads FixedLists::reads_of_cell(std::uint32_t cell) const {
  const std::uint64_t lights = length_of(cell), end_mark = !form_.has_counts && lights < form_.cap ? 1 : 0;
  return Reads::of(form_.has_counts ? 1 : 0, sizeof(std::uint32_t)) + Reads::of(lights + end_mark, indices_.bits() / 8);
}

bool FixedLists::fill_shader_buffers(ShaderBuffers& shader) const {
  shader.begin_again({.walk = Walk::fixed, .index_bytes = indices_.bits() / 8, .per_cell = form_.cap});
  shader.add("indices", indices_.bytes(std::size_t{cell_count_} * form_.cap), indices_.bits() / 8);
  if (form_.has_counts)
    shader.add("counts", std::span<const std::uint32_t>(counts_));
  else
    shader.end_mark = lights_;
  return true;
}

std::uint32_t FixedLists::length_of(std::uint32_t cell) const {
  if (form_.has_counts) return counts_[cell];
  std::uint32_t length = 0;
  while (length < form_.cap && indices_.read(std::size_t{cell} * form_.cap + length) != lights_) ++length;
  return length;
}

void FixedLists::end_list(std::uint32_t cell, std::uint32_t length) {
  if (form_.has_counts)
    counts_[cell] = length;
  else if (length < form_.cap)
    indices_.write(std::size_t{cell} * form_.cap + length, &lights_, 1);
}

ParamSpec cap_param() {
  return {.name = "cap",
          .summary = "room for lights in each cell",
          .default_value = 100.0,
          .unit = "lights",
          .min = 1.0,
          .max = 65535.0,
          .choices = {},
          .whole = true};
}

namespace {

std::unique_ptr<Storage> make_fixed(const Params& params) {
  return std::make_unique<FixedLists>(FixedLists::Form{.cap = static_cast<std::uint32_t>(params.number("cap")),
                                                       .has_counts = params.text("counts") == "kept"});
}

}  // namespace

extern const StorageDescriptor fixed_descriptor;
const StorageDescriptor fixed_descriptor{
    .name = "fixed",
    .summary =
        "room for the same number of lights in every cell; what does not fit is dropped, the highest light indices "
        "first",
    .source = "DaveH355, three.js, PlayCanvas",
    .params = {cap_param(),
               {.name = "counts",
                .summary =
                    "how a shader knows where a list ends. kept: by a count of 4 bytes per cell; none: by an index "
                    "that is no light's, unless the list is full (PlayCanvas, Just Cause 2)",
                .default_value = std::string("kept"),
                .unit = "",
                .choices = {"kept", "none"},
                .is_late = true}},
    .make = make_fixed,
};

}  // namespace clusterbench::assign
