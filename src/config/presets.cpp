#include "config/presets.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>

#include "config/assigner_names.h"
#include "core/error.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

int divided_up(int dividend, int divisor) {
  return (dividend + divisor - 1) / divisor;
}

int root_of(int number) {
  return std::max(1, static_cast<int>(std::sqrt(static_cast<double>(number))));
}

// Filament's computeFroxelLayout(): square froxels of a multiple of 8 pixels, for 8192 of them in 16 slices. Its
// divisions are of integers.
Vec2i filament_tile(Vec2i viewport) {
  constexpr int k_tiles = 8192 / 16;
  const auto whole_eights = [](int pixels) { return divided_up(pixels, 8) * 8; };
  const int width = std::max(16, viewport.x), height = std::max(16, viewport.y);
  const int across = divided_up(width, root_of(k_tiles * width / height));
  const int down = divided_up(height, root_of(k_tiles * height / width));
  const int pixels = whole_eights(whole_eights(across) >= down ? across : down);
  return {pixels, pixels};
}

// Bevy's ClusterConfig::FixedZ: 4096 clusters in 24 slices, as many columns to rows as the picture is wide to high.
Vec2i bevy_tile(Vec2i viewport) {
  const double aspect = static_cast<double>(viewport.x) / viewport.y;
  const double rows = std::sqrt(4096.0 / 24.0 / aspect);
  const int columns = std::max(1, static_cast<int>(rows * aspect));
  return {divided_up(viewport.x, columns), divided_up(viewport.y, std::max(1, static_cast<int>(rows)))};
}

constexpr Preset k_presets[] = {
    {.name = "just-cause-3",
     .engine = "Avalanche, Just Cause 3",
     .source = "Persson, Practical Clustered Shading, SIGGRAPH 2015",
     .summary = "64 px tiles, 16 exponential slices with a first one to 5 m, sphere refinement, packed lists",
     .approximated = "lights beyond 500 m, which it draws as sprites of a list of their own, are lost here",
     .unverified = "",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices":
                 {"scheme": "exponential-first", "count": 16, "near": 0.1, "first": 5, "far": 500}},
                 "assigner": {"name": "sphere-refinement", "spot": "narrowing"},
                 "storage": {"name": "packed", "index_bits": "16"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::cpu},
    {.name = "just-cause-2",
     .engine = "Avalanche, Just Cause 2",
     .source = "Persson, Practical Clustered Shading, SIGGRAPH 2015, on the game of 2010",
     .summary = "128 x 128 tiles of 4 m on the ground, 4 lights in each",
     .approximated = "of more than 4 lights the first ones are kept, since which the game kept is not published; "
                     "indices of 16 bits where there are more than 255 lights",
     .unverified = "",
     .most_lights = 256,
     .parts = R"({"grid": {"kind": "world", "cells": [128, 1, 128], "follow": "camera", "cell_size": [4, null, 4]},
                 "assigner": {"name": "world-grid", "spot": "ball"},
                 "storage": {"name": "fixed", "cap": 4, "counts": "none"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::cpu},
    {.name = "humus",
     .engine = "Humus, Clustered Shading demo",
     .source = "Persson, Practical Clustered Shading, SIGGRAPH 2015, on the demo of 2015",
     .summary = "a fixed grid of the world, a bit field per cell",
     .approximated = "64 x 16 x 64 cells, whose number is not in our sources, of the box around all lights; "
                     "how it tests lights is not there either: balls and cones here",
     .unverified = "",
     .most_lights = 128,
     .parts = R"({"grid": {"kind": "world", "cells": [64, 16, 64]}, "assigner": {"name": "world-grid"},
                 "storage": {"name": "bitfield"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::cpu},
    {.name = "ortegren-persson",
     .engine = "Örtegren and Persson",
     .source = "Örtegren and Persson, Clustered Shading: Assigning Lights Using Conservative Rasterization, GPU Pro 7, "
               "2016",
     .summary = "24 x 12 x 64 cells, light meshes rasterised conservatively, linked lists",
     .approximated =
         "how fine its meshes are is not in our sources: the coarsest that are off by a quarter of a tile at most; "
         "exponential slices (it has linear ones, too) from the camera's near to its far plane",
     .unverified = "",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [24, 12]},
                 "slices": {"scheme": "exponential", "count": 64}},
                 "assigner": {"name": "conservative-raster"}, "storage": {"name": "linked"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "daveh355",
     .engine = "DaveH355's tutorial",
     .source = "DaveH355, clustered-shading (OpenGL compute)",
     .summary = "12 x 12 x 24 cells, every light against every cell's box, 100 lights in each",
     .approximated =
         "spots as the balls of their ranges: its lights are points; tiles are not cut off where the screen "
         "is no multiple of 12",
     .unverified = "",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [12, 12]},
                 "slices": {"scheme": "exponential", "count": 24}},
                 "assigner": {"name": "brute-force", "spot": "ball"}, "storage": {"name": "fixed", "cap": 100}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "black-mesa",
     .engine = "Operation Black Mesa",
     .source = "Operation Black Mesa's renderer, articles, part 4",
     .summary = "16 x 9 x 128 cells, sphere against box, an offset and a count into one list",
     .approximated = "lights are not cut by potentially visible sets before; spots as balls",
     .unverified = "",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [16, 9]},
                 "slices": {"scheme": "exponential", "count": 128}},
                 "assigner": {"name": "brute-force", "spot": "ball"}, "storage": {"name": "packed"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "wicked",
     .engine = "Wicked Engine",
     .source = "Wicked Engine, Optimizing tile-based light culling, 2018, and its shaders since (16 px)",
     .summary = "16 px tiles between the depths of their pixels with a 32-bit mask of depth (2.5D)",
     .approximated = "lists per tile where it has bit fields; points and spots, no decals and probes",
     .unverified = "",
     .most_lights = 256,
     .parts =
         R"({"grid": {"kind": "frustum", "tiles": {"pixels": [16, 16]}, "slices": {"scheme": "linear", "count": 1}},
                 "assigner": {"name": "tiled-2.5d", "test": "both", "spot": "ball"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "filament",
     .engine = "Filament",
     .source = "google/filament, Froxelizer.cpp, early 2026",
     .summary =
         "at most 8192 square froxels in 16 slices, the first to 5 m, far at 100 m; sphere refinement, equal lists "
         "shared; all lights for the froxels beyond 64 K records",
     .approximated = "room for 65534 records, where a device with small uniform buffers has less; no limit of 255 per "
                     "froxel nor of "
                     "256 lights in view; logarithms are exact, and no light is lost to them",
     .unverified = "",
     .most_lights = 256,
     .parts = R"({"grid": {"kind": "frustum", "slices":
                 {"scheme": "exponential-first", "count": 16, "first": 5, "far": 100}},
                 "assigner": {"name": "sphere-refinement", "spot": "both"},
                 "storage": {"name": "packed", "equal_lists": "shared", "max_entries": 65534}})",
     .tile_pixels = filament_tile,
     .assigns_on = AssignsOn::cpu},
    {.name = "bevy",
     .engine = "Bevy",
     .source = "bevyengine/bevy, ClusterConfig::default() and assign.rs, early 2026",
     .summary =
         "at most 4096 clusters in 24 slices, the first to 5 m, far at the farthest light; sphere refinement that "
         "takes the centre's row once; after a frame of more than 16384 entries fewer columns and rows",
     .approximated =
         "the first slice can end beyond 5 m; far is that of the frame's own lights, where it has that of the frame "
         "before; columns and rows shrink from those that there are, where it starts from those that it asks for",
     .unverified = "how it rounds columns and rows",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "slices":
                 {"scheme": "exponential-first", "count": 24, "first": 5, "fit": {"to": "lights"}},
                 "react": {"to": "entries", "most": 16384, "of": "bevy-refinement"}},
                 "assigner": {"name": "bevy-refinement"}, "storage": {"name": "packed"}})",
     .tile_pixels = bevy_tile,
     .assigns_on = AssignsOn::cpu},
    {.name = "godot",
     .engine = "Godot 4",
     .source = "Godot 4, clustered forward renderer; version not recorded",
     .summary = "32 px tiles with 32 linear parts of depth, bits per tile",
     .approximated =
         "a ball's and a cone's extents in place of rasterised meshes, which are inflated; elements are not "
         "limited to 512",
     .unverified = "tiles of 32 px",
     .most_lights = 512,
     .parts =
         R"({"grid": {"kind": "frustum", "tiles": {"pixels": [32, 32]}, "slices": {"scheme": "linear", "count": 32}},
                 "assigner": {"name": "tile-ranges"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "three-js",
     .engine = "three.js",
     .source = "three.js, ClusteredLightsNode; version not recorded",
     .summary = "32 px tiles, 24 exponential slices, every light against every cell's box, 64 lights in each",
     .approximated = "spots, which it does not cluster, as the balls of their ranges",
     .unverified = "",
     .most_lights = 1024,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [32, 32]},
                 "slices": {"scheme": "exponential", "count": 24}},
                 "assigner": {"name": "brute-force", "spot": "ball"}, "storage": {"name": "fixed", "cap": 64}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "playcanvas",
     .engine = "PlayCanvas",
     .source = "playcanvas/engine, world-clusters and LightingParams, early 2026",
     .summary = "10 x 3 x 10 cells of the box around the lights, 255 lights in each",
     .approximated =
         "a spot's box is a little smaller than there; lights beside the view that reach the box are listed",
     .unverified = "",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "world", "cells": [10, 3, 10], "follow": "lights"},
                 "assigner": {"name": "light-boxes"}, "storage": {"name": "fixed", "cap": 255, "counts": "none"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::cpu},
    {.name = "babylon",
     .engine = "Babylon.js",
     .source = "Babylon.js, clustered light container; version not recorded",
     .summary = "64 x 64 tiles with bit masks, 16 logarithmic slices with a range of lights sorted by depth",
     .approximated = "tiles are those of a light's outline, where it has those of a square of twice its range, which "
                     "loses close lights at their edges",
     .unverified = "",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [64, 64]},
                 "slices": {"scheme": "exponential", "count": 16}}, "assigner": {"name": "z-binning"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "unity-urp",
     .engine = "Unity URP, Forward+",
     .source = "Unity URP, ForwardLights.cs and its tiling jobs; version not recorded",
     .summary =
         "tiles of 8 px and more with bit masks that fit into 16384 words for the lights in view, 409 logarithmic "
         "depth bins with a range of lights each",
     .approximated =
         "bins as of 225 to 256 lights, whatever their number (4096 words, each bin 2 and its masks); bins have no "
         "masks "
         "of their own; reflection probes, which take bits, too, are none; lights beyond 256 get no bits, and are not "
         "dropped",
     .unverified = "",
     .most_lights = 256,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [8, 8]},
                 "slices": {"scheme": "exponential", "count": 409},
                 "react": {"to": "mask-words", "most": 16384, "most_lights": 256}},
                 "assigner": {"name": "tile-spans"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::cpu},
    {.name = "unity-hdrp",
     .engine = "Unity HDRP",
     .source = "Unity HDRP, light loop; version not recorded",
     .summary = "32 px tiles with 64 geometric slices of their own, half of them before the farthest pixel",
     .approximated =
         "extents and boxes in place of screen box, sphere and hull in turn; coarse lists are not limited to "
         "128",
     .unverified = "",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [32, 32]},
                 "slices": {"scheme": "exponential", "count": 64}},
                 "assigner": {"name": "tile-slices", "least_growth": 1.02}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "unreal",
     .engine = "Unreal Engine",
     .source = "Unreal Engine, LightGridInjection.cpp; version not recorded",
     .summary = "64 px tiles, 32 slices, boxes and cones, a linked list with room for 32 lights per cell",
     .approximated =
         "a blend of linear and exponential slices in place of log2(z B + O) 4.05, which begins near + 9.5 cm "
         "and ends at the farthest light",
     .unverified = "which test it has for cones",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [64, 64]},
                 "slices": {"scheme": "power", "count": 32, "lambda": 0.92}},
                 "assigner": {"name": "brute-force", "spot": "both"},
                 "storage": {"name": "linked", "nodes_per_cell": 32}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "doom-2016",
     .engine = "id Software, DOOM 2016",
     .source = "The devil is in the details, SIGGRAPH 2016",
     .summary = "16 x 8 x 24 cells, exponential slices",
     .approximated =
         "which test and which lists it has is not in our sources: boxes and packed lists here; no limit of "
         "256 lights in view",
     .unverified = "that lists are made on the CPU; the title of the source",
     .most_lights = 256,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [16, 8]},
                 "slices": {"scheme": "exponential", "count": 24}},
                 "assigner": {"name": "aabb"}, "storage": {"name": "packed"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::cpu},
    {.name = "call-of-duty-iw",
     .engine = "Infinity Ward, Call of Duty: Infinite Warfare",
     .source = "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH 2017",
     .summary = "8 px tiles with 256 bits, uniform depth bins with a range of lights each",
     .approximated = "64 bins in place of 8096, since the tool holds each cell against the truth; extents in place of "
                     "rasterised proxies; no limit of 256 lights",
     .unverified = "",
     .most_lights = 256,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [8, 8]}, "slices": {"scheme": "linear", "count": 64}},
                 "assigner": {"name": "z-binning"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
    {.name = "olsson-2012",
     .engine = "Olsson, Billeter and Assarsson",
     .source = "Clustered Deferred and Forward Shading, HPG 2012",
     .summary = "near-cubical cells, as many slices as that takes, lists from a hierarchy of boxes",
     .approximated =
         "lists of all cells, where it makes those of cells with pixels; 64 px tiles, whose size is not in our "
         "sources; bounds are not explicit (see the method `explicit`)",
     .unverified = "that its hierarchy is one of boxes",
     .most_lights = 0,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "cubical"}},
                 "assigner": {"name": "bvh"}, "storage": {"name": "packed"}})",
     .tile_pixels = nullptr,
     .assigns_on = AssignsOn::gpu},
};

}  // namespace

const char* name_of(AssignsOn place) {
  return place == AssignsOn::cpu ? "cpu" : "gpu";
}

std::span<const Preset> presets() {
  return k_presets;
}

const Preset* find_preset(const std::string& name) {
  const auto found = std::ranges::find_if(k_presets, [&](const Preset& preset) { return preset.name == name; });
  return found == std::end(k_presets) ? nullptr : &*found;
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : k_presets) names.emplace_back(preset.name);
  return names;
}

Json preset_parts(const Preset& preset, Vec2i viewport) {
  Json parts = Json::parse(preset.parts);
  if (preset.tile_pixels == nullptr) return parts;
  const Vec2i pixels = preset.tile_pixels(viewport);
  parts["grid"]["tiles"] = {{"pixels", {pixels.x, pixels.y}}};
  return parts;
}

std::vector<std::string> named_presets(std::span<const std::string> entries, const std::string& file,
                                       const std::string& where) {
  const std::vector<std::string> all = preset_names();
  std::vector<std::string> names;
  for (const std::string& entry : entries) {
    bool is_any = false;
    for (const std::string& name : all) {
      if (is_glob(entry) ? fnmatch(entry.c_str(), name.c_str(), 0) != 0 : entry != name) continue;
      is_any = true;
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    if (!is_any)
      throw Error(file, where,
                  "found '" + entry + "'" + did_you_mean(entry, all) + ", allowed: " + joined(all) +
                      ", or a pattern of such names");
  }
  return names;
}

}  // namespace clusterbench::config
