#pragma once
// Reactions of engines to a buffer that is too small, and their cost: tiles that grow (grid/reaction.h) beside the
// requested tiles; cells that read all lights (storage `packed` with max_entries) beside the same storage with room.

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
  int frames = 0, reacted = 0;  // reacted: frames whose tiles are not the requested ones
  int over = 0;                 // frames whose final tiles still need more than the available room
  int steps = 0, changed = 0;   // changed: steps to other tiles
  Vec2i requested{0, 0}, fewest{0, 0};
  Extremes tiles;   // per frame
  Extremes amount;  // entries or words, in a frame's final tiles
};

TileMoves tile_moves(const grid::GridSpec& spec, const PathFrames& path);

// Requested tiles can be too small to be practical: Unity's 8 px make 13 million cells of a picture of 1920 x 1080.
// Cases are counted in them, too, up to this number of cells.
inline constexpr std::int64_t k_most_cells_beside = 1'000'000;
bool can_count_requested_tiles(const grid::GridSpec& spec, Vec2i viewport, int slices);

// A case beside the same case in the grid with the requested tiles.
struct ReactionResult {
  grid::Reaction reaction;
  TileMoves moves;
  std::vector<Vec3i> cells;  // of each frame of the path
  CaseSide reacting;
  std::optional<CaseSide> fixed;  // none if the cells are too many
};

// The grid's cells of each frame of the path.
std::vector<Vec3i> cells_of_frames(const grid::GridSpec& spec, const PathFrames& path, int slices);

// A case beside the same case with room for all lists.
struct FallbackResult {
  int frames = 0;           // with a cell that reads all lights
  std::uint64_t cells = 0;  // that read all lights, over all frames
  CaseSide limited, roomy;
};

// The configuration with this grid changed so that it reacts to nothing.
config::Config without_reaction(const config::Config& config, std::size_t grid);

}  // namespace clusterbench::run
