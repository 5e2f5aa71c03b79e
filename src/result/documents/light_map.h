#pragma once
// Light maps: the output of `clusterbench light-map`.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct AskedLightMaps {
  RECORD(AskedLightMaps);
  FIELD(double, texels_per_metre,
        About("On the average over a mesh; null: a resolution was given").above(0).as_fraction());
  FIELD(Nullable<Size2>, resolution,
        About("Width and height of every map; null: by texels_per_metre").at_least(1).at_most(16384));
  FIELD(std::string, uvs, About("Texture coordinates of the file, or by --unwrap").one_of({"file", "made"}));
  FIELD(std::string, coverage,
        About("A triangle covers texels by their centres, or all that it touches").one_of({"centres", "conservative"}));
  FIELD(bool, facing, "Lights behind a surface were left out");
  FIELD(bool, visibility, "Hidden lights were left out");
  FIELD(double, lamp_radius_m,
        About("What is so near to a light does not hide it", "m").finite().at_least(0).as_fraction());
  FIELD(std::uint64_t, tile, About("Texels along a side of a tile").at_least(1));
  END_RECORD;
};

struct LightMapRangeRule {
  RECORD(LightMapRangeRule);
  FIELD(double, cutoff_lux, About("Illuminance at which they end", "lux").finite().at_least(0).as_fraction());
  FIELD(double, max_range_m, About("Longest range", "m").finite().at_least(0).as_fraction());
  END_RECORD;
};

struct LightMapLights {
  RECORD(LightMapLights);
  FIELD(std::uint64_t, point, "Point lights that have a bit");
  FIELD(std::uint64_t, spot, "Spot lights that have a bit");
  FIELD(std::uint64_t, moving, "Point and spot lights that an animation moves: they have none");
  FIELD(std::uint64_t, directional, "They have none");
  END_RECORD;
};

struct MapTriangles {
  RECORD(MapTriangles);
  FIELD(std::uint64_t, all, "All of them");
  FIELD(std::uint64_t, wrapped, "With a corner outside of texture coordinates 0..1: they repeat");
  FIELD(std::uint64_t, degenerate,
        "Without area once their texture coordinates are snapped to 1/256 texel: in no texel");
  FIELD(std::uint64_t, in_no_texel, "With an area, and without the centre of a texel: too small");
  END_RECORD;
};

struct MapTexels {
  RECORD(MapTexels);
  FIELD(std::uint64_t, all, "Width times height");
  FIELD(std::uint64_t, covered, "In which a triangle lies");
  FIELD(std::uint64_t, dead, "In which none lies");
  FIELD(std::uint64_t, overlapping,
        "Whose centre lies in several triangles, or in a triangle several times: several places share them");
  FIELD(std::uint64_t, lit, "Covered ones that a light reaches");
  END_RECORD;
};

struct LeftAfterTests {
  RECORD(LeftAfterTests);
  FIELD(Nullable<std::uint64_t>, range, "The texel's place is in the light's range");
  FIELD(Nullable<std::uint64_t>, cone, "And in a spot's cone");
  FIELD(Nullable<std::uint64_t>, facing, "And the light is in front of the surface");
  FIELD(Nullable<std::uint64_t>, visibility, "And nothing opaque stands between");
  END_RECORD;
};

struct TexelHistogram {
  RECORD(TexelHistogram);
  FIELD(std::uint64_t, lights_per_entry, About("Numbers of lights that an entry stands for").at_least(1));
  FIELD(std::vector<std::uint64_t>, texels,
        "Entry n: covered texels with n times lights_per_entry lights or up to as many more");
  END_RECORD;
};

struct LightsPerTexel {
  RECORD(LightsPerTexel);
  FIELD(double, mean, About("Mean").finite().at_least(0).as_fraction());
  FIELD(std::uint64_t, p50, "Median");
  FIELD(std::uint64_t, p95, "95th percentile, nearest rank");
  FIELD(std::uint64_t, p99, "99th percentile");
  FIELD(std::uint64_t, max, "Most");
  FIELD(TexelHistogram, histogram, "Covered texels by their lights");
  END_RECORD;
};

struct MapTiles {
  RECORD(MapTiles);
  FIELD(std::uint64_t, covered, "Tiles with a covered texel");
  FIELD(std::uint64_t, bits_set, "Lights of the unions");
  FIELD(std::uint64_t, false_positives,
        "Lights of the unions that a covered texel in the tile does not have, over all covered texels");
  FIELD(double, excess_ratio,
        About("False positives / bits_set of texels; null: no bit is set", "ratio").at_least(0).as_fraction());
  END_RECORD;
};

struct MapBytes {
  RECORD(MapBytes);
  FIELD(std::uint64_t, bit_field, "A bit per texel and light of the scene, in whole 32-bit words", "bytes");
  FIELD(std::uint64_t, bit_field_of_own_lights, "The same of the lights that reach the map at all", "bytes");
  FIELD(Nullable<std::uint64_t>, lists_8,
        "32 bits per texel that say where its list begins, and 8 bits per pair; null: a map has more than 256 own "
        "lights",
        "bytes");
  FIELD(Nullable<std::uint64_t>, lists_16, "The same with 16 bits per pair; null: more than 65,536 own lights",
        "bytes");
  FIELD(std::uint64_t, palette,
        "8, 16 or 32 bits per texel that say which distinct set it has, and a bit field of own lights per set",
        "bytes");
  FIELD(std::uint64_t, tile_bit_fields, "A bit field of own lights per tile", "bytes");
  END_RECORD;
};

// Of one map, or of all.
struct LightMapFigures {
  RECORD(LightMapFigures);
  FIELD(MapTriangles, triangles, "Triangles of the meshes");
  FIELD(MapTexels, texels, "Texels of the maps");
  FIELD(double, dead_share, About("Dead texels of all", "share of 1").finite().at_least(0).at_most(1).as_fraction());
  FIELD(double, overlapping_share,
        About("Overlapping texels of the covered ones", "share of 1").finite().at_least(0).at_most(1).as_fraction());
  FIELD(double, occupied_fraction,
        About("Lit texels of the covered ones", "share of 1").finite().at_least(0).at_most(1).as_fraction());
  FIELD(std::uint64_t, bits_set, "Pairs of a texel and a light that reaches it");
  FIELD(LeftAfterTests, left_after,
        "Pairs that are left after each test, in this order; null: the test was not asked for");
  FIELD(LightsPerTexel, lights_per_texel, "Over covered texels");
  FIELD(std::uint64_t, distinct_sets,
        "Distinct sets of lights of a map's texels, the empty one among them; of all maps: their sum");
  FIELD(MapTiles, tiles, "Blocks of request.tile squared texels that share the union of their sets");
  FIELD(MapBytes, bytes, "What the sets take");
  END_RECORD;
};

struct LightMap : LightMapFigures {
  static About about() { return About("One map"); }
  using Rest = LightMapFigures;
  RECORD(LightMap);
  FIELD(std::string, mesh, "Name of the node");
  FIELD(Nullable<std::uint64_t>, uv_set, "n of the TEXCOORD_n that was read; null: made by --unwrap");
  FIELD(std::uint64_t, width, About("Texels along u").at_least(1));
  FIELD(std::uint64_t, height, About("Texels along v").at_least(1));
  FIELD(double, area_m2, About("Of its triangles in the world", "m2").finite().at_least(0).as_fraction());
  FIELD(std::uint64_t, own_lights, "Lights that reach a texel of it");
  END_RECORD;
};

struct MeshWithoutMap {
  static About about() { return About("A mesh, or a part of it, without map"); }
  RECORD(MeshWithoutMap);
  FIELD(std::string, mesh, "Name of the node");
  FIELD(std::string, reason, "Why");
  END_RECORD;
};

struct LightMapScene {
  static About about() { return About("One scene"); }
  RECORD(LightMapScene);
  FIELD(std::string, name, "Of the file");
  FIELD(std::string, sha256, "Of the scene's file");
  FIELD(std::string, geometry_sha256, "Of what was read of its meshes");
  FIELD(LightMapRangeRule, range_rule, "How lights without range got one");
  FIELD(LightMapLights, lights, "Of the scene");
  FIELD(std::vector<LightMap>, maps, "One per mesh that stands still, in the order of nodes");
  FIELD(LightMapFigures, all, "Sums over all maps");
  FIELD(std::vector<MeshWithoutMap>, left_out, "What has no map");
  FIELD(std::vector<std::string>, warnings, "Of loading the scene");
  FIELD(double, seconds,
        About("Wall time from triangles to sets and their sizes; the one figure that differs from run to run", "s")
            .finite()
            .at_least(0)
            .as_fraction());
  END_RECORD;
};

struct LightMaps {
  RECORD(LightMaps);
  FIELD(int, light_map_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(AskedLightMaps, request, "What was asked for");
  FIELD(std::vector<LightMapScene>, scenes, "In the order of the command line");
  END_RECORD;
};

Json light_map_schema();

extern template const Type& type_of<LightMaps>();

}  // namespace clusterbench::result
