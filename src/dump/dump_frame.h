#pragma once
// The frame of a dump: its camera, its lights and its grid, in this program's terms.

#include <vector>

#include "dump/dump_file.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::dump {

struct DumpFrame {
  view::Frame frame;
  grid::Grid grid;
  // Of the frame's lights, which are sorted by type: the index in the dump, and back.
  std::vector<std::uint32_t> dump_index, frame_index;
  // Of `grid`. A world grid in a left-handed world is mirrored as its lights are: its slices are the dump's from the
  // other end.
  layout::CellOrder order;
  bool has_mirrored_cells = false;

  layout::Shape shape() const { return {grid.cells(), order, static_cast<std::uint32_t>(frame_index.size())}; }
  // Column, row and slice of a cell in the dump's own world.
  Vec3i dump_cell(std::uint32_t cell) const {
    Vec3i at = grid.cell_at(cell);
    if (has_mirrored_cells) at.z = grid.cells().z - 1 - at.z;
    return at;
  }
  // Lists of the dump's lights as lists of the frame's, ascending.
  assign::Lists in_frame(assign::Lists lists) const;
};

// Throws Error (file, JSON pointer or byte) for whatever makes no frame: NaN in a light, a singular matrix, slices that
// do not ascend.
DumpFrame frame_of(const DumpFile& dump);
bool has_lights_in_view_space(const DumpFile& dump);
// With another camera, and with lights in another space.
DumpFrame frame_of(const DumpFile& dump, const result::DumpCamera& camera);
DumpFrame frame_of(const DumpFile& dump, const result::DumpCamera& camera, bool are_lights_in_view_space);

layout::CellOrder order_of(const result::DumpGrid& grid);

// --- Parts of it ---

// The lights that are described by numbers, in the order of the dump. Throws Error (the file, byte or JSON pointer).
std::vector<scene::WorldLight> lights_of(const DumpFile& dump);

// Throws Error ("", JSON pointer).
grid::Grid grid_of(const result::DumpGrid& grid, const view::Frame& frame);

}  // namespace clusterbench::dump
