#pragma once
// Structures that are made from lists: the buffers that an engine uploads, and their cost.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assign/contract/assigner.h"
#include "assign/contract/light_structure.h"

namespace clusterbench::assign {

class Storage : public LightStructure {
 public:
  // For frames of this grid, which must outlive the storage. Samples are looked up in the grid.
  void start(const grid::Grid& grid, const view::LightRanges& lights);
  // Without a lookup.
  virtual void start(std::uint32_t cell_count, const view::LightRanges& lights) = 0;
  // The lights of the next lists, if they differ from those at the start: no more in total, but spots may begin at
  // another index.
  virtual void set_types(const view::LightRanges& lights) { static_cast<void>(lights); }
  // Converts one frame's lists; no allocation in a steady state. Timed as the conversion.
  virtual void store(const Lists& lists) = 0;
  // In place of store() where only sizes are read: use() and buffers() are those after store(). What cells hold is
  // undefined until the next store().
  virtual void count(const Lists& lists) { store(lists); }
  // Appends the lights that a shader would read for a cell: its list without the dropped lights.
  virtual void read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const = 0;
  virtual Reads reads_of_cell(std::uint32_t cell) const = 0;
  virtual std::uint32_t cell_count() const = 0;

  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const final;
  Reads reads_at(const grid::Sample& sample, grid::Log2 way) const final;
  bool has_cells() const final { return true; }
  void expand(Lists& out) const final;

 protected:
  // The number of cells in a row of the grid; 0 without a lookup.
  std::uint32_t columns() const { return grid_ == nullptr ? 0 : static_cast<std::uint32_t>(grid_->cells().x); }

 private:
  const grid::Grid* grid_ = nullptr;
};

struct StorageDescriptor {
  std::string name;
  std::string summary;
  std::string source;
  std::vector<ParamSpec> params;
  std::unique_ptr<Storage> (*make)(const Params& params);
  // Parameters of the same storage with room for all lists, if a full buffer could make cells read another list; the
  // other storages are measured beside it. Null: there are no such parameters.
  std::optional<Params> (*without_fallback)(const Params& params) = nullptr;
};

// For a storage in a configuration, from its descriptor.
std::optional<Params> without_fallback(const StorageDescriptor& storage, const Params& params);

// For descriptors: makes a storage from its parameters.
template <class Kept>
std::unique_ptr<Storage> make_storage(const Params& params) {
  return std::make_unique<Kept>(params);
}

std::span<const StorageDescriptor* const> storage_descriptors();
const StorageDescriptor* find_storage(const std::string& name);
std::vector<std::string> storage_names();

}  // namespace clusterbench::assign
