#include "config/grid_json.h"

#include <algorithm>
#include <string>

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr std::pair<const char*, grid::Scheme> k_schemes[] = {{"linear", grid::Scheme::linear},
                                                              {"exponential", grid::Scheme::exponential},
                                                              {"exponential-first", grid::Scheme::exponential_first},
                                                              {"power", grid::Scheme::power},
                                                              {"list", grid::Scheme::list},
                                                              {"fit", grid::Scheme::fit},
                                                              {"cubical", grid::Scheme::cubical},
                                                              {"cubical-first", grid::Scheme::cubical_first}};

constexpr grid::Fit::To k_fits[] = {grid::Fit::To::lights, grid::Fit::To::surfaces, grid::Fit::To::both,
                                    grid::Fit::To::ranges};

bool has_first(grid::Scheme scheme) {
  return scheme == grid::Scheme::exponential_first || scheme == grid::Scheme::cubical_first;
}

bool is_cubical(grid::Scheme scheme) {
  return scheme == grid::Scheme::cubical || scheme == grid::Scheme::cubical_first;
}

grid::Fit fit_of(const Json& fit) {
  grid::Fit out;
  for (const grid::Fit::To to : k_fits)
    if (fit["to"] == grid::name_of(to)) out.to = to;
  out.damping = fit["damping"].get<double>();
  out.step = fit["step"].get<double>();
  return out;
}

grid::Reaction reaction_of(const Json& react) {
  grid::Reaction out;
  if (react["to"] == grid::name_of(grid::Reaction::To::mask_words)) out.to = grid::Reaction::To::mask_words;
  out.most = react["most"].get<std::uint64_t>();
  if (react.contains("of")) out.of = react["of"].get<std::string>();
  if (react.contains("most_lights") && react["most_lights"].is_number())
    out.most_lights = react["most_lights"].get<std::uint64_t>();
  return out;
}

grid::Slicing slicing_of(const Json& slices) {
  grid::Slicing out;
  const std::string name = slices["scheme"].get<std::string>();
  out.scheme = std::find_if(std::begin(k_schemes), std::end(k_schemes), [&](const auto& row) {
                 return name == row.first;
               })->second;
  out.near_m = slices_metres(slices, "near");
  out.far_m = slices_metres(slices, "far");
  out.far_at_most_m = slices_metres(slices, "far_at_most");
  out.far_default_m = slices_metres(slices, "far_default");
  out.linear_when_orthographic = slices.contains("orthographic") && slices["orthographic"] == "linear";
  if (slices.contains("first")) out.first_m = slices_metres(slices, "first");
  if (slices.contains("lambda")) out.lambda = slices["lambda"].get<double>();
  if (slices.contains("boundaries")) out.boundaries_m = slices["boundaries"].get<std::vector<double>>();
  out.count = slices.contains("count") ? slices["count"].get<int>() : static_cast<int>(out.boundaries_m.size()) - 1;
  if (is_cubical(out.scheme)) out.count = 0;
  if (slices.contains("fit") && slices["fit"].is_object()) out.fit = fit_of(slices["fit"]);
  return out;
}

grid::Tiling tiling_of(const Json& tiles) {
  const auto pair = [&](const char* key) {
    return tiles.contains(key) ? Vec2i{tiles[key][0].get<int>(), tiles[key][1].get<int>()} : Vec2i{0, 0};
  };
  return {pair("pixels"), pair("count"), tiles.contains("aspect") ? tiles["aspect"].get<double>() : 0.0};
}

Vec3d point_of(const Json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

Json bounds_json(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

OrderedJson slices_json(const grid::Slicing& slices) {
  OrderedJson out{{"scheme", scheme_name(slices.scheme)}};
  if (slices.scheme == grid::Scheme::list) {
    out["boundaries"] = slices.boundaries_m;
    return out;
  }
  if (!is_cubical(slices.scheme)) out["count"] = slices.count;
  if (slices.near_m != 0.0) out["near"] = slices.near_m;
  if (has_first(slices.scheme)) out["first"] = slices.first_m;
  if (slices.scheme == grid::Scheme::power) out["lambda"] = slices.lambda;
  if (slices.far_m != 0.0) out["far"] = slices.far_m;
  if (slices.far_at_most_m != 0.0) out["far_at_most"] = slices.far_at_most_m;
  if (slices.far_default_m != 0.0) out["far_default"] = slices.far_default_m;
  if (slices.linear_when_orthographic) out["orthographic"] = "linear";
  if (slices.fit)
    out["fit"] = {{"to", grid::name_of(slices.fit->to)}, {"damping", slices.fit->damping}, {"step", slices.fit->step}};
  return out;
}

OrderedJson tiles_json(const grid::Tiling& tiles) {
  if (tiles.aspect > 0.0) return {{"aspect", tiles.aspect}};
  const bool by_pixels = tiles.count.x == 0;
  const Vec2i size = by_pixels ? tiles.pixels : tiles.count;
  OrderedJson out;
  out[by_pixels ? "pixels" : "count"] = {size.x, size.y};
  return out;
}

OrderedJson react_json(const grid::Reaction& reaction) {
  OrderedJson out{{"to", grid::name_of(reaction.to)}, {"most", reaction.most}};
  if (reaction.to == grid::Reaction::To::entries) out["of"] = reaction.of;
  if (reaction.most_lights > 0) out["most_lights"] = reaction.most_lights;
  return out;
}

// null for an axis that does not follow.
OrderedJson cell_size_json(const grid::GridSpec& spec) {
  OrderedJson out = OrderedJson::array();
  for (int axis = 0; axis < 3; ++axis)
    out.push_back(spec.follows_camera(axis) ? OrderedJson(spec.cell_size_m[axis]) : OrderedJson(nullptr));
  return out;
}

// One member of a request; null if it is not set.
OrderedJson requested(const grid::GridSpec& spec, const std::string& key) {
  if (key == "tiles") return tiles_json(spec.tiles);
  if (key == "slices") return slices_json(spec.slices);
  if (key == "react" && spec.reaction) return react_json(*spec.reaction);
  if (key == "cells") return {spec.cells.x, spec.cells.y, spec.cells.z};
  if (key == "levels") return spec.levels;
  if (key == "finest") return spec.finest_m;
  if (key == "bounds" && spec.has_bounds)
    return {{"min", {spec.bounds_lo_m.x, spec.bounds_lo_m.y, spec.bounds_lo_m.z}},
            {"max", {spec.bounds_hi_m.x, spec.bounds_hi_m.y, spec.bounds_hi_m.z}}};
  if (key == "follow" && spec.follow != grid::Follow::nothing) return grid::name_of(spec.follow);
  if (key == "cell_size" && spec.follow == grid::Follow::camera) return cell_size_json(spec);
  return nullptr;
}

// Adds a member to the identity of the grid. Identities are part of recorded results: they must not change.
void add_identity(const grid::GridSpec& spec, const std::string& key, Json& out) {
  const grid::Slicing& slices = spec.slices;
  if (key == "tiles") out[key] = {spec.tiles.pixels.x, spec.tiles.pixels.y, spec.tiles.count.x, spec.tiles.count.y};
  if (key == "tiles" && spec.tiles.aspect > 0.0) out["aspect"] = spec.tiles.aspect;
  if (key == "slices") {
    out[key] = {scheme_name(slices.scheme), slices.count, slices.near_m, slices.far_m, slices.boundaries_m};
    if (has_first(slices.scheme)) out["first"] = slices.first_m;
    if (slices.scheme == grid::Scheme::power) out["lambda"] = slices.lambda;
    if (slices.fit) out["fit"] = {grid::name_of(slices.fit->to), slices.fit->damping, slices.fit->step};
    if (slices.far_at_most_m != 0.0) out["far_at_most"] = slices.far_at_most_m;
    if (slices.far_default_m != 0.0) out["far_default"] = slices.far_default_m;
    if (slices.linear_when_orthographic) out["orthographic"] = "linear";
  }
  if (key == "react" && spec.reaction)
    out[key] = {grid::name_of(spec.reaction->to), spec.reaction->most, spec.reaction->of, spec.reaction->most_lights};
  if (key == "cells") out[key] = {spec.cells.x, spec.cells.y, spec.cells.z};
  if (key == "levels") out[key] = {spec.levels, spec.finest_m};
  if (key == "bounds" && spec.has_bounds) out[key] = {bounds_json(spec.bounds_lo_m), bounds_json(spec.bounds_hi_m)};
  if (key == "follow" && spec.follow != grid::Follow::nothing) out[key] = grid::name_of(spec.follow);
  if (key == "cell_size" && spec.follow == grid::Follow::camera) out[key] = bounds_json(spec.cell_size_m);
}

}  // namespace

const char* scheme_name(grid::Scheme scheme) {
  return std::find_if(std::begin(k_schemes), std::end(k_schemes), [&](const auto& row) { return scheme == row.second; })
      ->first;
}

std::vector<std::string> scheme_names() {
  std::vector<std::string> names;
  for (const auto& [name, scheme] : k_schemes) names.emplace_back(name);
  return names;
}

double slices_metres(const Json& slices, const char* key) {
  return slices.contains(key) && slices[key].is_number() ? slices[key].get<double>() : 0.0;
}

grid::GridSpec grid_spec(const Json& grid) {
  grid::GridSpec spec;
  for (int kind = 0; kind < grid::k_kind_count; ++kind)
    if (grid["kind"] == grid::kind_name(static_cast<grid::Kind>(kind))) spec.kind = static_cast<grid::Kind>(kind);
  if (grid.contains("tiles")) spec.tiles = tiling_of(grid["tiles"]);
  if (grid.contains("slices")) spec.slices = slicing_of(grid["slices"]);
  if (grid.contains("react") && grid["react"].is_object()) spec.reaction = reaction_of(grid["react"]);
  if (grid.contains("cells"))
    spec.cells = {grid["cells"][0].get<int>(), grid["cells"][1].get<int>(), grid["cells"][2].get<int>()};
  if (grid.contains("levels")) spec.levels = grid["levels"].get<int>();
  if (grid.contains("finest")) spec.finest_m = grid["finest"].get<double>();
  if (grid.contains("bounds") && grid["bounds"].is_object()) {
    spec.has_bounds = true;
    spec.bounds_lo_m = point_of(grid["bounds"]["min"]);
    spec.bounds_hi_m = point_of(grid["bounds"]["max"]);
  }
  if (grid.contains("follow"))
    for (const grid::Follow follow : {grid::Follow::camera, grid::Follow::lights})
      if (grid["follow"] == grid::name_of(follow)) spec.follow = follow;
  if (grid.contains("cell_size"))
    for (int axis = 0; axis < 3; ++axis) {
      const Json& size = grid["cell_size"][static_cast<std::size_t>(axis)];
      spec.cell_size_m[axis] = size.is_number() ? size.get<double>() : 0.0;
    }
  return spec;
}

OrderedJson grid_request(const grid::GridSpec& spec) {
  OrderedJson out{{"kind", grid::kind_name(spec.kind)}};
  for (const std::string key : grid::kind_keys(spec.kind))
    if (OrderedJson value = requested(spec, key); !value.is_null()) out[key] = std::move(value);
  return out;
}

Json grid_identity(const grid::GridSpec& spec) {
  Json out{{"kind", grid::kind_name(spec.kind)}};
  for (const std::string key : grid::kind_keys(spec.kind)) add_identity(spec, key, out);
  return out;
}

}  // namespace clusterbench::config
