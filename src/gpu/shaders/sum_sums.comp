#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

// One group of k_block: of each block the sum of the blocks before it, and the sum of all as the end of the last list. It
// saturates, so that a sum beyond 32 bits cannot look like a small one.
shared uint partial[k_block];
shared uint carry;

uint saturated_sum(uint a, uint b) { return a > 0xffffffffu - b ? 0xffffffffu : a + b; }

void main() {
  uint lane = lane_index(), blocks = (frame.cells + k_block - 1) / k_block;
  if (lane == 0) carry = 0;
  for (uint first = 0; first < blocks; first += k_block) {
    uint own = first + lane < blocks ? sums[first + lane] : 0;
    partial[lane] = own;
    for (uint step_size = 1; step_size < k_block; step_size *= 2) {
      barrier();
      uint before = lane >= step_size ? partial[lane - step_size] : 0;
      barrier();
      partial[lane] = saturated_sum(partial[lane], before);
    }
    uint start = carry;
    if (first + lane < blocks) sums[first + lane] = saturated_sum(start, partial[lane] - own);
    barrier();
    if (lane == k_block - 1) carry = saturated_sum(start, partial[lane]);  // read after the next turn's barriers
  }
  if (lane == k_block - 1) begins[frame.cells] = carry;  // its own
}
