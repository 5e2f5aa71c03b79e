#version 460
#extension GL_GOOGLE_include_directive : require
#include "read.glsl"
#include "read_indices.glsl"

// Runs of lights with consecutive indices: the first one, and how many follow it.
layout(std430, set = 0, binding = 6) readonly buffer Headers { uint headers[]; };

uint run, end_run, run_light, left_in_run;

void begin_walk(Place place) {
  uint header = uint(place.cell) * args.header_words;
  run = headers[header];
  end_run = run + SUM_OF_COUNTS(headers, header);
  left_in_run = 0;
}

uint next_light() {
  if (left_in_run == 0) {
    if (run == end_run) return k_none;
    run_light = index_at(2 * run);
    left_in_run = index_at(2 * run + 1) + 1;
    ++run;
  }
  --left_in_run;
  return run_light++;
}

#include "read_walk.glsl"
