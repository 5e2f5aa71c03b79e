#pragma once
// Chosen frames cell by cell in a case's result: packed as text (core/run_length_text.h) and limited in size.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "grid/grid.h"
#include "measure/lists/cell_details.h"
#include "view/frame.h"

namespace clusterbench::run {

// The box of a world grid; lo and hi are relative to the origin.
struct DetailsBox {
  Vec3d origin{0.0}, lo{0.0}, hi{0.0};

  friend bool operator==(const DetailsBox&, const DetailsBox&) = default;
};

// One frame. Rows of numbers are text; ascending numbers are stored as gaps.
struct DetailsFrame {
  int frame = 0;
  double time_s = 0.0;
  view::Space camera;  // eye and view rotation
  view::Projection projection;
  std::string boundaries;                 // of the slices, if they differ from the case's grid; else ""
  std::optional<grid::Tiles> tiles = {};  // if they differ from the case's grid
  std::optional<DetailsBox> box;          // of a world grid, if it differs from the case's grid

  std::size_t cell_count = 0;
  std::string cells, reported, truth, false_positives, false_negatives;  // parallel rows; cells as gaps

  std::vector<std::string> light_names;  // of the lights in any list
  // In the order of the names; lights as gaps of the lists' indices, positions x y z in view space.
  std::string lights, light_positions, light_ranges;
  std::size_t spot_count = 0;               // the spots are the last lights, or the last ones before the boxes:
  std::string spot_axes, spot_half_angles;  // x y z in view space; radians
  std::size_t box_count = 0;                // the boxes are the last lights:
  std::string box_half_axes;                // three times x y z in view space

  bool has_pairs = false;
  std::string pair_lights, pair_marks;  // cell after cell; lights as gaps, restarted in each cell
};

struct Details {
  std::size_t max_bytes = 0;
  std::vector<DetailsFrame> frames;  // in order of the path
  // Left out because of max_bytes: whole frames; the pairs of listed frames.
  std::vector<int> frames_left_out, pairs_left_out;
  std::vector<int> frames_not_on_path;
};

// `case_grid`: the grid shown in the case's result.
DetailsFrame packed_frame(const view::Frame& frame, const scene::Scene& scene, const grid::Grid& grid,
                          const grid::Grid& case_grid, const measure::FrameDetails& found, bool with_pairs);

// Adds a frame if it fits. Frames have priority over pairs: pairs of the last frames are removed to fit a further
// frame.
void add_frame(Details& details, DetailsFrame frame);

}  // namespace clusterbench::run
