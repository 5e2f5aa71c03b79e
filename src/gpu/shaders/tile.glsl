// Of the methods that take a tile of the picture as a cell, between the least and the greatest depth of its pixels.
// frame.cells is the number of tiles.
//
// Ranges, masks of depth and boxes are those of the processor (assign/occupied), bit for bit; on a device that may round
// either way, masks have some more parts.

#include "around.glsl"

layout(std430, set = 0, binding = 11) readonly buffer Depths { uint depths[]; };       // bits of floats, by pixel
layout(std430, set = 0, binding = 12) readonly buffer TileSides { uvec4 sides[]; };    // of columns, then of rows
layout(std430, set = 0, binding = 13) buffer Tiles { uvec4 tiles[]; };

// The tiles with a surface, in any order, and the groups of an indirect dispatch with one for each of them, in rows as
// Commands::dispatch() makes them. It begins with zeros.
layout(std430, set = 0, binding = 10) buffer TileQueue {
  uint groups_x, groups_y, groups_z, count;
  uint tiles[];
} queue;
const uint k_groups_in_a_row = 32768;

void append_to_queue(uint tile) {
  uint place = atomicAdd(queue.count, 1);
  queue.tiles[place] = tile;
  atomicMax(queue.groups_x, min(place + 1, k_groups_in_a_row));
  atomicMax(queue.groups_y, place / k_groups_in_a_row + 1);
  atomicMax(queue.groups_z, 1);
}

// The side before column or row i, and the one behind it at i + 1; those of rows follow those of columns.
struct Side {
  float boundary;       // slope, or metres in an orthographic view
  float across, along;  // unit normal, to the right or upward: of the coordinate, of the depth
  uint pixel;           // the first one behind it
};
Side side_at(uint i) {
  return Side(uintBitsToFloat(sides[i].x), uintBitsToFloat(sides[i].y), uintBitsToFloat(sides[i].z), sides[i].w);
}
Side column_side(uint column) { return side_at(column); }
Side row_side(uint row) { return side_at(frame.columns + 1 + row); }

// A tile's range of depth: empty if lo > hi.
struct Range {
  float lo, hi, scale;
  uint mask;  // of the parts with pixels
};
Range range_of(uint tile) {
  uvec4 bits = tiles[tile];
  return Range(uintBitsToFloat(bits.x), uintBitsToFloat(bits.y), uintBitsToFloat(bits.w), bits.z);
}
bool is_empty(Range range) { return range.lo > range.hi; }
void write_range(uint tile, Range range) {
  tiles[tile] = uvec4(floatBitsToUint(range.lo), floatBitsToUint(range.hi), range.mask, floatBitsToUint(range.scale));
}

// What lies around a tile between its depths.
Around around_tile(uint tile) {
  uint at = frame.cells + 3 * tile;
  return Around(uintBitsToFloat(tiles[at].xyz), uintBitsToFloat(tiles[at + 1].xyz), uintBitsToFloat(tiles[at + 2]));
}
void write_around(uint tile, Around around) {
  uint at = frame.cells + 3 * tile;
  tiles[at] = uvec4(floatBitsToUint(around.lo), 0);
  tiles[at + 1] = uvec4(floatBitsToUint(around.hi), 0);
  tiles[at + 2] = floatBitsToUint(around.ball);
}

// Where the device may round either way: the parts, too, that the processor may find. Both are off by less than 2^-20 of
// the distance from the range's begin: here a difference, the range's length, its inverse and two products are, by up to
// 2^-23 each, and there by half of that. Where the range is so short that numbers may be flushed to zero, all parts.
const float k_wider = 1.0 + 1.0 / 524288.0, k_narrower = 1.0 - 1.0 / 524288.0, k_short_range = 1.0e36;

// The place of a depth among 32 equal parts of a range, times a factor.
uint part_of(float depth, Range range, float factor) {
  precise float part = (depth - range.lo) * range.scale * factor;
  return part >= 31.0 ? 31u : part > 0.0 ? uint(part) : 0u;
}
// The parts from one depth to another. Monotonic, so a light's parts are those of all depths that it reaches.
uint bits_between(float near, float far, Range range, bool widens) {
  if (widens && range.scale > k_short_range) return 0xffffffffu;
  uint first = part_of(near, range, widens ? k_narrower : 1.0), last = part_of(far, range, widens ? k_wider : 1.0);
  return (0xffffffffu >> (31 - (last - first))) << first;
}
