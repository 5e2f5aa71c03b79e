#include "grid/reaction.h"

#include <algorithm>
#include <cmath>

#include "grid/lights_in_view.h"

namespace clusterbench::grid {

const char* name_of(Reaction::To to) {
  return to == Reaction::To::entries ? "entries" : "mask-words";
}

Tiling shrunk_tiles(const Tiling& requested, Vec2i viewport, std::uint64_t entries, std::uint64_t most) {
  if (entries <= most || requested.aspect > 0.0) return requested;
  const float ratio = std::sqrt(static_cast<float>(most) / static_cast<float>(entries));
  const auto shrunk = [&](int tiles) {
    return std::max(1, static_cast<int>(std::floor(static_cast<float>(tiles) * ratio)));
  };
  const Vec2i before = tile_counts(requested, viewport), now{shrunk(before.x), shrunk(before.y)};
  if (requested.is_by_count()) return {{0, 0}, now, 0.0};
  return {{(viewport.x + now.x - 1) / now.x, (viewport.y + now.y - 1) / now.y}, {0, 0}, 0.0};
}

std::uint64_t mask_words(const Tiling& tiles, Vec2i viewport, std::uint64_t lights) {
  const Vec2i counts = tile_counts(tiles, viewport);
  return static_cast<std::uint64_t>(counts.x) * static_cast<std::uint64_t>(counts.y) * ((lights + 31) / 32);
}

Tiling doubled_tiles(const Tiling& requested, Vec2i viewport, std::uint64_t lights, std::uint64_t most) {
  Tiling tiles = requested;
  if (tiles.is_by_count() || tiles.pixels.x < 1 || tiles.pixels.y < 1) return tiles;
  while (mask_words(tiles, viewport, lights) > most && tile_counts(tiles, viewport) != Vec2i{1, 1})
    tiles.pixels = {2 * tiles.pixels.x, 2 * tiles.pixels.y};
  return tiles;
}

std::uint64_t count_lights_in_view(const view::Frame& frame) {
  return static_cast<std::uint64_t>(std::ranges::count(lights_in_view(frame), true));
}

std::uint64_t lights_with_bits(const Reaction& reaction, const view::Frame& frame) {
  const std::uint64_t lights = count_lights_in_view(frame);
  return reaction.most_lights == 0 ? lights : std::min(lights, reaction.most_lights);
}

}  // namespace clusterbench::grid
