#pragma once
// How lists are kept in the buffers that an engine uploads, and what that costs.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "assign/assigner.h"
#include "assign/lists.h"

namespace clusterbench::assign {

// What one frame's lists take. Entries are light indices, the words of a bitfield or the nodes of linked
// lists.
struct StorageUse {
  std::uint64_t index_entries = 0;
  std::uint64_t index_bytes = 0;
  std::uint64_t header_bytes = 0;
  std::uint64_t upload_bytes = 0;   // what is copied to the GPU this frame
  std::uint64_t dropped_pairs = 0;  // overflow
  std::uint64_t overflowing_cells = 0;
  std::vector<std::uint32_t> dropped_lights;  // which, ascending, each once
};

// The most that lists of this grid and rig could ever take.
struct StorageLimit {
  std::uint64_t index_entries = 0;
  std::uint64_t bytes = 0;  // headers included
};

class Storage {
 public:
  virtual ~Storage() = default;
  virtual void start(std::uint32_t cell_count, std::uint32_t points, std::uint32_t spots) = 0;
  // Converts one frame's lists; no allocation in a steady state. Timed as the conversion.
  virtual void store(const Lists& lists) = 0;
  virtual StorageUse use() const = 0;
  virtual StorageLimit limit() const = 0;
  // What a shader would read back, for tests: the lists less what was dropped.
  virtual Lists read_back() const = 0;
  virtual std::uint32_t index_bits() const = 0;  // of an entry
};

struct StorageRow {
  std::string name;
  std::string summary;
  std::string source;
  std::vector<ParamSpec> params;
  std::unique_ptr<Storage> (*make)(const Params& params);
};

std::span<const StorageRow* const> storage_rows();
const StorageRow* find_storage(const std::string& name);
std::vector<std::string> storage_names();

}  // namespace clusterbench::assign
