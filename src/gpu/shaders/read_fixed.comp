#version 460
#extension GL_GOOGLE_include_directive : require
#include "read.glsl"
#include "read_indices.glsl"

// Room for the same number of indices in each cell, with a count, or with a mark behind the last one.
layout(std430, set = 0, binding = 6) readonly buffer Counts { uint counts[]; };

uint entry, end_entry;

void begin_walk(Place place) {
  entry = uint(place.cell) * args.per_cell;
  end_entry = entry + (k_has_end_mark ? args.per_cell : counts[place.cell]);
}

uint next_light() {
  if (entry == end_entry) return k_none;
  uint light = index_at(entry++);
  if (!k_has_end_mark || light != args.end_mark) return light;
  entry = end_entry;
  return k_none;
}

#include "read_walk.glsl"
