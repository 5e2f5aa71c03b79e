#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

// One invocation per cell, over all lights.
void main() {
  uint index = invocation_index();
  if (index >= frame.cells) return;
  Cell cell = cell_of(index);
  uint count = 0;
  if (MODE == k_count) {
    for (uint light = 0; light < frame.lights; ++light) count += uint(touches(light, balls[light], cell));
    counts[index] = count;
    return;
  }
  uint first = MODE == k_fixed ? index * frame.capacity : list_begin(index);
  uint room = MODE == k_fixed ? frame.capacity : frame.capacity - min(frame.capacity, first);
  for (uint light = 0; light < frame.lights; ++light) {
    if (!touches(light, balls[light], cell)) continue;
    if (count < room)
      lists[first + count] = light;
    else if (MODE == k_fixed)
      atomicOr(dropped[light / 32], 1u << (light % 32));
    ++count;
  }
  if (MODE == k_fixed)
    counts[index] = count;
  else
    begins[index] = first;
}
