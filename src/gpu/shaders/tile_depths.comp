#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "tile.glsl"

// One group per tile, over its pixels: the range of their depths, the mask of the parts with pixels, and what lies around
// the tile between these depths.
const uint k_with_mask = 1, k_widens = 2, k_appends = 4;  // bits of MODE

shared uint nearest, farthest, parts;
shared Range range;

// Floats as integers of the same order, and back.
uint order_of(uint bits) { return bits >= k_sign ? ~bits : bits | k_sign; }
uint in_order(uint order) { return order >= k_sign ? order & ~k_sign : ~order; }

uint next_up(uint bits) { return bits << 1 == 0 ? 1u : bits >= k_sign ? bits - 1 : bits + 1; }

// 32 / length, rounded to nearest, but finite; by long division of 2^47 by the mantissa, which is never halfway.
float parts_per_metre(float depth_range) {
  uint bits = floatBitsToUint(depth_range), exponent = bits >> 23, divisor = bits & 0x7fffffu | 1u << 23;
  if (exponent <= 3) return uintBitsToFloat(k_largest);
  uint quotient = 0, rest = 1u << 23;
  for (uint bit = 0; bit <= 24; ++bit) {
    if (bit > 0) rest *= 2;
    quotient *= 2;
    if (rest >= divisor) {
      rest -= divisor;
      ++quotient;
    }
  }
  if (2 * rest > divisor) ++quotient;
  uint scaled = 258 - exponent;
  return uintBitsToFloat(quotient == 1u << 24 ? (scaled + 1) << 23 : scaled << 23 | quotient & 0x7fffffu);
}

void main() {
  uint tile = group_index(), lane = lane_index();
  if (tile >= frame.cells) return;  // the whole group
  uint column = tile % frame.columns, row = tile / frame.columns;
  if (lane == 0) {
    nearest = 0xffffffffu;
    farthest = parts = 0;
  }
  barrier();
  uvec2 first = uvec2(column_side(column).pixel, row_side(row).pixel);
  uvec2 size = uvec2(column_side(column + 1).pixel, row_side(row + 1).pixel) - first;
  uint pixels = size.x * size.y;
  uint lo = 0xffffffffu, hi = 0;
  for (uint pixel = lane; pixel < pixels; pixel += gl_WorkGroupSize.x) {
    uint depth = depths[(first.y + pixel / size.x) * frame.picture_width + first.x + pixel % size.x];
    if (depth == k_infinity) continue;
    lo = min(lo, order_of(depth));
    hi = max(hi, order_of(depth));
  }
  if (lo <= hi) {
    atomicMin(nearest, lo);
    atomicMax(farthest, hi);
  }
  barrier();
  if (nearest > farthest) {  // the whole group: no pixel has a surface
    if (lane == 0) tiles[tile] = uvec4(k_infinity, k_sign | k_infinity, 0, 0);
    return;
  }
  if (lane == 0) {
    range.lo = uintBitsToFloat(in_order(nearest));
    range.hi = uintBitsToFloat(next_up(in_order(farthest)));
    precise float depth_range = range.hi - range.lo;
    range.scale = parts_per_metre(depth_range);
    range.mask = 0;
  }
  barrier();
  if ((MODE & k_with_mask) != 0) {
    Range own = range;
    uint bits = 0;
    for (uint pixel = lane; pixel < pixels; pixel += gl_WorkGroupSize.x) {
      uint depth = depths[(first.y + pixel / size.x) * frame.picture_width + first.x + pixel % size.x];
      if (depth == k_infinity) continue;
      float at = uintBitsToFloat(depth);
      bits |= bits_between(at, at, own, (MODE & k_widens) != 0);
    }
    atomicOr(parts, bits);
    barrier();
  }
  if (lane == 0) {
    range.mask = parts;
    write_range(tile, range);
    if ((MODE & k_appends) != 0) append_to_queue(tile);
    vec2 x = vec2(column_side(column).boundary, column_side(column + 1).boundary);
    vec2 y = vec2(row_side(row + 1).boundary, row_side(row).boundary);
    write_around(tile, around(x, y, vec2(range.lo, range.hi)));
  }
}
