#include "report/shader_code/lookup_code.h"

#include <algorithm>

namespace clusterbench::report {
namespace {

// All code is GLSL first, with P for the name.
constexpr const char* k_slice_by_formula = R"(  float at = @ * P_slice_scale + P_slice_bias;
  int slice = along < P_slice_first || !(at >= 1.0) ? 0 : min(int(at), P_cells.z - 1);
)";

constexpr const char* k_slice_by_search = R"(  int slice = 0, above = P_cells.z;
  while (above - slice > 1) {
    int middle = (slice + above) / 2;
    if (P_slice_boundaries[middle] <= along) slice = middle; else above = middle;
  }
)";

constexpr const char* k_screen_start = R"(int P_cell_of(vec2 pixel, float along) {
  if (!(pixel.x >= 0.0 && pixel.x <= P_viewport.x && pixel.y >= 0.0 && pixel.y <= P_viewport.y)) return -1;
  if (along > P_slice_far) return -1;
)";
constexpr const char* k_screen_end =
    R"(  ivec2 tile = clamp(ivec2(pixel * P_tile_scale), ivec2(0, 0), ivec2(P_cells.x - 1, P_cells.y - 1));
  return (slice * P_cells.y + tile.y) * P_cells.x + tile.x;
}
)";

constexpr const char* k_cascades = R"(// view: the sample in view space, in metres
int P_cell_of(vec3 view) {
  ivec3 size = ivec3(P_cells.x, P_cells.y, P_cells.z / P_levels);
  float edge = P_finest;
  for (int level = 0; level < P_levels; ++level) {
    vec3 at = vec3(view.x / edge + 0.5 * float(size.x), 0.5 * float(size.y) - view.y / edge, -view.z / edge);
    if (at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < float(size.x) && at.y < float(size.y) && at.z < float(size.z)) {
      ivec3 cell = ivec3(at);
      return ((level * size.z + cell.z) * size.y + cell.y) * size.x + cell.x;
    }
    edge *= 2.0;
  }
  return -1;
}
)";

constexpr const char* k_world =
    R"(// from_origin: the sample in the world minus P_origin, subtracted before it is rounded to float
int P_cell_of(vec3 from_origin) {
  if (!(from_origin.x >= P_box_min.x && from_origin.x <= P_box_max.x && from_origin.y >= P_box_min.y &&
        from_origin.y <= P_box_max.y && from_origin.z >= P_box_min.z && from_origin.z <= P_box_max.z)) return -1;
  vec3 at = (from_origin - P_box_min) * (vec3(P_cells) / (P_box_max - P_box_min));
  ivec3 cell = clamp(ivec3(at), ivec3(0, 0, 0), ivec3(P_cells.x - 1, P_cells.y - 1, P_cells.z - 1));
  return (cell.z * P_cells.y + cell.y) * P_cells.x + cell.x;
}
)";

// For a viewport that changes from frame to frame: then the number of tiles with a size in pixels changes, or the size
// of a given number of tiles.
constexpr const char* k_screen_start_of_viewport = R"(int P_cell_of(vec2 pixel, float along, vec2 viewport) {
  if (!(pixel.x >= 0.0 && pixel.x <= viewport.x && pixel.y >= 0.0 && pixel.y <= viewport.y)) return -1;
  if (along > P_slice_far) return -1;
)";
constexpr const char* k_screen_end_of_viewport =
    R"(  ivec2 tiles = P_tiles_of(viewport), tile = clamp(ivec2(pixel * #), ivec2(0, 0), tiles - 1);
  return (slice * tiles.y + tile.y) * tiles.x + tile.x;
}
)";

std::string ivec2_of(const result::Counts2& pair) {
  return "ivec2(" + std::to_string(pair[0]) + ", " + std::to_string(pair[1]) + ")";
}

// Tiles across and down in a viewport, and the cell in it.
std::string code_of_viewport(const result::Tiles& tiles, const std::string& slice) {
  const std::string count = tiles.pixels
                                ? "(ivec2(viewport) + " + ivec2_of(*tiles.pixels) + " - 1) / " + ivec2_of(*tiles.pixels)
                                : "ivec2(P_cells.x, P_cells.y)";
  std::string end = k_screen_end_of_viewport;
  const std::string scale = tiles.pixels ? "P_tile_scale" : "(vec2(ivec2(P_cells.x, P_cells.y)) / viewport)";
  end.replace(end.find('#'), 1, scale);
  return "// the same for any viewport, in whole pixels: for dynamic resolution\nivec2 P_tiles_of(vec2 viewport) {\n  "
         "return " +
         count + ";\n}\n" + k_screen_start_of_viewport + slice + end;
}

// Cubical cells are as deep as wide on the screen, and so depend on the viewport.
bool are_slices_of_viewport(const result::Slices& slices) {
  return slices.scheme.starts_with("cubical");
}

std::string screen_code(const result::Grid& grid) {
  const std::string& form = grid.slices->lookup.form;
  const bool by_distance = grid.kind == "distance";
  std::string slice = form == "search" ? k_slice_by_search : k_slice_by_formula;
  if (const std::size_t at = slice.find('@'); at != std::string::npos)
    slice.replace(at, 1, form == "log2" ? "log2(along)" : "along");
  return std::string("// pixel: from the top left (OpenGL's gl_FragCoord: from the bottom), centres at .5; along: ") +
         (by_distance ? "length(view)" : "depth, -view.z") +
         ", in metres. -1: beside the picture, beyond the last slice\n" + k_screen_start + slice + k_screen_end +
         (are_slices_of_viewport(*grid.slices) ? "" : code_of_viewport(*grid.tiles, slice));
}

bool has(const std::vector<LookupConstant>& constants, const char* name) {
  return std::ranges::find(constants, name, &LookupConstant::name) != constants.end();
}

std::string code_of(const result::Case& result_case) {
  const result::Grid& grid = result_case.grid;
  const std::vector<LookupConstant> constants = lookup_constants(result_case);
  if (has(constants, "levels") && has(constants, "finest")) return k_cascades;
  if (has(constants, "origin") && has(constants, "box_min")) return k_world;
  if (!has(constants, "tile_scale") || !has(constants, "viewport") || !has(constants, "slice_far")) return "";
  const bool searches = grid.slices->lookup.form == "search";
  if (searches ? grid.slices->boundaries.size() == grid.cells[2] + 1 && has(constants, "slice_boundaries")
               : has(constants, "slice_scale") && has(constants, "slice_bias"))
    return screen_code(grid);
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

std::string lookup_function_glsl(const std::string& name, const result::Case& result_case) {
  return replaced(code_of(result_case), "P_", name + "_");
}

std::string lookup_function_hlsl(const std::string& name, const result::Case& result_case) {
  const std::string code = replaced(code_of(result_case), "ivec", "int");
  return replaced(replaced(code, "vec", "float"), "P_", name + "_");
}

}  // namespace clusterbench::report
