// Clusterings of engines whose code or documentation is public.

#include "config/preset_tables.h"

namespace clusterbench::config {
namespace {

constexpr Preset k_engines[] = {
    {.name = "filament",
     .engine = "Filament",
     .version = "snapshot of 2026",
     .evidence = Evidence::ran,
     .source = "google/filament, Froxelizer.cpp",
     .summary = "at most 8192 square froxels in 16 slices, the first to 5 m, far at 100 m or the camera's; sphere "
                "refinement by "
                "one plane per column, equal lists shared; all lights for the froxels beyond 64 K records",
     .approximated =
         "cones end with their range, where its are endless; rows count from the top, where its count from the bottom; "
         "there is room for 65534 records, where a device with small uniform buffers has less; a froxel may have 256 "
         "lights, where its count ends at 255",
     .unverified = "which of more than 256 lights it keeps behind the eye",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "frustum", "slices":
                 {"scheme": "exponential-first", "count": 16, "first": 5, "far_at_most": 100}},
                 "assigner": {"name": "sphere-refinement", "spot": "cone-sphere", "columns": "nearest"},
                 "storage": {"name": "packed", "equal_lists": "shared", "max_entries": 65534},
                 "pre_cull": ["frustum", {"most": {"lights": 256, "keep": "shallowest"}}]})",
     .mistakes = "the row and the column of a centre behind the eye are mirrored; an orthographic view is cut by the "
                 "planes of a perspective; nothing is padded",
     .as_shipped = R"({"assigner": {"name": "filament-refinement"}})",
     .tiles = filament_tiles},
    {.name = "bevy",
     .engine = "Bevy, clustering on the CPU (where its default, bevy-gpu, cannot run)",
     .version = "0.20-dev of August 2026",
     .evidence = Evidence::ran,
     .source =
         "bevyengine/bevy, ClusterConfig::default() and bevy_light/src/cluster/assign.rs; the fallback where the GPU "
         "does not cluster",
     .summary = "at most 4096 clusters spread evenly over the viewport in 24 slices, the first to 5 m, far at the "
                "farthest end of "
                "a light's range, linear slices in orthographic views; sphere refinement by one plane per column; "
                "after a frame "
                "of more than 16384 entries fewer columns and rows",
     .approximated =
         "far is that of the frame's own lights, where it has that of the frame before; cones are held against the "
         "sphere "
         "around a cell, where it takes the one around the cell's box",
     .unverified = "",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "frustum", "slices":
                 {"scheme": "exponential-first", "count": 24, "first": 5, "orthographic": "linear", "fit": {"to": "ranges"}},
                 "react": {"to": "entries", "most": 16384, "of": "sphere-refinement"}},
                 "assigner": {"name": "sphere-refinement", "spot": "cone-sphere", "columns": "nearest"},
                 "storage": {"name": "packed", "index_bits": "32", "header_size": 32}})",
     .remark = "the fallback on the CPU, whose lists are uploaded; the default since 0.19 is bevy-gpu",
     .mistakes = "the row of a light's centre is taken once and not again in each slice; nothing is padded",
     .as_shipped = R"({"grid": {"react": {"of": "bevy-refinement"}}, "assigner": {"name": "bevy-refinement"}})",
     .tiles = bevy_tiles},
    {.name = "bevy-gpu",
     .engine = "Bevy, clustering on the GPU",
     .version = "0.20-dev of August 2026",
     .evidence = Evidence::ran,
     .source = "bevyengine/bevy, bevy_pbr/src/cluster (cluster_raster, cluster_allocate); the default since 0.19",
     .summary =
         "the clusters of `bevy`; per slice, inside the light's rectangle, sphere against the cell's box, and cones "
         "against the sphere around that box; after a frame of more than 16384 entries fewer columns and rows",
     .approximated = "far is that of the frame's own lights; cones are held against the sphere around a cell; it knows "
                     "the entries of a frame one frame later, where what a GPU counts can take longer",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "slices":
                 {"scheme": "exponential-first", "count": 24, "first": 5, "orthographic": "linear", "fit": {"to": "ranges"}},
                 "react": {"to": "entries", "most": 16384, "of": "aabb"}},
                 "assigner": {"name": "aabb", "spot": "cone-sphere"},
                 "storage": {"name": "packed", "index_bits": "32", "header_size": 32}})",
     .tiles = bevy_tiles},
    {.name = "godot",
     .engine = "Godot 4",
     .version = "4, release not recorded",
     .evidence = Evidence::read,
     .source = "godotengine/godot, cluster_builder_rd and light_storage",
     .summary = "32 px tiles with 32 linear parts of the depth from 0 to the camera's far (4000 m by default), bits "
                "per tile, 512 points and "
                "512 spots",
     .approximated = "a sphere's and a cone's extents in place of meshes that are rasterised at a quarter of the "
                     "resolution and are "
                     "inflated; which 512 it takes follows its own order of the lights, here it is that of the scene",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [32, 32]},
                 "slices": {"scheme": "linear", "count": 32, "near": 1e-6, "far_default": 4000}},
                 "assigner": {"name": "tile-ranges"},
                 "pre_cull": ["frustum", {"most": {"lights": 512, "per": "type"}}]})"},
    {.name = "three-js",
     .engine = "three.js",
     .version = "r187",
     .evidence = Evidence::ran,
     .source = "mrdoob/three.js, ClusteredLightsNode",
     .summary = "32 px tiles, 24 exponential slices to the camera's far (2000 m by default), every light against every "
                "cell's box, 64 lights in each; spots by the "
                "smallest sphere around them, which up to r186 are not clustered at all",
     .approximated =
         "tiles end at whole 32 px; of more than 64 lights in a cell the first of the file are kept, the engine keeps "
         "the "
         "farthest (`--as-shipped`), so which light is lost depends on their order; which of more than 1024 lights it "
         "keeps is not known",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [32, 32]},
                 "slices": {"scheme": "exponential", "count": 24, "far_default": 2000}},
                 "assigner": {"name": "brute-force", "spot": "sphere"}, "storage": {"name": "fixed", "cap": 64},
                 "pre_cull": [{"most": {"lights": 1024}}]})",
     .mistakes =
         "tiles are spread evenly over the viewport and looked up every 32 px; a full cell keeps the 64 farthest "
         "lights; cells of an orthographic view are those of a perspective; nothing is padded",
     .as_shipped = R"({"assigner": {"name": "three-js-boxes"}})"},
    {.name = "playcanvas",
     .engine = "PlayCanvas",
     .version = "2.23",
     .evidence = Evidence::ran,
     .source = "playcanvas/engine, WorldClusters and LightingParams",
     .summary = "10 x 3 x 10 cells of the box around the lights in view, 255 lights in each, 8-bit indices",
     .approximated = "a spot's box is a little smaller than there",
     .unverified = "",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "world", "cells": [10, 3, 10], "follow": "lights"},
                 "assigner": {"name": "light-boxes"}, "storage": {"name": "fixed", "cap": 255, "counts": "none"},
                 "pre_cull": ["frustum", {"most": {"lights": 255}}]})"},
    {.name = "babylon",
     .engine = "Babylon.js",
     .version = "9.35",
     .evidence = Evidence::ran,
     .source = "BabylonJS/Babylon.js, clusteredLightContainer and lightProxy",
     .summary =
         "64 x 64 tiles with bit masks, 16 logarithmic slices with a range of lights in one order by depth; spots as "
         "the spheres of their ranges",
     .approximated = "tiles are those of the box around a sphere's outline, padded for rounding",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [64, 64]},
                 "slices": {"scheme": "exponential", "count": 16, "far_default": 10000}}, "assigner": {"name": "babylon-masks"}})",
     .mistakes =
         "a light whose far tangent lies behind the eye can lose all its tiles; an orthographic view is cut by the "
         "tangents of a perspective; nothing is padded",
     .as_shipped = R"({"assigner": {"name": "babylon-as-shipped"}})"},
    {.name = "unity-urp",
     .engine = "Unity URP, Forward+",
     .version = "Graphics, main of 2026",
     .evidence = Evidence::read,
     .source = "Unity-Technologies/Graphics, ForwardLights.cs and its tiling jobs",
     .summary =
         "tiles of 8 px and more with bit masks that fit into 16384 words for the lights in view, 409 logarithmic "
         "depth bins with masks of their own, linear ones in orthographic views",
     .approximated = "bins are those of 225 to 256 lights, whatever their number (4096 words, each bin 2 and its "
                     "masks); reflection "
                     "probes, which take bits, too, are none; the first 256 lights in view are kept, whose order there "
                     "is Unity's own",
     .unverified = "",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [8, 8]},
                 "slices": {"scheme": "exponential", "count": 409, "orthographic": "linear", "far_default": 1000},
                 "react": {"to": "mask-words", "most": 16384, "most_lights": 256}},
                 "assigner": {"name": "tile-spans", "bins": "masks"},
                 "pre_cull": ["frustum", {"most": {"lights": 256}}]})"},
    {.name = "unity-hdrp",
     .engine = "Unity HDRP, clusters (transparent surfaces)",
     .version = "not recorded",
     .evidence = Evidence::read,
     .source = "Unity-Technologies/Graphics, lightlistbuild-clustered.compute",
     .summary = "32 px tiles with 64 geometric slices of their own, half of them before the farthest pixel",
     .approximated =
         "extents and boxes in place of screen box, sphere and hull in turn; neither coarse lists (128) nor those of a "
         "cell (63) are limited; the first 512 lights in view are kept, whose order there is Unity's own",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [32, 32]},
                 "slices": {"scheme": "exponential", "count": 64, "far_default": 1000}},
                 "assigner": {"name": "tile-slices", "least_growth": 1.02},
                 "pre_cull": ["frustum", {"most": {"lights": 512}}]})"},
    {.name = "unity-hdrp-fptl",
     .engine = "Unity HDRP, fine pruned tiles (opaque surfaces)",
     .version = "commit 0148835e",
     .evidence = Evidence::read,
     .source = "Unity-Technologies/Graphics, lightlistbuild.compute",
     .summary = "16 px tiles between the depths of their pixels",
     .approximated =
         "planes and boxes in place of screen box, sphere and then each light against each pixel's surface, which "
         "lists "
         "fewer; neither coarse lists (64) nor those of a tile (63) are limited; the first 512 lights in view are kept",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts =
         R"({"grid": {"kind": "frustum", "tiles": {"pixels": [16, 16]}, "slices":
                 {"scheme": "linear", "count": 1, "far_default": 1000}},
                 "assigner": {"name": "tiled", "test": "both"},
                 "pre_cull": ["frustum", {"most": {"lights": 512}}]})"},
    {.name = "wicked",
     .engine = "Wicked Engine",
     .version = "0.72 of 2026",
     .evidence = Evidence::read,
     .source = "turanszkij/WickedEngine, lightCullingCS",
     .summary = "32 px tiles between the depths of their pixels with a 32-bit mask of depth (2.5D)",
     .approximated = "lists per tile where it has bit fields; 32 parts of a tile's depth where it has 31 and one at "
                     "the end; spots by "
                     "the smallest sphere around them where it has a larger one; its second list, from the near plane "
                     "on, for transparent "
                     "surfaces is left out, and so are decals and probes, which count towards its 256",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts =
         R"({"grid": {"kind": "frustum", "tiles": {"pixels": [32, 32]}, "slices":
                 {"scheme": "linear", "count": 1, "far_default": 5000}},
                 "assigner": {"name": "tiled-2.5d", "test": "both", "spot": "sphere"},
                 "pre_cull": ["frustum", {"most": {"lights": 256}}]})"},
    {.name = "unreal",
     .engine = "Unreal Engine",
     .version = "not recorded",
     .evidence = Evidence::memory,
     .source = "documentation of the light grid; its code was not read",
     .summary = "64 px tiles, 32 slices that end with the farthest light in view, boxes and cones, a linked list with "
                "room for 32 lights per cell",
     .approximated =
         "a blend of linear and exponential slices in place of log2(z B + O) 4.05, whose boundaries differ by up to 2 "
         "times; spots end with the spheres of their ranges; newer versions cull by a hierarchy of depths and a parent "
         "grid, which are not here",
     .unverified = "which test it has for cones; that slices end with the lights, whatever the camera's far plane",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [64, 64]},
                 "slices": {"scheme": "power", "count": 32, "lambda": 0.92, "fit": {"to": "ranges"}}},
                 "assigner": {"name": "brute-force", "spot": "both"},
                 "storage": {"name": "linked", "nodes_per_cell": 32}})"},
    {.name = "ogre-next",
     .engine = "OGRE-Next, Forward Clustered",
     .version = "commit 02b4345b",
     .evidence = Evidence::read,
     .source =
         "OGRECave/ogre-next, OgreForwardClustered.cpp, with the numbers of its samples (16, 8, 24, 96, from 5 to 500 "
         "m)",
     .summary =
         "16 x 8 x 24 cells, slices of 1.295^k + 5 m, six planes and the box of a cell against a sphere, 96 lights in "
         "each, 16-bit indices",
     .approximated =
         "the box and the smallest sphere or cone in place of planes, box and a pyramid around the cone; its "
         "boxes are along "
         "the world's axes; the last slice ends at 10 km, where its ends with the camera's far plane",
     .unverified = "",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"count": [16, 8]}, "slices": {"scheme": "list", "boundaries":
                 [0.1, 6.295, 6.677, 7.172, 7.813, 8.642, 9.717, 11.108, 12.91, 15.244, 18.266, 22.18, 27.249, 33.812,
                  42.312, 53.32, 67.575, 86.036, 109.943, 140.903, 180.997, 232.918, 300.158, 387.235, 10000]}},
                 "assigner": {"name": "aabb", "spot": "both"}, "storage": {"name": "fixed", "cap": 96}})"},
    {.name = "stride",
     .engine = "Stride, clustered points and spots",
     .version = "commit 19687250",
     .evidence = Evidence::read,
     .source = "stride3d/stride, LightClusteredPointSpotGroupRenderer.cs",
     .summary = "64 px tiles, 8 slices of which the first ends at 2 m and each later one, from the third on, is twice "
                "as deep as the one before; the box of cells "
                "around a sphere, spots by those of their ranges; equal lists shared",
     .approximated =
         "slices are those of a camera with its default far plane of 1000 m, whatever the camera's; equal lists "
         "are shared between neighbours, where it shares them between all cells",
     .unverified = "",
     .assigns_on = AssignsOn::cpu,
     .parts = R"({"grid": {"kind": "frustum", "tiles": {"pixels": [64, 64]}, "slices": {"scheme": "list", "boundaries":
                 [0.1, 2, 9.858, 25.575, 57.008, 119.874, 245.606, 497.071, 1000]}},
                 "assigner": {"name": "bounds", "spot": "range"},
                 "storage": {"name": "packed", "index_bits": "32", "equal_lists": "shared"}})"},
    {.name = "eevee",
     .engine = "Blender EEVEE",
     .version = "commit 139f3201",
     .evidence = Evidence::read,
     .source = "blender/blender, eevee_light_culling_tile_comp.glsl and eevee_light.cc",
     .summary = "tiles of 32 px and more, at most 8192, with a bit per light in view, linear depth bins with a range "
                "of lights "
                "each",
     .approximated =
         "64 bins in place of 4096, since the tool holds each cell against the truth; extents of spheres in place of "
         "a tile's cone and frustum against a sphere or a pyramid",
     .unverified = "",
     .assigns_on = AssignsOn::gpu,
     .parts = R"({"grid": {"kind": "frustum", "slices": {"scheme": "linear", "count": 64}},
                 "assigner": {"name": "z-binning"}})",
     .tiles = eevee_tiles},
};

}  // namespace

std::span<const Preset> engine_presets() {
  return k_engines;
}

}  // namespace clusterbench::config
