#include "run/grid_facts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "config/grid_json.h"

namespace clusterbench::run {
namespace {

using Json = nlohmann::json;

Json lookup_facts(const grid::SliceLookup& lookup) {
  constexpr const char* k_forms[] = {"linear", "log2", "search"};
  Json facts{{"form", k_forms[static_cast<int>(lookup.form)]}};
  if (lookup.form == grid::SliceLookup::Form::search) return facts;
  facts["scale"] = lookup.scale;
  facts["bias"] = lookup.bias;
  if (lookup.first_slice > 0) facts["first"] = lookup.first_m;
  return facts;
}

// Why the slices of a camera without a far plane end where they do (which changes lists), and how to set another end.
std::string end_text(const grid::Slicing& slices, double far_m) {
  char at[40];
  std::snprintf(at, sizeof at, "%.4g m", far_m);
  const std::string remedy = "; --set 'scenes.*.far=METRES' gives cameras the far plane of your game";
  if (slices.far_at_most_m > 0.0 && far_m >= slices.far_at_most_m)
    return std::string("the grid ends at ") + at +
           ", its slices' far_at_most, whether lights in view reach farther or not";
  if (slices.far_default_m > 0.0)
    return std::string(k_no_far_plane) + ": the grid ends at " + at +
           ", as that of the engine's own cameras does by default (slices.far_default)" + remedy;
  return std::string(k_no_far_plane) + " and " + k_ends_with_lights + ": the grid ends at " + at +
         ", beyond which no light in view reaches, and lists depend on that" + remedy;
}

std::string note_of_reaction(const grid::Reaction& reaction) {
  return std::string("tiles react to ") +
         (reaction.to == grid::Reaction::To::entries ? "the entries of the frame before" : "the lights in view") +
         ": these are the last frame's";
}

std::string note_of_fit(const grid::Fit& fit) {
  constexpr const char* k_followed[] = {"lights in view", "visible surfaces", "lights in view and the visible surfaces",
                                        "ranges of the lights in view"};
  return std::string("slices follow the ") + k_followed[static_cast<int>(fit.to)] + ": these are the last frame's";
}

// Ratio of depth to height of cells at their near side, from the second slice on: the first slice also holds everything
// in front of it.
Json aspect_facts(const grid::ScreenGrid& grid) {
  const std::vector<float>& at = grid.slices.boundaries;
  const double height = static_cast<double>(grid.tiles.y_max(0)) - static_cast<double>(grid.tiles.y_min(0));
  double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
  for (std::size_t i = at.size() > 2 ? 1 : 0; i + 1 < at.size(); ++i) {
    const double scale = grid.tiles.orthographic ? 1.0 : static_cast<double>(at[i]);
    const double aspect = (static_cast<double>(at[i + 1]) - static_cast<double>(at[i])) / (height * scale);
    least = std::min(least, aspect);
    greatest = std::max(greatest, aspect);
  }
  return {{"min", least}, {"max", greatest}};
}

// One overload per kind of grid.
void add_facts(Json& facts, const grid::GridSpec& spec, const grid::ScreenGrid& grid, double camera_far_m) {
  const bool by_count = spec.tiles.is_by_count() || spec.tiles.aspect > 0.0;
  facts["tiles"] = {{by_count ? "count" : "pixels", by_count ? Json{grid.tiles.count.x, grid.tiles.count.y}
                                                             : Json{grid.tiles.pixels.x, grid.tiles.pixels.y}}};
  facts["slices"] = {{"scheme", config::scheme_name(spec.slices.scheme)},
                     {"boundaries", grid.slices.boundaries},
                     {"lookup", lookup_facts(grid.slices.lookup)}};
  if (spec.has_cell_shape()) facts["aspect"] = aspect_facts(grid);
  if (spec.slices.scheme == grid::Scheme::fit)
    facts["note"] = "slices follow the lights in view: these are the last frame's";
  else if (spec.slices.fit)
    facts["note"] = note_of_fit(*spec.slices.fit);
  else if (std::isinf(camera_far_m) && spec.slices.scheme != grid::Scheme::list && spec.slices.far_m == 0.0)
    facts["note"] = end_text(spec.slices, grid.slices.boundaries.back());
  if (!spec.reaction) return;
  const std::string other = facts.value("note", "");
  facts["note"] = note_of_reaction(*spec.reaction) + (other.empty() ? "" : "; " + other);
}

void add_facts(Json& facts, const grid::GridSpec&, const grid::CascadesGrid& grid, double) {
  facts["levels"] = grid.levels;
  facts["finest"] = grid.finest_m;
}

void add_facts(Json& facts, const grid::GridSpec& spec, const grid::WorldGrid& grid, double) {
  const auto size = [](const std::vector<float>& planes) {
    return (planes.back() - planes.front()) / static_cast<float>(planes.size() - 1);
  };
  facts["origin"] = {grid.origin.x, grid.origin.y, grid.origin.z};
  facts["bounds"] = {{"min", {grid.x.front(), grid.y.front(), grid.z.front()}},
                     {"max", {grid.x.back(), grid.y.back(), grid.z.back()}}};
  facts["cell_size"] = {size(grid.x), size(grid.y), size(grid.z)};
  if (spec.follow == grid::Follow::nothing) return;
  facts["follow"] = grid::name_of(spec.follow);
  facts["note"] = spec.follow == grid::Follow::camera
                      ? "the grid follows the camera in whole cells: origin and bounds are the last frame's"
                      : "the grid follows the lights in view: origin, bounds and cell_size are the last frame's";
}

}  // namespace

Json grid_facts(const grid::GridSpec& spec, const grid::Grid& grid, double camera_far_m) {
  const Vec3i cells = grid.cells();
  Json facts{{"kind", grid::kind_name(grid.kind())}, {"name", spec.name()}, {"cells", {cells.x, cells.y, cells.z}}};
  std::visit([&](const auto& shape) { add_facts(facts, spec, shape, camera_far_m); }, grid.shape);
  return facts;
}

}  // namespace clusterbench::run
