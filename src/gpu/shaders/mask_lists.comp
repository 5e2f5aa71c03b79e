#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

// The lists of the bits of each cell, one invocation per cell.
void main() {
  uint index = invocation_index();
  if (index >= frame.cells) return;
  if (MODE == k_count) {
    uint count = 0;
    for (uint word = 0; word < frame.words; ++word) count += bitCount(masks[index * frame.words + word]);
    counts[index] = count;
    return;
  }
  uint at = list_begin(index);
  begins[index] = at;
  for (uint word = 0; word < frame.words; ++word)
    for (uint bits = masks[index * frame.words + word]; bits != 0; bits &= bits - 1, ++at)
      if (at < frame.capacity) lists[at] = 32 * word + findLSB(bits);
}
