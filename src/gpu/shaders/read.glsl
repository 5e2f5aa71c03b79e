// What all reading shaders share: arguments, samples, the lookup of a sample's cell, and what is done with each light.
//
// One invocation per sample. Each step of the lookup is `precise` and in the order of grid::lookup(), so that only log2,
// sqrt and divisions can differ from it (tests/gpu/reading_lookup_test.cpp).

#extension GL_EXT_control_flow_attributes : enable
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "rounding.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint MODE = 0;  // the bits of gpu/reading/reading_mode.h

const uint k_output = MODE & 7u;
const uint k_write_only = 0, k_nothing = 1, k_cells = 2, k_lights = 3, k_check = 4;
const uint k_walking = MODE >> 3 & 3u;
const uint k_by_lane = 0, k_by_light = 1, k_by_cell = 2;
const uint k_lookup = MODE >> 5 & 7u;
const uint k_given = 0, k_screen = 1, k_tile = 2, k_cascades = 3, k_world = 4, k_position = 5;
const uint k_slice_form = MODE >> 8 & 3u;
const uint k_linear = 0, k_log2 = 1, k_search = 2;
const bool k_by_distance = (MODE >> 10 & 1u) != 0;
const bool k_is_orthographic = (MODE >> 11 & 1u) != 0;
const uint k_index_shift = MODE >> 12 & 3u;                  // indices have 1 << so many bytes
const bool k_has_wide_counts = (MODE >> 14 & 1u) != 0;
const bool k_has_boxes = (MODE >> 15 & 1u) != 0;
const bool k_has_end_mark = (MODE >> 16 & 1u) != 0;
const bool k_is_sparse = (MODE >> 17 & 1u) != 0;
const bool k_has_bin_masks = (MODE >> 18 & 1u) != 0;
const bool k_has_range_per_cell = (MODE >> 19 & 1u) != 0;
const bool k_has_narrow_ranks = (MODE >> 20 & 1u) != 0;

// As gpu/reading/reading_mode.h.
layout(push_constant) uniform ReadingArguments {
  uint samples;
  uint columns, rows, slices;                          // of the grid; cascades: of each level
  float viewport_x, viewport_y, tile_scale_x, tile_scale_y;
  float slice_far, slice_scale, slice_bias, slice_first;
  float box_min_x, box_min_y, box_min_z, box_max_x, box_max_y, box_max_z, box_scale_x, box_scale_y, box_scale_z;
  float finest;
  uint levels;
  uint header_words, per_cell, end_mark;               // of the structure
} args;

layout(std430, set = 0, binding = 0) readonly buffer Positions { float positions[]; };  // x, y, z in the grid's space
layout(std430, set = 0, binding = 1) readonly buffer Pixels { vec2 pixels[]; };         // x == k_idle: no sample
layout(std430, set = 0, binding = 2) writeonly buffer Results { uint results[]; };
layout(std430, set = 0, binding = 3) readonly buffer Cells { int cells[]; };            // k_given
layout(std430, set = 0, binding = 4) readonly buffer Lights { vec4 lights[]; };         // centre, 1 / range^2
layout(std430, set = 0, binding = 9) readonly buffer Boundaries { float boundaries[]; };  // k_search

const float k_idle = -2.0;
const uint k_none = 0xffffffffu;

uint invocation_index() {
  return (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
}

vec3 position_of(uint index) {
  return vec3(positions[3 * index], positions[3 * index + 1], positions[3 * index + 2]);
}

// Where a sample looks for its lights. cell < 0: nowhere.
struct Place {
  int cell;
  uint tile, slice;
};
const Place k_outside = Place(-1, 0, 0);

Place place_of_cell(int cell) {
  uint tiles = args.columns * args.rows;
  return cell < 0 ? k_outside : Place(cell, uint(cell) % tiles, uint(cell) / tiles);
}

bool is_shown(vec2 pixel) {
  return pixel.x >= 0.0 && pixel.x <= args.viewport_x && pixel.y >= 0.0 && pixel.y <= args.viewport_y;
}

uint tile_of(vec2 pixel) {
  precise float x = pixel.x * args.tile_scale_x, y = pixel.y * args.tile_scale_y;
  return min(uint(y), args.rows - 1) * args.columns + min(uint(x), args.columns - 1);
}

uint slice_of(float along) {
  if (k_slice_form == k_search) {
    uint slice = 0, above = args.slices;
    while (above - slice > 1) {
      uint middle = (slice + above) / 2;
      if (boundaries[middle] <= along) slice = middle; else above = middle;
    }
    return slice;
  }
  precise float value = (k_slice_form == k_log2 ? log2(along) : along) * args.slice_scale + args.slice_bias;
  return along < args.slice_first || !(value >= 1.0) ? 0 : min(uint(value), args.slices - 1);
}

Place screen_place(vec2 pixel, vec3 at) {
  precise float squared = at.x * at.x + at.y * at.y + at.z * at.z;
  float along = k_by_distance ? sqrt(squared) : -at.z;
  if (!is_shown(pixel) || along > args.slice_far) return k_outside;
  uint tile = tile_of(pixel), slice = slice_of(along);
  return Place(int(slice * args.rows * args.columns + tile), tile, slice);
}

Place tile_place(vec2 pixel, vec3 at) {
  if (!is_shown(pixel) || !(k_is_orthographic || at.z < 0.0)) return k_outside;
  uint tile = tile_of(pixel);
  return Place(int(tile), tile, 0);
}

Place cascades_place(vec3 at) {
  precise float edge = args.finest, half_x = 0.5 * float(args.columns), half_y = 0.5 * float(args.rows);
  for (uint level = 0; level < args.levels; ++level, edge *= 2.0) {
    precise float x = at.x / edge + half_x, y = half_y - at.y / edge, z = -at.z / edge;
    if (x >= 0.0 && y >= 0.0 && z >= 0.0 && x < float(args.columns) && y < float(args.rows) && z < float(args.slices))
      return place_of_cell(int(((level * args.slices + uint(z)) * args.rows + uint(y)) * args.columns + uint(x)));
  }
  return k_outside;
}

Place world_place(vec3 at) {
  if (!(at.x >= args.box_min_x && at.x <= args.box_max_x && at.y >= args.box_min_y && at.y <= args.box_max_y &&
        at.z >= args.box_min_z && at.z <= args.box_max_z))
    return k_outside;
  precise float x = (at.x - args.box_min_x) * args.box_scale_x;
  precise float y = (at.y - args.box_min_y) * args.box_scale_y;
  precise float z = (at.z - args.box_min_z) * args.box_scale_z;
  uvec3 cell = min(uvec3(x, y, z), uvec3(args.columns, args.rows, args.slices) - 1);
  return place_of_cell(int((cell.z * args.rows + cell.y) * args.columns + cell.x));
}

Place place_of(uint index, vec3 at) {
  vec2 pixel = pixels[index];
  if (pixel.x == k_idle) return k_outside;
  if (k_lookup == k_given) return place_of_cell(cells[index]);
  if (k_lookup == k_screen) return screen_place(pixel, at);
  if (k_lookup == k_tile) return tile_place(pixel, at);
  if (k_lookup == k_cascades) return cascades_place(at);
  if (k_lookup == k_world) return world_place(at);
  return Place(0, 0, 0);
}

// Karis 2013: the inverse square of the distance, windowed by the light's range.
float light_at(uint light, vec3 at) {
  vec4 ball = lights[light];
  precise float x = ball.x - at.x, y = ball.y - at.y, z = ball.z - at.z;
  precise float squared = x * x + y * y + z * z;
  precise float share = squared * ball.w;
  precise float window = max(0.0, 1.0 - share * share);
  precise float lit = window * window / (squared + 1.0);
  return lit;
}

uint mixed(uint x) {
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

// What an invocation finds: its light; or, for a check, the number of its lights and a sum of their hashes.
vec3 sample_position;
float lit_sum = 0.0;
uint light_count = 0, hash_sum = 0;

void visit(uint light) {
  if (k_output == k_check) {
    ++light_count;
    hash_sum += mixed(light + 1);
  } else {
    precise float sum = lit_sum + light_at(light, sample_position);
    lit_sum = sum;
  }
}

void write_found(uint index) {
  if (k_output == k_check) {
    results[2 * index] = light_count;
    results[2 * index + 1] = hash_sum;
  } else {
    results[index] = floatBitsToUint(lit_sum);
  }
}
