#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_clock : require
#include "common.glsl"

// Waits for frame.capacity cycles of the clock that its unit runs by, and tells how many it were at the end: to list
// number frame.first_box. Where that clock is slow it ends earlier.
const uint k_most_turns = 16384;

void main() {
  uvec2 begin = clock2x32ARB(), now = begin;
  for (uint turn = 0; turn < k_most_turns && now.x - begin.x < frame.capacity; ++turn) now = clock2x32ARB();
  lists[frame.first_box] = now.x - begin.x;
}
