#include "assign/contract/storage.h"

namespace clusterbench::assign {

// One per file in storages/.
extern const StorageDescriptor packed_descriptor, fixed_descriptor, bitfield_descriptor, linked_descriptor,
    runs_descriptor;

void Storage::start(const grid::Grid& grid, const view::LightRanges& lights) {
  grid_ = &grid;
  start(grid.cell_count(), lights);
}

bool Storage::lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const {
  out.clear();
  const std::int64_t cell = grid::lookup(*grid_, sample, way);
  if (cell < 0) return false;
  read_cell(static_cast<std::uint32_t>(cell), out);
  return true;
}

Reads Storage::reads_at(const grid::Sample& sample, grid::Log2 way) const {
  const std::int64_t cell = grid::lookup(*grid_, sample, way);
  return cell < 0 ? Reads{} : reads_of_cell(static_cast<std::uint32_t>(cell));
}

void Storage::expand(Lists& out) const {
  out.lights.clear();
  out.begin.assign(1, 0);
  for (std::uint32_t cell = 0; cell < cell_count(); ++cell) {
    read_cell(cell, out.lights);
    out.begin.push_back(out.pair_count());
  }
}

std::span<const StorageDescriptor* const> storage_descriptors() {
  static constexpr const StorageDescriptor* k_rows[] = {&packed_descriptor, &fixed_descriptor, &bitfield_descriptor,
                                                        &linked_descriptor, &runs_descriptor};
  return k_rows;
}

std::optional<Params> without_fallback(const StorageDescriptor& storage, const Params& params) {
  return storage.without_fallback == nullptr ? std::nullopt : storage.without_fallback(params);
}

const StorageDescriptor* find_storage(const std::string& name) {
  for (const StorageDescriptor* row : storage_descriptors())
    if (row->name == name) return row;
  return nullptr;
}

std::vector<std::string> storage_names() {
  std::vector<std::string> names;
  for (const StorageDescriptor* row : storage_descriptors()) names.push_back(row->name);
  return names;
}

}  // namespace clusterbench::assign
