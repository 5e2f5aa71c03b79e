#include "run/findings/reaction_meter.h"

#include "run/cases/path_frames.h"

namespace clusterbench::run {

TileMoves tile_moves(const grid::GridSpec& spec, const PathFrames& path) {
  TileMoves moves;
  moves.requested = moves.fewest = grid::tile_counts(spec.tiles, path.viewport());
  const grid::Tiling* before = nullptr;
  for (const FrameReaction& frame : path.reactions(spec)) {
    const Vec2i tiles = grid::tile_counts(frame.tiles, path.viewport());
    ++moves.frames;
    moves.reacted += frame.tiles == spec.tiles ? 0 : 1;
    moves.over += frame.amount > spec.reaction->most ? 1 : 0;
    if (before != nullptr) {
      ++moves.steps;
      moves.changed += frame.tiles == *before ? 0 : 1;
    }
    moves.fewest = glm::min(moves.fewest, tiles);
    moves.tiles.add(static_cast<double>(tiles.x) * tiles.y);
    moves.amount.add(static_cast<double>(frame.amount));
    before = &frame.tiles;
  }
  return moves;
}

bool can_count_requested_tiles(const grid::GridSpec& spec, Vec2i viewport, int slices) {
  const Vec2i tiles = grid::tile_counts(spec.tiles, viewport);
  return static_cast<std::int64_t>(tiles.x) * tiles.y * slices <= k_most_cells_beside;
}

std::vector<Vec3i> cells_of_frames(const grid::GridSpec& spec, const PathFrames& path, int slices) {
  std::vector<Vec3i> cells;
  for (const FrameReaction& frame : path.reactions(spec))
    cells.emplace_back(grid::tile_counts(frame.tiles, path.viewport()), slices);
  return cells;
}

config::Config without_reaction(const config::Config& config, std::size_t grid) {
  config::Config out = config;
  out.grids[grid] = out.grids[grid].unreacting();
  return out;
}

}  // namespace clusterbench::run
