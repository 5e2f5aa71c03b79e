#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

// One group per light, which visits only the slices, rows and columns that the light can reach. Rounding to nearest is
// monotonic (where the device rounds otherwise the padding covers these steps, too) and squares are not negative, so a gap
// that alone, or with one other, exceeds the reach excludes only what ball_touches_box() excludes: the masks are those of
// all pairs. They must have been cleared.
shared uint first_column, last_column, first_row, last_row;

// The square of the gap between a value and an interval, added to another one.
bool is_within(float value, vec2 interval, float squared, float reach) {
  precise float gap = max(0.0, max(interval.x - value, value - interval.y));
  precise float sum = gap * gap + squared;
  return sum <= reach;
}

void main() {
  uint light = group_index(), lane = lane_index();
  if (light >= frame.lights) return;  // the whole group
  vec4 ball = balls[light];
  if (ball.w < 0.0) return;
  precise float reach = ball.w * ball.w;
  for (uint slice = 0; slice < frame.slices; ++slice) {
    vec2 depths = bounds[frame.first_slice + slice];
    precise float gap = max(0.0, max(depths.x - ball.z, ball.z - depths.y));
    precise float squared = gap * gap;
    if (squared > reach) continue;  // the whole group
    if (lane == 0) {
      first_column = first_row = 0xffffffffu;
      last_column = last_row = 0;
    }
    barrier();
    for (uint x = lane; x < frame.columns; x += gl_WorkGroupSize.x)
      if (is_within(ball.x, bounds[slice * frame.column_pitch + x], squared, reach)) {
        atomicMin(first_column, x);
        atomicMax(last_column, x);
      }
    for (uint y = lane; y < frame.rows; y += gl_WorkGroupSize.x)
      if (is_within(ball.y, bounds[frame.first_row + slice * frame.row_pitch + y], squared, reach)) {
        atomicMin(first_row, y);
        atomicMax(last_row, y);
      }
    barrier();
    if (first_column != 0xffffffffu && first_row != 0xffffffffu) {
      uint width = last_column - first_column + 1, pairs = width * (last_row - first_row + 1);
      for (uint pair = lane; pair < pairs; pair += gl_WorkGroupSize.x) {
        Cell cell = cell_at(uvec3(first_column + pair % width, first_row + pair / width, slice));
        if (touches(light, ball, cell))
          atomicOr(masks[cell.index * frame.words + light / 32], 1u << (light % 32));
      }
    }
    barrier();
  }
}
