#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

// Writes frame.capacity words.
void main() {
  uint at = invocation_index();
  if (at < frame.capacity) lists[at] = at;
}
