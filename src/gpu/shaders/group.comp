#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "boundaries.glsl"
#include "apart.glsl"

// One group per block of 4 x 4 x 4 cells, an invocation for each. 64 lights at a time are tested against the box around
// the block, an invocation for each light; those that touch it stay, and each invocation tests them against its cell. The
// box holds the cells' boxes. Where the device rounds to nearest that is monotonic, so that no light which passes the
// cell's test is left out, and the lists are those of all lights against all cells; elsewhere the padding covers both
// tests. With k_refines lights that touch the box around a cell are then tested against the cell itself; in an orthographic
// view the box is the cell.
const uint k_refines = 4;  // a bit of MODE, beside k_count or k_fill

shared vec3 block_lo[64], block_hi[64];
shared uint kept_bits[2];
shared uint kept[64];
shared vec4 kept_balls[64];

void main() {
  uvec3 blocks = uvec3((frame.columns + 3) / 4, (frame.rows + 3) / 4, (frame.slices + 3) / 4);
  uint block = group_index(), lane = lane_index();
  if (block >= blocks.x * blocks.y * blocks.z) return;  // the whole group
  uvec3 first = 4 * uvec3(block % blocks.x, block / blocks.x % blocks.y, block / (blocks.x * blocks.y));
  uvec3 at = first + uvec3(lane % 4, lane / 4 % 4, lane / 16);
  bool is_cell = at.x < frame.columns && at.y < frame.rows && at.z < frame.slices;
  at = min(at, uvec3(frame.columns, frame.rows, frame.slices) - 1);  // beyond the grid: the last one again
  Cell cell = cell_at(at);
  bool refines = (MODE & k_refines) != 0 && frame.is_orthographic == 0;
  Sides sides;
  if (refines) sides = sides_of(at);
  block_lo[lane] = cell.lo;
  block_hi[lane] = cell.hi;
  for (uint half_size = 32; half_size > 0; half_size /= 2) {
    barrier();
    if (lane < half_size) {
      block_lo[lane] = min(block_lo[lane], block_lo[lane + half_size]);
      block_hi[lane] = max(block_hi[lane], block_hi[lane + half_size]);
    }
  }
  bool fills = (MODE & k_fill) != 0;
  uint count = 0;
  uint begin = fills && is_cell ? list_begin(cell.index) : 0;
  for (uint batch = 0; batch < frame.lights; batch += 64) {
    if (lane < 2) kept_bits[lane] = 0;
    barrier();
    vec4 ball = vec4(0.0, 0.0, 0.0, -1.0);
    if (batch + lane < frame.lights) ball = balls[batch + lane];
    bool stays = ball_touches_box(ball, block_lo[0], block_hi[0]);
    if (stays) atomicOr(kept_bits[lane / 32], 1u << (lane % 32));
    barrier();
    uint low = kept_bits[0], high = kept_bits[1];
    uint before = (1u << (lane % 32)) - 1;
    uint place = lane < 32 ? bitCount(low & before) : bitCount(low) + bitCount(high & before);
    if (stays) {
      kept[place] = batch + lane;
      kept_balls[place] = ball;
    }
    barrier();
    // The bits were read before this barrier, and places are written only after the next two.
    uint kept_count = bitCount(low) + bitCount(high);
    for (uint i = 0; i < kept_count && is_cell; ++i) {
      if (!touches(kept[i], kept_balls[i], cell)) continue;
      if (refines && is_apart(kept_balls[i], sides)) continue;
      if (fills && begin + count < frame.capacity) lists[begin + count] = kept[i];
      ++count;
    }
  }
  if (!is_cell) return;
  if (fills)
    begins[cell.index] = begin;
  else
    counts[cell.index] = count;
}
