#pragma once
// What to allocate for each buffer of a light structure, from a result: the semi-conservative scheme of Persson 2015.
// An engine allocates a buffer once, so all cameras of a scene count together, and the worst frame of any of them
// decides.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "report/sizing/case_buffers.h"
#include "result/result.h"

namespace clusterbench::report {

// Of an allocation's bytes: as they are, whole pages of 4 KiB, or the next power of two.
enum class Rounding : std::uint8_t { none, page, power_of_two };

struct AllocationRules {
  double margin = 2.0;   // capacity / high water, before it is rounded
  double warn_at = 0.9;  // share of the capacity
  Rounding rounding = Rounding::page;
};

// What a search for worse frames (`worst-case`) found for a structure.
struct FoundFrame {
  std::string case_name;            // whose camera and grid were searched
  std::string measure = "entries";  // what was made as large as possible, by its name in `worst-case --measure`
  std::string refusal;              // why that case cannot be searched; then nothing else is here
  std::string not_compared;         // of a file of an earlier version: what it does not say; ""
  std::uint64_t value = 0;          // of the measure
  int evaluations = 0;
  std::uint64_t seed = 1;
  std::string space_flags;               // search::space_flags(); "" also of a file of an earlier version
  std::vector<double> eye_m, direction;  // of the worst frame; of a file of an earlier version no direction
  std::uint64_t lights = 0;              // of the level and those added; 0: not known
  std::uint64_t lights_in_view = 0, dark_in_view = 0;  // of the worst frame; 0 of a file of an earlier version
  struct Need {
    std::string name;  // of a buffer
    std::uint64_t elements = 0, most = 0;
    std::uint64_t element_bytes = 1;  // which more lights can widen
  };
  std::vector<Need> needs;  // of that frame
};

// What samples of a camera lack that has no grid of its own and looks them up in another's.
struct GuestSamples {
  std::string case_name, camera;  // whose grid, and whose samples
  std::uint64_t samples = 0, outside = 0, needed = 0, missed = 0, missed_outside = 0;
  int worst_frame = 0;
};

// Of a case of an engine whose tiles grow where lists have no room (grid/reaction.h): what they come to with the room
// that the engine comes with. All else that is told of the case is of tiles that have not grown.
struct GrownTiles {
  std::string case_name;
  std::uint64_t room = 0;                         // entries
  std::uint64_t frames = 0, grown = 0, over = 0;  // of the path; in other tiles than asked for; without room even so
  std::uint64_t entries = 0;                      // the most that a frame's lists take in its own tiles
  std::array<int, 2> asked{}, fewest{};           // columns and rows
};

// Which cases one allocation serves, and what is known besides them.
struct AllocationScope {
  // Each the cameras that are drawn in one frame into one buffer: "left,right"; a name may have a * in it.
  std::vector<std::string> views;
  std::string grid_of;          // of cameras in one frame the only one that has a grid; "": each has its own
  bool over_viewports = false;  // one allocation for all viewports
  std::vector<FoundFrame> found;
  std::vector<GuestSamples> guests;
  std::vector<GrownTiles> grown;
};

// Of the frames of all cameras, each counted once. At most: where an entry stands for several frames it is counted for
// each of them.
struct FrameSpread {
  std::uint64_t min = 0, p50 = 0, p90 = 0, p99 = 0, max = 0;  // nearest rank
  bool is_exact = true;                                       // every entry is one frame
};

// The most that every 8th (4th, 2nd, each) frame needs: as long as it grows, frames between those counted need more.
struct Growth {
  int every = 1;
  std::uint64_t high_water = 0;
};

// What frames of some cameras need of a buffer: of those that share it in one frame, or of one that has it alone.
struct FrameGroup {
  std::vector<std::string> cameras;
  std::uint64_t frames = 0, high_water = 0;
  std::optional<FrameSpread> spread;  // none where their paths have different frames
};

struct SizedBuffer {
  std::string name;  // as the structure names it: "indices"
  std::uint64_t element_bytes = 1;
  std::uint64_t high_water = 0, theoretical_max = 0;  // elements; the most seen, and the most that can be
  bool depends_on_view = true;                        // not in a world grid that stays where it is
  bool is_bounded = true;  // theoretical_max holds for other frames, too: not behind a pre-cull, or with fewer cells
  std::optional<std::uint64_t> found;  // elements of the worst frame that a search found; of cameras in one frame, of
                                       // all their worst frames together
  std::size_t found_by = 0;            // which of the structure's searches; of several the one that found most
  std::size_t found_views = 1;         // how many cameras' worst frames are in `found`
  std::uint64_t apart = 0;             // of cameras in one frame: if each were at its own most at the same time; else 0
  std::string why_sum;                 // why high_water is `apart`: their paths have different frames; else ""
  bool has_times = true;               // what is added is known to be of frames at the same time
  std::string worst_camera;            // that made the high-water mark
  std::uint64_t worst_frame = 0;       // of its path
  std::optional<result::CellIndex> worst_cell;  // its longest list in that frame; none without cells
  // With cameras in one frame: these and the others, each apart. Else empty.
  std::vector<FrameGroup> groups;
  // Of all cameras, in the cases' order; of groups the one that made the high-water mark.
  std::vector<PathNeed> paths;
  std::vector<Growth> growth;         // every 8th frame first; none where the result has merged frames
  std::optional<FrameSpread> spread;  // none where the result has no frames

  // Capacity: mark() x margin, at most the theoretical maximum; and then what else fits into the rounded bytes.
  std::uint64_t capacity = 0, bytes = 0;
  std::uint64_t warn_above = 0;  // elements; the capacity itself where it is all that there can be

  // What the capacity is made of: the larger one of the most seen and the most that a search found.
  std::uint64_t mark() const { return std::max(high_water, found.value_or(0)); }
  // Nothing can overflow.
  bool is_all() const { return is_bounded && capacity == theoretical_max; }
  std::uint64_t double_buffered_bytes() const;
};

// One structure of one scene, viewport (or all) and grid, over all cameras.
struct SizedStructure {
  std::string name;                        // "scene/grid/assigner/storage": a case's name without its camera
  std::string group;                       // "scene/grid"
  std::vector<const result::Case*> cases;  // one per camera, in the result's order
  std::vector<SizedBuffer> buffers;
  std::vector<std::vector<std::string>> views;  // cameras in one frame, as far as they are in it
  std::vector<std::string> guests;              // cameras without a grid of their own
  std::vector<GuestSamples> guest_samples;
  std::vector<std::string> left_out;  // cameras that have no part in the one grid of others, and are not in `cases`
  std::vector<GrownTiles> grown;      // of its cases
  std::vector<FoundFrame> searches;
  std::vector<std::string> taken_by;            // cameras whose conclusion in the result takes a case of it
  std::string choice;                           // why it is printed, beside what the conclusion takes; ""
  bool has_boxes = false;                       // the scene has oriented boxes among its lights
  std::optional<std::uint64_t> lights_of_type;  // of the scene, of the type that has most; where the result tells
  bool has_grid_cells = true;                   // lists are of the grid's cells, the same in all frames
  std::size_t jitters = 0;                      // offsets within a pixel that frames take in turn; 0: none

  // The one with the largest value of the measure, a refused one only if there is no other; nullptr if there was none.
  const FoundFrame* search_for(const std::string& measure) const;
  // The one that made the first buffer's find; a refused one, or nullptr, if none found anything.
  const FoundFrame* main_search() const;
  bool is_searched() const;  // one that was not refused
  std::string camera_of(const FoundFrame& found) const;
  std::size_t searched_cameras() const;
  // What a search has to make large for its buffers; and whether one was for that, a refused one, too.
  std::string sought_measure() const;
  bool is_sought() const;
  bool is_taken() const { return !taken_by.empty(); }
  bool is_guest(const std::string& camera) const { return std::ranges::find(guests, camera) != guests.end(); }
  std::uint64_t bytes() const;
  std::uint64_t frames() const;  // of all cameras, or of cameras in one frame, each frame once
  // Of those that a buffer's figures are of.
  std::uint64_t frames_of(const SizedBuffer& buffer) const;
};

// What makes the buffers of a structure of that storage large, by its name in `worst-case --measure`: the longest list
// where every cell has room for it, and all entries else.
std::string measure_of_buffers(const std::string& storage);

// Of all cases whose name matches the regular expression `filter` ("" = all). Results of earlier versions have no
// single buffers: theirs are called "entries" and "header_bytes". `result` outlives them. Throws Error if the filter is
// no regex or matches no case, and for views that name no two cameras of any scene.
std::vector<SizedStructure> sized_structures(const result::Result& result, const std::string& filter,
                                             const AllocationRules& rules, const AllocationScope& scope = {});

}  // namespace clusterbench::report
