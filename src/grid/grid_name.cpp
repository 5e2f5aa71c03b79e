// Names of grids for cases and people. Apart from the grids, because a long list of boundaries is named by its digest.

#include <string>

#include "core/text.h"
#include "grid/grid_spec.h"

namespace clusterbench::grid {

namespace {

std::string pair(int a, int b, const char* unit) {
  return (a == b && *unit != '\0' ? std::to_string(a) : std::to_string(a) + "x" + std::to_string(b)) + unit;
}

std::string tiles_name(const Tiling& tiles) {
  if (tiles.aspect > 0.0) return "aspect " + number_name(tiles.aspect);
  return tiles.is_by_count() ? pair(tiles.count.x, tiles.count.y, "") : pair(tiles.pixels.x, tiles.pixels.y, "px");
}

// "near..far", or "near..first..far"; ends that the camera or the lights decide are left out.
std::string reach_name(const Slicing& slices) {
  const std::string near = slices.near_m == 0.0 ? "" : number_name(slices.near_m);
  std::string far = slices.far_default_m == 0.0 ? "" : "far or " + number_name(slices.far_default_m);
  if (slices.far_at_most_m != 0.0) far += (far.empty() ? "at most " : " at most ") + number_name(slices.far_at_most_m);
  if (slices.far_m != 0.0) far = number_name(slices.far_m);
  const bool has_first = slices.scheme == Scheme::exponential_first || slices.scheme == Scheme::cubical_first;
  if (near.empty() && far.empty()) return has_first ? " first " + number_name(slices.first_m) : "";
  return " " + near + ".." + (has_first ? number_name(slices.first_m) + ".." : "") + far;
}

// All boundaries of a short list; for a long one its ends and a digest.
std::string boundaries_name(const std::vector<double>& boundaries) {
  constexpr std::size_t k_most_shown = 17;
  std::string all;
  for (const double boundary : boundaries) all += " " + number_name(boundary);
  if (boundaries.size() <= k_most_shown) return all;
  return " " + number_name(boundaries.front()) + ".." + number_name(boundaries.back()) + " #" +
         sha256_hex(all).substr(0, 8);
}

// " fit lights damped 0.9 step 1.25"
std::string fit_name(const std::optional<Fit>& fit) {
  if (!fit) return "";
  std::string name = std::string(" fit ") + name_of(fit->to);
  if (fit->damping > 0.0) name += " damped " + number_name(fit->damping);
  if (fit->step > 1.0) name += " step " + number_name(fit->step);
  return name;
}

// " react entries 8192 of exact-fast"
std::string reaction_name(const std::optional<Reaction>& reaction) {
  if (!reaction) return "";
  std::string name = std::string(" react ") + name_of(reaction->to) + " " + std::to_string(reaction->most);
  if (reaction->to == Reaction::To::entries) name += " of " + reaction->of;
  if (reaction->most_lights > 0) name += " lights " + std::to_string(reaction->most_lights);
  return name;
}

std::string plain_slices_name(const Slicing& slices) {
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
      return count + " power " + number_name(slices.lambda) + reach_name(slices);
    case Scheme::fit:
      return count + " fit" + reach_name(slices);
    case Scheme::cubical:
      return "cubical" + reach_name(slices);
    case Scheme::cubical_first:
      return "cubical-first" + reach_name(slices);
    case Scheme::list:
      break;
  }
  return count + " list" + boundaries_name(slices.boundaries_m);
}

std::string slices_name(const Slicing& slices) {
  return plain_slices_name(slices) + fit_name(slices.fit) + (slices.linear_when_orthographic ? " or linear" : "");
}

std::string screen_grid_name(const GridSpec& spec) {
  return std::string(kind_name(spec.kind)) + " " + tiles_name(spec.tiles) + " x " + slices_name(spec.slices) +
         reaction_name(spec.reaction);
}

std::string cascades_grid_name(const GridSpec& spec) {
  return "cascades " + std::to_string(spec.levels) + " x " + cells_name(spec.cells) + " of " +
         number_name(spec.finest_m);
}

std::string world_grid_name(const GridSpec& spec) {
  std::string text = "world " + cells_name(spec.cells);
  if (spec.has_bounds)
    for (int axis = 0; axis < 3; ++axis)
      text += " " + number_name(spec.bounds_lo_m[axis]) + ".." + number_name(spec.bounds_hi_m[axis]);
  if (spec.follow == Follow::nothing) return text;
  text += std::string(" follows ") + name_of(spec.follow);
  if (spec.follow != Follow::camera) return text;
  for (int axis = 0; axis < 3; ++axis)
    text += (axis == 0 ? " " : "x") + (spec.follows_camera(axis) ? number_name(spec.cell_size_m[axis]) : "*");
  return text + "m";
}

}  // namespace

std::string GridSpec::name() const {
  switch (kind) {
    case Kind::frustum:
    case Kind::distance:
      return screen_grid_name(*this);
    case Kind::cascades:
      return cascades_grid_name(*this);
    case Kind::world:
      break;
  }
  return world_grid_name(*this);
}

}  // namespace clusterbench::grid
