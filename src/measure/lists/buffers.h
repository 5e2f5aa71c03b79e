#pragma once
// Buffer high-water marks of one light structure over all frames, and the recommended allocation.

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "assign/contract/light_structure.h"
#include "measure/lists/path_series.h"

namespace clusterbench::measure {

// The allocation rule: recommended = high-water x margin (never above the theoretical maximum, never below the
// storage's fixed layout). The run-time warning fires at warn_at of the recommended size.
struct AllocationRule {
  double margin = 2.0;
  double warn_at = 0.9;
};

struct HighWater {
  std::uint64_t high_water = 0, theoretical_max = 0, recommended = 0;
};

// The need of one buffer of the structure (assign::BufferNeed), over all frames.
struct BufferHighWater {
  static constexpr std::size_t k_most_entries = 4096;  // nearly every path frame by frame, for the tail estimate

  std::string name;
  std::uint32_t element_bytes = 0;
  std::uint64_t step = 1, high_water = 0, theoretical_max = 0;  // elements; step: of the worst frame
  int worst_frame = 0;
  std::optional<std::uint32_t> worst_cell;  // with the longest list before entries are dropped; none without cells
  PathSeries along_path{k_most_entries};    // elements
};

struct Buffers {
  HighWater index_entries, bytes;  // bytes: headers + indices
  std::uint32_t index_bits = 0;
  std::uint64_t header_bytes = 0;  // high water
  double upload_bytes_mean = 0.0;
  std::uint64_t upload_bytes_max = 0;
  double traffic_bytes_mean = 0.0;
  std::uint64_t traffic_bytes_max = 0;
  std::uint64_t dropped_pairs = 0, overflowing_cells = 0;
  int overflowing_frames = 0;
  std::uint64_t repeated_pairs = 0;  // a light in a list where it is already
  std::set<std::uint32_t> dropped_lights;
  std::uint64_t fallback_cells = 0;  // cells without room that read the list of all lights, over all frames
  int fallback_frames = 0;
  std::uint64_t scratch_bytes = 0;             // of the assigner, high water
  int worst_frame = 0;                         // with the high-water mark of index entries
  std::optional<std::uint32_t> worst_cell;     // with the longest list before entries are dropped; none without cells
  double in_use_mean = 0.0, in_use_max = 0.0;  // share of the recommended entries in use per frame
  PathSeries bytes_along_path;                 // headers + indices
  std::vector<BufferHighWater> each;
};

class BufferMeter {
 public:
  explicit BufferMeter(AllocationRule rule) : rule_(rule) {}
  // `lists`: of the cells, before entries are dropped; null without cells.
  void add_frame(int frame, const assign::LightStructure& structure, const assign::Lists* lists,
                 std::size_t scratch_bytes);
  Buffers result() const;

 private:
  void add_to_each(int frame, const std::vector<assign::BufferNeed>& needs, const assign::Lists* lists);

  AllocationRule rule_;
  Buffers sum_;
  std::uint64_t entries_total_ = 0, upload_total_ = 0, traffic_total_ = 0;
  std::uint64_t laid_out_entries_ = 0;  // high water; above the entries in use if each cell has a reserved range
  int frames_ = 0;
};

}  // namespace clusterbench::measure
