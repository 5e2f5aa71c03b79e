#pragma once
// Frames, grids and lists of this program as dumps: `clusterbench run --write-dump`.

#include <filesystem>
#include <string>

#include "grid/grid.h"
#include "layout/describe.h"
#include "result/documents/dump.h"
#include "view/frame.h"

namespace clusterbench::dump {

// A dump in memory.
struct MadeDump {
  result::Dump record;                  // its buffers have no files yet
  std::vector<layout::Buffer> buffers;  // by name
};

// Camera, grid and lights as doubles, so that the truth of the dump is that of the frame to the bit. `lists`: cells in
// `order`. Throws Error for boxes, cascades, and tiles that no viewport gives.
MadeDump make_dump(const view::Frame& frame, const grid::Grid& grid, const layout::Described& lists,
                   const layout::CellOrder& order = {});

// Writes FOLDER/NAME.json and FOLDER/NAME.BUFFER.bin for each buffer. Throws Error.
std::filesystem::path write_dump(MadeDump dump, const std::filesystem::path& folder, const std::string& name);

}  // namespace clusterbench::dump
