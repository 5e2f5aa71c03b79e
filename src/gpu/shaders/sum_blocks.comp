#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

// In groups of k_block: the sum of the counts before each cell within its block, and the sum of the block.
shared uint partial[k_block];

void main() {
  uint cell = invocation_index(), lane = lane_index();
  uint own = cell < frame.cells ? counts[cell] : 0;
  partial[lane] = own;
  for (uint step_size = 1; step_size < k_block; step_size *= 2) {
    barrier();
    uint before = lane >= step_size ? partial[lane - step_size] : 0;
    barrier();
    partial[lane] += before;
  }
  if (cell < frame.cells) offsets[cell] = partial[lane] - own;
  if (lane == k_block - 1 && cell - lane < frame.cells) sums[cell / k_block] = partial[lane];
}
