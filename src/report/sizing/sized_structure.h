#pragma once
// A light structure of a result with its buffers, sized for all cameras together (allocation.h), and all that is known
// about its worst frames.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "report/sizing/case_buffers.h"
#include "report/sizing/frame_spread.h"
#include "result/case.h"

namespace clusterbench::report {

// The finding of a search for worse frames (`worst-case`) for a structure.
struct FoundFrame {
  std::string case_name;            // with the searched camera and grid
  std::string measure = "entries";  // the maximised quantity, a name of `worst-case --measure`
  std::string refusal;              // why that case cannot be searched; then all else is empty
  std::string not_compared;         // settings that a file of an earlier version does not record; ""
  std::uint64_t value = 0;          // of the measure
  int evaluations = 0;
  std::uint64_t seed = 1;
  std::string space_flags;               // search::space_flags(); "" also for a file of an earlier version
  std::vector<double> eye_m, direction;  // of the worst frame; a file of an earlier version has no direction
  std::uint64_t lights = 0;              // of the level and those added; 0: unknown
  std::uint64_t lights_in_view = 0, dark_in_view = 0;  // of the worst frame; 0 for a file of an earlier version
  struct Need {
    std::string name;  // of a buffer
    std::uint64_t elements = 0, most = 0;
    std::uint64_t element_bytes = 1;  // more lights can widen it
  };
  std::vector<Need> needs;  // of that frame
};

// Lights missed at samples of a camera that has no grid of its own and uses another camera's.
struct GuestSamples {
  std::string case_name, camera;  // of the grid; of the samples
  std::uint64_t samples = 0, outside = 0, needed = 0, missed = 0, missed_outside = 0;
  int worst_frame = 0;
};

// For a case of an engine whose tiles grow when lists are full (grid/reaction.h): the effect with the engine's default
// room. All other figures of the case are for the requested tiles.
struct GrownTiles {
  std::string case_name;
  std::uint64_t room = 0;                         // entries
  std::uint64_t frames = 0, grown = 0, over = 0;  // of the path; in larger tiles than requested; still without room
  std::uint64_t entries = 0;                      // maximum of a frame's lists in its own tiles
  std::array<int, 2> asked{}, fewest{};           // columns and rows
};

// The needs of some cameras for a buffer: cameras that share it in one frame, or one that uses it alone.
struct FrameGroup {
  std::vector<std::string> cameras;
  std::uint64_t frames = 0, high_water = 0;
  std::optional<FrameSpread> spread;  // none if their paths have different frames
};

struct SizedBuffer {
  std::string name;  // in the structure: "indices"
  std::uint64_t element_bytes = 1;
  std::uint64_t high_water = 0, theoretical_max = 0;  // elements; the largest need seen, and the upper bound
  bool depends_on_view = true;                        // false for a world grid with a fixed place
  bool is_bounded = true;  // theoretical_max holds for other frames, too: false behind a pre-cull, or with fewer cells
  std::optional<std::uint64_t> found;  // elements of the worst frame that a search found; of cameras in one frame, of
                                       // all their worst frames together
  std::size_t found_by = 0;            // index of the structure's search; if several, the one with the largest finding
  std::size_t found_views = 1;         // number of cameras whose worst frames are in `found`
  std::uint64_t apart = 0;        // for cameras in one frame: the sum if each had its maximum at the same time; else 0
  std::string why_sum;            // why high_water is `apart`: their paths have different frames; else ""
  bool has_times = true;          // the added needs are known to be of the same time
  std::string worst_camera;       // with the high-water mark
  std::uint64_t worst_frame = 0;  // on its path
  std::optional<result::CellIndex> worst_cell;  // with the longest list in that frame; none without cells
  // With cameras in one frame: these and the others, each separately. Else empty.
  std::vector<FrameGroup> groups;
  // Of all cameras, in the cases' order; with groups, of the one with the high-water mark.
  std::vector<PathNeed> paths;
  std::vector<Growth> growth;         // every 8th frame first; empty if the result has merged frames
  std::optional<FrameSpread> spread;  // none if the result has no frames

  // Capacity: mark() x margin, at most the theoretical maximum; then filled up to the rounded bytes.
  std::uint64_t capacity = 0, bytes = 0;
  std::uint64_t warn_above = 0;  // elements; the capacity itself if it is the upper bound

  // The basis of the capacity: the larger one of the largest need seen and the largest found by a search.
  std::uint64_t mark() const { return std::max(high_water, found.value_or(0)); }
  // No frame can overflow it.
  bool is_all() const { return is_bounded && capacity == theoretical_max; }
  std::uint64_t double_buffered_bytes() const;
};

// One structure of one scene, viewport (or all) and grid, over all cameras.
struct SizedStructure {
  std::string name;                        // "scene/grid/assigner/storage": a case's name without its camera
  std::string group;                       // "scene/grid"
  std::vector<const result::Case*> cases;  // one per camera, in the result's order
  std::vector<SizedBuffer> buffers;
  std::vector<std::vector<std::string>> views;  // cameras in one frame, as far as this structure has them
  std::vector<std::string> guests;              // cameras without their own grid
  std::vector<GuestSamples> guest_samples;
  std::vector<std::string> left_out;  // cameras without a part in the one grid of others, and not in `cases`
  std::vector<GrownTiles> grown;      // of its cases
  std::vector<FoundFrame> searches;
  std::vector<std::string> taken_by;            // cameras whose conclusion in the result recommends a case of it
  std::string choice;                           // why it is printed, if not for the conclusion; ""
  bool has_boxes = false;                       // the scene has oriented boxes among its lights
  std::optional<std::uint64_t> lights_of_type;  // of the scene, of its most frequent light type; if known
  bool has_grid_cells = true;                   // lists belong to the grid's cells, equal in all frames
  std::size_t jitters = 0;                      // offsets within a pixel that frames use in turn; 0: none

  // The search with the largest value of the measure; a refused one only if there is no other; nullptr without any.
  const FoundFrame* search_for(const std::string& measure) const;
  // The search with the first buffer's finding; a refused one, or nullptr, if there is no finding.
  const FoundFrame* main_search() const;
  bool is_searched() const;  // by a search that was not refused
  std::string camera_of(const FoundFrame& found) const;
  std::size_t searched_cameras() const;
  // The measure that a search should maximise for its buffers; and whether a search did, even a refused one.
  std::string sought_measure() const;
  bool is_sought() const;
  bool is_taken() const { return !taken_by.empty(); }
  bool is_guest(const std::string& camera) const { return std::ranges::find(guests, camera) != guests.end(); }
  std::uint64_t bytes() const;
  std::uint64_t frames() const;  // of all cameras, or of cameras in one frame, each frame once
  // The frames that a buffer's figures cover.
  std::uint64_t frames_of(const SizedBuffer& buffer) const;
};

// The quantity that determines the size of a structure's buffers, a name of `worst-case --measure`: the longest list if
// every cell has room for it, else all entries.
std::string measure_of_buffers(const std::string& storage);

// Cameras drawn in one frame, each with its cases in all viewports; a camera that shares no buffer is alone.
using FrameCameras = std::vector<std::vector<const result::Case*>>;
// All cameras of a structure that have a grid. Those of SizedStructure::views first.
std::vector<FrameCameras> cameras_by_frame(const SizedStructure& structure);
// The number of frames of these cameras.
std::uint64_t frames_of_group(const FrameCameras& cameras);

}  // namespace clusterbench::report
