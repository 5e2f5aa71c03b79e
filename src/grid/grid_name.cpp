// The short name of a grid in case names.

#include <charconv>

#include "core/text.h"
#include "grid/grid.h"

namespace clusterbench::grid {
namespace {

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;  // as short as tells it from every other number
  return {text, end};
}

std::string pair(int a, int b, const char* unit) {
  return (a == b && *unit != '\0' ? std::to_string(a) : std::to_string(a) + "x" + std::to_string(b)) + unit;
}

std::string tiles_name(const Tiling& tiles) {
  const bool by_count = tiles.count.x != 0 || tiles.count.y != 0;
  return by_count ? pair(tiles.count.x, tiles.count.y, "") : pair(tiles.pixels.x, tiles.pixels.y, "px");
}

// "near..far", or "near..first..far"; what the camera or the lights decide is left out.
std::string reach_name(const Slicing& slices) {
  const std::string near = slices.near_m == 0.0 ? "" : number(slices.near_m);
  const std::string far = slices.far_m == 0.0 ? "" : number(slices.far_m);
  const bool has_first = slices.scheme == Scheme::exponential_first;
  if (near.empty() && far.empty()) return has_first ? " first " + number(slices.first_m) : "";
  return " " + near + ".." + (has_first ? number(slices.first_m) + ".." : "") + far;
}

// All of a short list; of a long one its ends, and a digest that tells it from others.
std::string boundaries_name(const std::vector<double>& boundaries) {
  constexpr std::size_t k_most_shown = 17;
  std::string all;
  for (const double boundary : boundaries) all += " " + number(boundary);
  if (boundaries.size() <= k_most_shown) return all;
  return " " + number(boundaries.front()) + ".." + number(boundaries.back()) + " #" + sha256_hex(all).substr(0, 8);
}

std::string slices_name(const Slicing& slices) {
  const std::string count = std::to_string(slices.scheme == Scheme::list ? slices.boundaries_m.size() - 1
                                                                         : static_cast<std::size_t>(slices.count));
  switch (slices.scheme) {
    case Scheme::linear:
      return count + " linear" + reach_name(slices);
    case Scheme::exponential:
      return count + " exponential" + reach_name(slices);
    case Scheme::exponential_first:
      return count + " exponential-first" + reach_name(slices);
    case Scheme::power:
      return count + " power " + number(slices.lambda) + reach_name(slices);
    case Scheme::fit:
      return count + " fit" + reach_name(slices);
    case Scheme::list:
      break;
  }
  return count + " list" + boundaries_name(slices.boundaries_m);
}

std::string cells_name(Vec3i cells) {
  return std::to_string(cells.x) + "x" + std::to_string(cells.y) + "x" + std::to_string(cells.z);
}

}  // namespace

std::string GridSpec::name() const {
  switch (kind) {
    case Kind::frustum:
    case Kind::distance:
      return std::string(kind_name(kind)) + " " + tiles_name(tiles) + " x " + slices_name(slices);
    case Kind::cascades:
      return "cascades " + std::to_string(levels) + " x " + cells_name(cells) + " of " + number(finest_m);
    case Kind::world:
      break;
  }
  std::string text = "world " + cells_name(cells);
  if (has_bounds)
    for (int axis = 0; axis < 3; ++axis) text += " " + number(bounds_lo_m[axis]) + ".." + number(bounds_hi_m[axis]);
  return text;
}

}  // namespace clusterbench::grid
