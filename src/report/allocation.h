#pragma once
// What to allocate for each buffer of a light structure, from a result: the semi-conservative scheme of Persson 2015.
// An engine allocates a buffer once, so all cameras of a scene count together, and the worst frame of any of them
// decides.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace clusterbench::report {

// Of an allocation's bytes: as they are, whole pages of 4 KiB, or the next power of two.
enum class Rounding : std::uint8_t { none, page, power_of_two };

struct AllocationRules {
  double margin = 2.0;   // capacity / high water, before it is rounded
  double warn_at = 0.9;  // share of the capacity
  Rounding rounding = Rounding::page;
};

// What one camera path needs of a buffer, in elements and in the order of its frames.
struct PathNeed {
  std::string camera;
  std::uint64_t frames_per_entry = 1;   // above 1 each entry is the largest of so many successive frames
  std::vector<std::uint64_t> elements;  // one entry where all frames need the same; empty where the result has none
};

// Of the frames of all cameras, each counted once. At most: where an entry stands for several frames it is counted for
// each of them.
struct FrameSpread {
  std::uint64_t min = 0, p50 = 0, p90 = 0, p99 = 0, max = 0;  // nearest rank
  bool is_exact = true;                                       // every entry is one frame
};

struct SizedBuffer {
  std::string name;  // as the structure names it: "indices"
  std::uint64_t element_bytes = 1;
  std::uint64_t high_water = 0, theoretical_max = 0;  // elements
  std::string worst_camera;                           // that made the high-water mark
  std::uint64_t worst_frame = 0;                      // of its path
  nlohmann::ordered_json worst_cell;                  // [x, y, z], its longest list in that frame; null without cells
  std::vector<PathNeed> paths;                        // one per camera, in the order of the cases
  std::optional<FrameSpread> spread;                  // none where the result has no frames

  // Capacity: high water x margin, at most the theoretical maximum; and then what else fits into the rounded bytes.
  std::uint64_t capacity = 0, bytes = 0;
  std::uint64_t warn_above = 0;  // elements; the capacity itself where it is all that there can be

  bool is_all() const { return capacity == theoretical_max; }
  std::uint64_t double_buffered_bytes() const;
};

// One structure of one scene, viewport and grid, over all cameras.
struct SizedStructure {
  std::string name;                                  // "scene/grid/assigner/storage": a case's name without its camera
  std::string group;                                 // "scene/grid"
  std::vector<const nlohmann::ordered_json*> cases;  // one per camera, in the result's order
  std::vector<SizedBuffer> buffers;

  std::uint64_t bytes() const;
};

// Of all cases whose name matches the regular expression `filter` ("" = all). Results of earlier versions have no
// single buffers: theirs are called "entries" and "header_bytes". `result` outlives them. Throws Error if the filter is
// no regex or matches no case.
std::vector<SizedStructure> sized_structures(const nlohmann::ordered_json& result, const std::string& filter,
                                             const AllocationRules& rules);

}  // namespace clusterbench::report
