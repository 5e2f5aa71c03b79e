#version 460
#extension GL_GOOGLE_include_directive : require
#include "read.glsl"

// Lights sorted by depth: of each slice or cell the first and the last one of each type, of each tile a bit for each. A wave
// walks the union of its lanes' ranges and bits.
layout(std430, set = 0, binding = 5) readonly buffer Masks { uint masks[]; };         // args.per_cell words for each tile
layout(std430, set = 0, binding = 6) readonly buffer Ranges { uint ranges[]; };       // two types each
layout(std430, set = 0, binding = 7) readonly buffer Order { uint order[]; };         // the light of each rank
layout(std430, set = 0, binding = 8) readonly buffer BinMasks { uint bin_masks[]; };  // args.per_cell words for each slice

const uint k_types = 2;

// Ranks of one type in one place: words first / 32 to before end_word have their bits.
struct Range {
  uint first, end, end_word;
};

Range range_of(Place place, uint type) {
  uint at = k_types * (k_has_range_per_cell ? uint(place.cell) : place.slice) + type;
  uint first, end;
  if (k_has_narrow_ranks) {
    first = ranges[at] & 0xffffu;
    end = ranges[at] >> 16;
  } else {
    first = ranges[2 * at];
    end = ranges[2 * at + 1];
  }
  return Range(first, end, first < end ? (end + 31) / 32 : first / 32);
}

uint bits_of(Place place, Range range, uint word) {
  uint own = masks[place.tile * args.per_cell + word];
  if (k_has_bin_masks) own &= bin_masks[place.slice * args.per_cell + word];
  if (word == range.first / 32) own &= 0xffffffffu << range.first % 32;
  if (word == range.end / 32) own &= (1u << range.end % 32) - 1;
  return own;
}

Place walked;
Range walked_range;
uint type, next_word, bits;

void begin_type(uint of) {
  type = of;
  walked_range = range_of(walked, type);
  next_word = walked_range.first / 32;
}

void begin_walk(Place place) {
  walked = place;
  bits = 0;
  begin_type(0);
}

uint next_light() {
  while (bits == 0) {
    if (next_word == walked_range.end_word) {
      if (type == k_types - 1) return k_none;
      begin_type(type + 1);
    } else {
      bits = bits_of(walked, walked_range, next_word++);
    }
  }
  uint bit = findLSB(bits);
  bits &= bits - 1;
  return order[32 * (next_word - 1) + bit];
}

#define WALKS_TOGETHER
void walk_together(Place place) {
  bool is_inside = place.cell >= 0;
  for (uint of = 0; of < k_types; ++of) {
    Range own_range = Range(0, 0, 0);
    if (is_inside) own_range = range_of(place, of);
    uint own_word = own_range.first / 32;
    bool is_empty = own_word == own_range.end_word;
    uint end_word = subgroupMax(is_empty ? 0 : own_range.end_word);
    for (uint word = subgroupMin(is_empty ? k_none : own_word); word < end_word; ++word) {
      uint own = 0;
      if (word >= own_word && word < own_range.end_word) own = bits_of(place, own_range, word);
      for (uint all = subgroupOr(own); all != 0; all &= all - 1) {
        uint bit = findLSB(all);
        uint light = order[32 * word + bit];
        if ((own >> bit & 1u) != 0) visit(light);
      }
    }
  }
}

#include "read_walk.glsl"
