// Clusterings known from papers, talks and articles.

#include "config/preset_tables.h"

namespace clusterbench::config {
namespace {

constexpr Preset k_published[] = {
    {.name = "just-cause-3",
     .engine = "Avalanche, Just Cause 3",
     .version = "2015",
     .evidence = Evidence::read,
     .source = "Persson, Practical Clustered Shading, SIGGRAPH 2015",
     .summary = "64 px tiles, 16 exponential slices with a first one to 5 m, sphere refinement, packed lists",
     .approximated = "lights beyond 500 m, which it draws as sprites of a list of their own, are lost here",
     .unverified = "",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices":
                 {"scheme": "exponential-first", "count": 16, "near": 0.1, "first": 5, "far": 500}},
                 "assigner": {"name": "sphere-refinement", "spot": "narrowing"},
                 "storage": {"name": "packed", "index_bits": "16"}})"},
    {.name = "just-cause-2",
     .engine = "Avalanche, Just Cause 2",
     .version = "2010",
     .evidence = Evidence::read,
     .source = "Persson, Practical Clustered Shading, SIGGRAPH 2015, on the game",
     .summary = "128 x 128 tiles of 4 m on the ground, 4 lights in each",
     .approximated =
         "of more than 4 lights in a tile, and of more than 256 in view, the first ones are kept, since which "
         "the game kept is not published",
     .unverified = "",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "world", "cells": [128, 1, 128], "follow": "camera", "cell_size": [4, null, 4]},
                 "assigner": {"name": "world-grid", "spot": "sphere"},
                 "storage": {"name": "fixed", "cap": 4, "counts": "none"},
                 "pre_cull": ["frustum", {"most": {"lights": 256}}]})"},
    {.name = "humus",
     .engine = "Humus, Clustered Shading demo",
     .version = "2015",
     .evidence = Evidence::read,
     .source = "Persson, Practical Clustered Shading, SIGGRAPH 2015, on the demo",
     .summary = "a fixed grid of the world, a bit field per cell",
     .approximated =
         "64 x 16 x 64 cells of the box around all lights, tests by spheres and cones, and the first 128 lights "
         "of the scene: how many cells, which test and which lights it has is not in our sources",
     .unverified = "",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "world", "cells": [64, 16, 64]}, "assigner": {"name": "world-grid"},
                 "storage": {"name": "bitfield"}, "pre_cull": [{"most": {"lights": 128}}]})"},
    {.name = "ortegren-persson",
     .engine = "Örtegren and Persson",
     .version = "2016",
     .evidence = Evidence::read,
     .source = "Örtegren and Persson, Clustered Shading: Assigning Lights Using Conservative Rasterization, GPU Pro 7",
     .summary = "24 x 12 x 64 cells, light meshes rasterised conservatively, linked lists",
     .approximated =
         "meshes are the coarsest that are off by a quarter of a tile at most, slices are exponential from near to far "
         "though it has linear ones, too, and the pool of 32 nodes per cell is ours, not the chapter's",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [24, 12]},
                 "slices": {"scheme": "exponential", "count": 64}},
                 "assigner": {"name": "conservative-raster"}, "storage": {"name": "linked"}})"},
    {.name = "daveh355",
     .engine = "DaveH355's tutorial",
     .version = "not recorded",
     .evidence = Evidence::read,
     .source = "DaveH355, clustered-shading (OpenGL compute)",
     .summary = "12 x 12 x 24 cells, every light against every cell's box, 100 lights in each",
     .approximated = "spots are the spheres of their ranges, since its lights are points, and tiles are not cut off "
                     "where the screen "
                     "is no multiple of 12",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [12, 12]},
                 "slices": {"scheme": "exponential", "count": 24}},
                 "assigner": {"name": "brute-force", "spot": "range"}, "storage": {"name": "fixed", "cap": 100}})"},
    {.name = "black-mesa",
     .engine = "Operation Black Mesa",
     .version = "not recorded",
     .evidence = Evidence::read,
     .source = "Operation Black Mesa's renderer, articles, part 4",
     .summary = "16 x 9 x 128 cells, sphere against box, an offset and a count into one list",
     .approximated =
         "lights are not cut by potentially visible sets before, and spots are the spheres around their cones",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [16, 9]},
                 "slices": {"scheme": "exponential", "count": 128}},
                 "assigner": {"name": "brute-force", "spot": "sphere"}, "storage": {"name": "packed"}})"},
    {.name = "doom-2016",
     .engine = "id Software, DOOM",
     .version = "2016",
     .evidence = Evidence::memory,
     .source = "The devil is in the details, SIGGRAPH 2016, from memory",
     .summary = "16 x 8 x 24 cells, exponential slices",
     .approximated =
         "boxes, packed lists, and the first 256 lights in view: which test, lists and lights it has is not in "
         "our sources",
     .unverified = "that lists are made on the CPU; the title of the source",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [16, 8]},
                 "slices": {"scheme": "exponential", "count": 24}},
                 "assigner": {"name": "aabb"}, "storage": {"name": "packed"},
                 "pre_cull": ["frustum", {"most": {"lights": 256}}]})"},
    {.name = "call-of-duty-iw",
     .engine = "Infinity Ward, Call of Duty: Infinite Warfare",
     .version = "2017",
     .evidence = Evidence::read,
     .source = "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH 2017",
     .summary = "8 px tiles with 256 bits, uniform depth bins with a range of lights each",
     .approximated = "64 bins in place of 8096, since the tool holds each cell against the truth, extents in place of "
                     "rasterised proxies, and the first 256 lights in view",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [8, 8]}, "slices": {"scheme": "linear", "count": 64}},
                 "assigner": {"name": "z-binning"}, "pre_cull": ["frustum", {"most": {"lights": 256}}]})"},
    {.name = "olsson-2012",
     .engine = "Olsson, Billeter and Assarsson",
     .version = "2012",
     .evidence = Evidence::read,
     .source = "Clustered Deferred and Forward Shading, HPG 2012",
     .summary = "near-cubical cells, as many slices as that takes, lists from a hierarchy of boxes",
     .approximated =
         "lists are of all cells, where it makes those of cells with pixels, tiles are of 64 px, whose size is not in "
         "our sources, and bounds are not explicit (see the method `explicit`)",
     .unverified = "that its hierarchy is one of boxes",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "cubical"}},
                 "assigner": {"name": "bvh"}, "storage": {"name": "packed"}})"},
};

}  // namespace

std::span<const Preset> published_presets() {
  return k_published;
}

}  // namespace clusterbench::config
