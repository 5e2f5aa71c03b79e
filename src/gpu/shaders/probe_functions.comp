#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

// What the device makes of a division, a root and a logarithm, whose error is its own: three words for each of
// frame.cells pairs, which are in place of balls.
void main() {
  uint index = invocation_index();
  if (index >= frame.cells) return;
  float a = balls[index].x, b = balls[index].y;
  lists[3 * index] = floatBitsToUint(a / b);
  lists[3 * index + 1] = floatBitsToUint(sqrt(a));
  lists[3 * index + 2] = floatBitsToUint(log2(a));
}
