#pragma once
// A dump: a camera, a grid, lights and light lists of any program, as `clusterbench check` reads them. The JSON
// describes raw buffers that lie beside it.

#include "result/shared_parts.h"

namespace clusterbench::result {

using Size3 = std::array<std::int64_t, 3>;

// --- Buffers and the numbers in them ---

struct DumpBuffer {
  static constexpr const char* k_definition = "buffer";
  static About about() { return About("A file of raw bytes, or a part of it"); }
  RECORD(DumpBuffer);
  FIELD(std::string, file, "Relative to the folder of the dump");
  FIELD(std::optional<std::uint64_t>, at, "First byte in the file; absent: 0", "bytes");
  FIELD(std::optional<std::uint64_t>, bytes, "Of the buffer; absent: to the end of the file", "bytes");
  END_RECORD;
};

inline About number_type_about() {
  return About("Little-endian; u whole, f floating-point").one_of({"u8", "u16", "u32", "u64", "f16", "f32", "f64"});
}

struct DumpField {
  static constexpr const char* k_definition = "field";
  static About about() { return About("A number within a row of bytes"); }
  RECORD(DumpField);
  FIELD(std::uint64_t, at, "First byte within the row", "bytes");
  FIELD(std::string, type, number_type_about());
  FIELD(std::optional<Counts2>, bits,
        "[first, count]: only these bits of a whole number, counted from the lowest; absent: all");
  END_RECORD;
};

struct DumpRows {
  static constexpr const char* k_definition = "rows";
  static About about() { return About("Rows of bytes in a buffer"); }
  RECORD(DumpRows);
  FIELD(std::string, buffer, "Name of one of the buffers");
  FIELD(std::optional<std::uint64_t>, at, "First byte of row 0; absent: 0", "bytes");
  FIELD(std::uint64_t, stride, "From one row to the next", "bytes");
  END_RECORD;
};

// --- Camera ---

struct DumpCamera {
  static About about() {
    return About(
        "Of a scene (scene, camera, time_s), or numbers: world_to_view or view_to_world, and projection or sides");
  }
  RECORD(DumpCamera);
  FIELD(std::optional<std::string>, scene, "A glTF file, relative to the folder of the dump");
  FIELD(std::optional<std::string>, camera, "Name of a camera in the scene; absent: its first one");
  FIELD(std::optional<double>, time_s, About("Of the scene's animations; absent: 0", "s").finite());
  FIELD(std::optional<std::vector<double>>, world_to_view,
        About("4x4: from the world into view space").finite().items(16, 16));
  FIELD(std::optional<std::vector<double>>, view_to_world,
        About("In its place: the camera's own 4x4 matrix in the world").finite().items(16, 16));
  FIELD(std::optional<std::vector<double>>, projection,
        About("4x4: from view space into clip space, without reversed rows").finite().items(16, 16));
  FIELD(std::optional<std::string>, order,
        About("How the 16 numbers of a matrix M lie in memory, where p' = M p (M times a column). columns: one column "
              "after the other, so a translation is numbers 12 to 14 (OpenGL, three.js, Unity, Unreal and DirectX with "
              "p' = p M); rows: numbers 3, 7, 11; absent: columns")
            .one_of({"columns", "rows"}));
  FIELD(std::optional<std::string>, forward,
        About("Axis of view space along which the camera looks; absent: -z (OpenGL, three.js, Unity, Bevy, Godot); +z: "
              "DirectX, Unreal after its axes are swapped")
            .one_of({"-z", "+z"}));
  FIELD(std::optional<std::string>, depth,
        About("Clip depth of the near and the far plane in `projection`; absent: 0..1 (Vulkan, DirectX); -1..1: "
              "OpenGL; 1..0: reversed")
            .one_of({"0..1", "-1..1", "1..0"}));
  FIELD(std::optional<std::string>, clip_y,
        About("Where clip space has its positive y; absent: up").one_of({"up", "down"}));
  FIELD(
      std::optional<Sides>, sides,
      About("In place of `projection`: left, right, bottom, top of the picture at depth 1 (perspective), or in metres "
            "(orthographic)")
          .finite());
  FIELD(std::optional<bool>, orthographic, "With sides; absent: false");
  FIELD(std::optional<double>, near_m,
        About("Near plane; with sides, or instead of that of `projection`", "m").finite());
  FIELD(std::optional<Nullable<double>>, far_m, About("Far plane; null: none", "m").finite());
  END_RECORD;
};

// --- Grid ---

struct DumpTiles {
  RECORD(DumpTiles);
  FIELD(std::optional<Size2>, count, About("Tiles across and down, spread evenly").at_least(1).at_most(65536));
  FIELD(std::optional<Size2>, pixels,
        About("Width and height of a tile; those at the last edge are cut off", "pixels").at_least(1).at_most(65536));
  END_RECORD;
};

struct DumpFormula {
  RECORD(DumpFormula);
  FIELD(std::string, function,
        About("f of slice = floor(f(depth * depth_scale + depth_offset) * scale + bias)")
            .one_of({"log2", "ln", "linear"}));
  FIELD(double, scale, About("See function").finite().above(0));
  FIELD(double, bias, About("See function").finite());
  FIELD(std::optional<double>, depth_scale, About("See function; absent: 1").finite().above(0));
  FIELD(std::optional<double>, depth_offset, About("See function; absent: 0").finite());
  FIELD(std::optional<double>, far_m,
        About("Where the last slice ends; absent: where the formula gives the next one", "m").finite().above(0));
  END_RECORD;
};

struct DumpSlices {
  static About about() {
    return About(
        "By boundaries_m, scheme or formula: one of these; tiles without slices have count 1 alone, from the camera's "
        "near to its far");
  }
  RECORD(DumpSlices);
  FIELD(std::optional<std::vector<double>>, boundaries_m,
        About("Ends of all slices from near to far, one more than slices", "m").finite().items(2, 65536));
  FIELD(std::optional<std::string>, scheme,
        About("exponential-first: the first slice ends at first_m, the others grow by a factor")
            .one_of({"linear", "exponential", "exponential-first"}));
  FIELD(std::optional<std::int64_t>, count,
        About("Slices; with scheme or formula, or 1 alone").at_least(1).at_most(65535));
  FIELD(std::optional<double>, near_m, About("With scheme; absent: the camera's near", "m").finite());
  FIELD(std::optional<double>, first_m, About("With scheme exponential-first", "m").finite().above(0));
  FIELD(std::optional<double>, far_m, About("With scheme; absent: the camera's far", "m").finite().above(0));
  FIELD(std::optional<DumpFormula>, formula, "As in the shader");
  END_RECORD;
};

struct DumpBounds {
  RECORD(DumpBounds);
  FIELD(Vector, lo_m, "Lower corner in the world");
  FIELD(Vector, hi_m, "Upper corner in the world");
  END_RECORD;
};

struct DumpPlanes {
  static About about() { return About("Boundaries of a world grid's cells that are not evenly spaced"); }
  RECORD(DumpPlanes);
  FIELD(Vector, origin_m, "What the boundaries count from, in the world");
  FIELD(std::vector<double>, x_m, About("From the lowest to the highest", "m").finite().items(2, 65536));
  FIELD(std::vector<double>, y_m, About("The same", "m").finite().items(2, 65536));
  FIELD(std::vector<double>, z_m, About("The same", "m").finite().items(2, 65536));
  END_RECORD;
};

struct DumpGrid {
  RECORD(DumpGrid);
  FIELD(std::optional<std::string>, kind,
        About("frustum: tiles and slices of depth; distance: tiles and shells of distance; world: boxes along the "
              "world's axes; absent: frustum")
            .one_of({"frustum", "distance", "world"}));
  FIELD(std::optional<DumpTiles>, tiles, "By count or pixels; not of a world grid");
  FIELD(std::optional<DumpSlices>, slices, "Of grids of tiles, which need it; not of a world grid");
  FIELD(std::optional<Size3>, cells, About("Only of a world grid: cells along x, y and z").at_least(1).at_most(65535));
  FIELD(std::optional<DumpBounds>, bounds, "Only of a world grid");
  FIELD(std::optional<DumpPlanes>, planes, "Only of a world grid, in place of cells and bounds");
  FIELD(std::optional<std::string>, axes,
        About("Order of cells in memory, the fastest axis first: xyz is x + nx * (y + ny * z); x columns, y rows, z "
              "slices; absent: xyz")
            .one_of({"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"}));
  FIELD(std::optional<std::string>, first_row,
        About("Where row 0 is in the picture; absent: top. Tiles in pixels are counted from there")
            .one_of({"top", "bottom"}));
  FIELD(std::optional<std::string>, first_slice, About("Where slice 0 is; absent: near").one_of({"near", "far"}));
  END_RECORD;
};

// --- Lights ---

struct DumpLight {
  static constexpr const char* k_definition = "light";
  static About about() { return About("A light, a spot if it has a direction"); }
  RECORD(DumpLight);
  FIELD(Vector, position, About("", "m").finite());
  FIELD(double, range_m, About("", "m").finite().at_least(0));
  FIELD(std::optional<Vector>, direction, About("From the light").finite());
  FIELD(std::optional<double>, half_angle_deg,
        About("From the axis to the edge of the cone", "degrees").finite().at_least(0).at_most(90));
  END_RECORD;
};

struct DumpCone {
  RECORD(DumpCone);
  FIELD(std::uint64_t, at, "First byte within the light", "bytes");
  FIELD(std::string, type, number_type_about());
  FIELD(std::string, is,
        About("What the number says of the half-angle between axis and edge; scale-offset: two numbers, and light "
              "falls off "
              "with the cosine times scale plus offset (glTF, Filament)")
            .one_of({"radians", "degrees", "cosine", "cosine-squared", "sine", "tangent", "scale-offset"}));
  END_RECORD;
};

struct DumpRange {
  RECORD(DumpRange);
  FIELD(std::uint64_t, at, "First byte within the light", "bytes");
  FIELD(std::string, type, number_type_about());
  FIELD(std::optional<std::string>, is,
        About("What the number is; absent: range").one_of({"range", "squared", "inverse", "inverse-squared"}));
  END_RECORD;
};

struct DumpLightKind {
  RECORD(DumpLightKind);
  FIELD(std::uint64_t, at, "First byte within the light", "bytes");
  FIELD(std::string, type, number_type_about());
  FIELD(std::optional<Counts2>, bits, "As of a field");
  FIELD(std::uint64_t, spot, "The value of a spot; others are points");
  END_RECORD;
};

struct DumpLightRows {
  RECORD(DumpLightRows);
  FIELD(std::string, buffer, "Name of one of the buffers");
  FIELD(std::optional<std::uint64_t>, at, "First byte of light 0; absent: 0", "bytes");
  FIELD(std::uint64_t, stride, About("From one light to the next", "bytes").at_least(1));
  FIELD(std::uint64_t, count, "Of lights");
  FIELD(DumpField, position, "x, y, z, one after the other");
  FIELD(DumpRange, range, "Where a light ends");
  FIELD(std::optional<DumpLightKind>, kind, "Which of them are spots; absent: all if there is a cone, else none");
  FIELD(std::optional<DumpField>, direction, "x, y, z of spots");
  FIELD(std::optional<std::string>, direction_is, About("Absent: from-light").one_of({"from-light", "to-light"}));
  FIELD(std::optional<DumpCone>, cone, "Of spots");
  END_RECORD;
};

struct DumpLights {
  static About about() {
    return About("rows, listed or scene: one of these. Indices in lists count them in this order");
  }
  RECORD(DumpLights);
  FIELD(std::optional<std::string>, space,
        About("Of positions and directions; view: as `camera.forward` says; absent: world").one_of({"world", "view"}));
  FIELD(std::optional<std::vector<DumpLightRows>>, rows, "In buffers, one after the other");
  FIELD(std::optional<std::vector<DumpLight>>, listed, "In this file");
  FIELD(std::optional<bool>, scene, "True: those of the camera's scene, points before spots");
  END_RECORD;
};

// --- Lists ---

struct DumpEntries {
  RECORD(DumpEntries);
  FIELD(std::optional<std::string>, buffer,
        "Name of one of the buffers; absent: of `rows`, at a byte of the row (fixed)");
  FIELD(std::optional<std::uint64_t>, at, "First byte of entry 0; absent: 0", "bytes");
  FIELD(std::string, type, number_type_about());
  FIELD(std::optional<std::uint64_t>, stride,
        About("From one entry to the next; absent: the size of `type`", "bytes").at_least(1));
  FIELD(std::optional<std::uint64_t>, first_light, "The number that means light 0; absent: 0");
  FIELD(std::optional<std::uint64_t>, end, "The number that ends a list (fixed without counts)");
  END_RECORD;
};

struct DumpLightRanges {
  RECORD(DumpLightRanges);
  FIELD(std::string, buffer, "Name of one of the buffers");
  FIELD(std::optional<std::uint64_t>, at, "First byte of the range of slice 0 (of tile 0); absent: 0", "bytes");
  FIELD(std::uint64_t, stride, "From one slice to the next", "bytes");
  FIELD(std::optional<std::uint64_t>, tile_stride, "bits_and_slice_ranges: from one tile to the next", "bytes");
  FIELD(DumpField, first, "First light of the range");
  FIELD(DumpField, last, "Last light of the range");
  FIELD(std::optional<std::string>, last_is,
        About("last: belongs to the range, which is empty where last is below first; end: does not; absent: last")
            .one_of({"last", "end"}));
  FIELD(std::optional<std::uint64_t>, words_at,
        "bits_and_bins: first byte of bits of the slice's own lights, within its row; absent: none", "bytes");
  END_RECORD;
};

struct DumpNodes {
  RECORD(DumpNodes);
  FIELD(std::string, buffer, "Name of one of the buffers");
  FIELD(std::optional<std::uint64_t>, at, "First byte of node 0; absent: 0", "bytes");
  FIELD(std::uint64_t, stride, About("From one node to the next", "bytes").at_least(1));
  FIELD(DumpField, light, "The node's light");
  FIELD(DumpField, next, "The number of the next node");
  FIELD(std::optional<std::uint64_t>, end, "The number that ends a list; absent: all bits set");
  END_RECORD;
};

struct DumpLists {
  static constexpr const char* k_definition = "lists";
  static About about() {
    return About(
        "A part of the lists. packed: rows with offset and counts, and entries; fixed: per_cell entries for each cell; "
        "runs: as packed, entries are a first light and a number of further ones; bits: a bit per light in each cell, "
        "or "
        "in each tile; bits_and_bins: bits per tile, and a range of lights per slice; bits_and_slice_ranges: and a "
        "range per tile and slice; linked: rows with the first node, and nodes; inline: in this file");
  }
  RECORD(DumpLists);
  FIELD(std::optional<std::string>, set,
        "Parts with the same name are united and judged together, those of other sets apart; absent: 'lists'");
  FIELD(std::string, layout,
        About("See above")
            .one_of({"packed", "fixed", "runs", "bits", "bits_and_bins", "bits_and_slice_ranges", "linked", "inline"}));
  FIELD(std::optional<std::uint64_t>, first_light, "Of `lights`: what index 0 of this part means; absent: 0");
  FIELD(std::optional<std::uint64_t>, lights, "Number of lights that this part has; absent: all from first_light on");
  FIELD(
      std::optional<bool>, per_tile,
      "One row per tile, for all of its slices; absent: a row per cell (bits_and_bins and bits_and_slice_ranges always "
      "have tiles)");
  FIELD(std::optional<DumpRows>, rows, "One row per cell (per tile where lists are of tiles)");
  FIELD(std::optional<DumpField>, offset, "packed, runs: the first entry of a cell, in its row");
  FIELD(std::optional<std::string>, offset_is, About("Absent: entries").one_of({"entries", "bytes"}));
  FIELD(std::optional<std::vector<DumpField>>, counts,
        About("packed, runs, fixed: in the row; the length of the list is their sum").items(1, 16));
  FIELD(std::optional<DumpField>, end,
        "packed, runs: in place of counts, the entry behind the list's last; where it is the offset of the next cell, "
        "`at` is as many bytes behind that of `offset` as rows are apart, and there is one row more than cells");
  FIELD(std::optional<DumpEntries>, entries, "packed, fixed, runs");
  FIELD(std::optional<std::uint64_t>, per_cell, About("fixed: entries for each cell").at_least(1));
  FIELD(std::optional<std::string>, word,
        About("bits: of a word; light i is bit i % bits of word i / bits; absent: u32")
            .one_of({"u8", "u16", "u32", "u64"}));
  FIELD(std::optional<std::uint64_t>, first_bit,
        About("bits: the number of the bit that is the first light of this part; those before it and after its last "
              "light are of other things (decals, probes) and are passed over; absent: 0, and a bit after the last "
              "light is wrong"));
  FIELD(std::optional<DumpLightRanges>, ranges, "bits_and_bins, bits_and_slice_ranges");
  FIELD(std::optional<DumpField>, head, "linked: number of the first node, in the row");
  FIELD(std::optional<DumpNodes>, nodes, "linked");
  FIELD(std::optional<std::vector<std::vector<std::uint64_t>>>, cells,
        "inline: the lights of each cell, cells in their order");
  END_RECORD;
};

struct Dump {
  RECORD(Dump);
  FIELD(int, dump_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(std::optional<std::string>, name, "For reports; absent: the name of the file");
  FIELD(std::optional<std::string>, engine, "What made the lists, with its version");
  FIELD(Size2, viewport, About("Width and height of the picture", "pixels").at_least(1).at_most(65536));
  FIELD(std::optional<double>, metres_per_unit,
        About("Of all lengths in this dump and its buffers, also of fields in m, where the engine has another unit; "
              "reports are in metres; absent: 1",
              "m")
            .finite()
            .at_least(1e-9)
            .at_most(1e9));
  FIELD(std::optional<ByName<DumpBuffer>>, buffers, About("By name").each(""));
  FIELD(DumpCamera, camera, "Of the frame");
  FIELD(DumpGrid, grid, "What cells are");
  FIELD(DumpLights, lights, "That the engine was given");
  FIELD(std::vector<DumpLists>, lists, About("What the engine found").items(1, 64));
  FIELD(
      std::optional<double>, rounding,
      About("A light that reaches less far into a cell than this is lost to rounding: in units of 2^-24 of |x| + |y| + "
            "|z| + range in view space, at the most 0.1 m and 1 % of the range; absent: 32",
            "roundoffs")
          .finite()
          .at_least(0)
          .at_most(1048576));
  END_RECORD;
};

Json dump_schema();

extern template const Type& type_of<Dump>();

}  // namespace clusterbench::result
