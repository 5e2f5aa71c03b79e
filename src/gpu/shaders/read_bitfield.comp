#version 460
#extension GL_GOOGLE_include_directive : require
#include "read.glsl"

// A bit per light and cell. A wave walks the bits that any of its lanes has.
layout(std430, set = 0, binding = 5) readonly buffer Words { uint words[]; };

uint first_word, next_word, bits;

void begin_walk(Place place) {
  first_word = uint(place.cell) * args.per_cell;
  next_word = bits = 0;
}

uint next_light() {
  while (bits == 0) {
    if (next_word == args.per_cell) return k_none;
    bits = words[first_word + next_word++];
  }
  uint bit = findLSB(bits);
  bits &= bits - 1;
  return 32 * (next_word - 1) + bit;
}

#define WALKS_TOGETHER
void walk_together(Place place) {
  bool is_inside = place.cell >= 0;
  uint first = uint(max(place.cell, 0)) * args.per_cell;
  for (uint word = 0; word < args.per_cell; ++word) {
    uint own = is_inside ? words[first + word] : 0;
    for (uint all = subgroupOr(own); all != 0; all &= all - 1) {
      uint bit = findLSB(all);
      if ((own >> bit & 1u) != 0) visit(32 * word + bit);
    }
  }
}

#include "read_walk.glsl"
