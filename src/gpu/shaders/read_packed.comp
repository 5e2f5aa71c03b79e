#version 460
#extension GL_GOOGLE_include_directive : require
#include "read.glsl"
#include "read_indices.glsl"

// A header per cell, or per cell with lights, and one list of indices.
layout(std430, set = 0, binding = 6) readonly buffer Headers { uint headers[]; };
layout(std430, set = 0, binding = 7) readonly buffer Blocks { uint blocks[]; };  // k_is_sparse: mask and rank of 32 cells

uint entry, end_entry;

void begin_walk(Place place) {
  uint header = uint(place.cell);
  entry = end_entry = 0;
  if (k_is_sparse) {
    uint block = header >> 5, bit = 1u << (header & 31u), mask = blocks[2 * block];
    if ((mask & bit) == 0) return;
    header = blocks[2 * block + 1] + bitCount(mask & (bit - 1));
  }
  header *= args.header_words;
  entry = headers[header];
  end_entry = entry + SUM_OF_COUNTS(headers, header);
}

uint next_light() { return entry == end_entry ? k_none : index_at(entry++); }

#include "read_walk.glsl"
