#include "config/presets/preset_tiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clusterbench::config {
namespace {

int divided_up(int dividend, int divisor) {
  return (dividend + divisor - 1) / divisor;
}

int root_of(int number) {
  return std::max(1, static_cast<int>(std::sqrt(static_cast<double>(number))));
}

// Froxelizer::computeFroxelLayout(): square froxels of a multiple of 8 pixels, for 8192 of them in 16 slices. Divisions
// are integer divisions, as there.
nlohmann::json filament_tiles(Vec2i viewport) {
  constexpr int k_tiles = 8192 / 16;
  const auto whole_eights = [](int pixels) { return divided_up(pixels, 8) * 8; };
  const int width = std::max(16, viewport.x), height = std::max(16, viewport.y);
  const int across = divided_up(width, root_of(k_tiles * width / height));
  const int down = divided_up(height, root_of(k_tiles * height / width));
  const int pixels = whole_eights(whole_eights(across) >= down ? across : down);
  return {{"pixels", {pixels, pixels}}};
}

// ClusterConfig::FixedZ: 4096 clusters in 24 slices, with the picture's aspect ratio of columns to rows. The tile size
// is rounded to whole pixels and gives the number of tiles, which are then spread evenly over the viewport.
nlohmann::json bevy_tiles(Vec2i viewport) {
  const double aspect = static_cast<double>(viewport.x) / viewport.y;
  const double per_slice = 4096.0 / 24.0, height = std::sqrt(per_slice / aspect);
  int columns = static_cast<int>(height * aspect), rows = static_cast<int>(height);
  if (columns == 0) columns = 1, rows = static_cast<int>(per_slice);
  if (rows == 0) columns = static_cast<int>(per_slice), rows = 1;
  const auto tiles = [](int pixels, int wanted) { return divided_up(pixels, divided_up(pixels, wanted)); };
  return {{"count", {tiles(viewport.x, columns), tiles(viewport.y, rows)}}};
}

// LightModule: 32 px, doubled until there are at most 8192 tiles.
nlohmann::json eevee_tiles(Vec2i viewport) {
  int pixels = 32;
  while (divided_up(viewport.x, pixels) * divided_up(viewport.y, pixels) > 8192) pixels *= 2;
  return {{"pixels", {pixels, pixels}}};
}

constexpr std::pair<const char*, TilesBy> k_tiles_by[] = {
    {"filament", filament_tiles}, {"bevy", bevy_tiles}, {"eevee", eevee_tiles}};

}  // namespace

TilesBy find_tiles_by(const std::string& name) {
  for (const auto& [word, tiles] : k_tiles_by)
    if (name == word) return tiles;
  return nullptr;
}

std::vector<std::string> tiles_by_names() {
  std::vector<std::string> names;
  for (const auto& [word, tiles] : k_tiles_by) names.emplace_back(word);
  return names;
}

}  // namespace clusterbench::config
