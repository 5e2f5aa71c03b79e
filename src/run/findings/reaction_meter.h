#pragma once
// What engines do where a buffer is too small, and what it costs: tiles that grow (grid/reaction.h) beside the tiles
// that were asked for; cells that read all lights (storage `packed` with max_entries) beside the same with room.

#include <cstdint>
#include <optional>
#include <vector>

#include "config/config.h"
#include "grid/grid_spec.h"
#include "run/findings/case_side.h"

namespace clusterbench::run {

class PathFrames;

// Tiles along a path. A step leads from one frame to the next.
struct TileMoves {
  int frames = 0, reacted = 0;  // reacted: frames with other tiles than asked for
  int over = 0;                 // frames whose own tiles still take more than there is room for
  int steps = 0, changed = 0;   // changed: steps to other tiles
  Vec2i asked{0, 0}, fewest{0, 0};
  Extremes tiles;   // in a frame
  Extremes amount;  // entries or words, in a frame's own tiles
};

TileMoves tile_moves(const grid::GridSpec& spec, const PathFrames& path);

// The tiles asked for may be so small that nobody could have them: Unity's 8 px make 13 million cells of a picture of
// 1920 x 1080. Cases are counted in them, too, up to so many cells.
inline constexpr std::int64_t k_most_cells_beside = 1'000'000;
bool can_be_counted_as_asked(const grid::GridSpec& spec, Vec2i viewport, int slices);

// A case beside the same in the grid whose tiles are those asked for.
struct ReactionResult {
  grid::Reaction reaction;
  TileMoves moves;
  std::vector<Vec3i> cells;  // of each frame of the path
  CaseSide reacting;
  std::optional<CaseSide> fixed;  // none of too many cells
};

// The grid's cells of each frame of the path.
std::vector<Vec3i> cells_of_frames(const grid::GridSpec& spec, const PathFrames& path, int slices);

// A case beside the same with room for all lists.
struct FallbackResult {
  int frames = 0;           // with a cell that reads all lights
  std::uint64_t cells = 0;  // that do, over all frames
  CaseSide limited, roomy;
};

// The configuration with this grid not reacting to anything.
config::Config without_reaction(const config::Config& config, std::size_t grid);

}  // namespace clusterbench::run
