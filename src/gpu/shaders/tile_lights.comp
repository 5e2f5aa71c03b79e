#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "tile.glsl"

// One group per tile, 64 lights at a time, an invocation for each: a bit for each light that meets the tile. The masks
// must have been cleared; tiles without a surface are left alone, or have no group (k_occupied).
const uint k_planes = 1, k_boxes = 2, k_depth_mask = 4, k_widens = 8, k_occupied = 16;  // bits of MODE

layout(std430, set = 0, binding = 14) readonly buffer BoxBounds { vec4 box_bounds[]; };  // two for each box

shared uint bits[2];

// Positive to the right of a column's side, above a row's side. In roundoffs of |coordinate| + |depth|: the rounded normal
// 1, the products 1, the sum 1; in an orthographic view the difference alone. Those that the ball is padded by are more.
float beyond(Side side, float coordinate, float depth) {
  if (frame.is_orthographic != 0) {
    precise float metres = coordinate - side.boundary;
    return metres;
  }
  precise float distance = side.across * coordinate + side.along * depth;
  return distance;
}

bool is_beside(vec4 ball, uint column, uint row) {
  return beyond(column_side(column), ball.x, -ball.z) < -ball.w ||
         beyond(column_side(column + 1), ball.x, -ball.z) > ball.w ||
         beyond(row_side(row), ball.y, -ball.z) > ball.w || beyond(row_side(row + 1), ball.y, -ball.z) < -ball.w;
}

bool meets_depths(float near, float far, Range range) {
  if (near > range.hi || far < range.lo) return false;
  return (MODE & k_depth_mask) == 0 || (bits_between(near, far, range, (MODE & k_widens) != 0) & range.mask) != 0;
}

// Boxes by the padded axis-aligned boxes around them: comparisons alone.
bool box_meets_tile(uint box, Range range, Around around) {
  vec3 lo = box_bounds[2 * box].xyz, hi = box_bounds[2 * box + 1].xyz;
  return meets_depths(-hi.z, -lo.z, range) &&
         ((MODE & k_boxes) == 0 || all(lessThanEqual(lo, around.hi)) && all(lessThanEqual(around.lo, hi)));
}

bool meets_tile(uint light, uint tile, Range range, Around around) {
  vec4 ball = balls[light];
  if (ball.w < 0.0) return false;
  if ((MODE & k_planes) != 0 && is_beside(ball, tile % frame.columns, tile / frame.columns)) return false;
  if (light >= frame.first_box) return box_meets_tile(light - frame.first_box, range, around);
  precise float near = -ball.z - ball.w, far = -ball.z + ball.w;
  if (!meets_depths(near, far, range)) return false;
  if ((MODE & k_boxes) != 0 && !ball_touches_box(ball, around.lo, around.hi)) return false;
  return frame.tests_cones == 0 || light < frame.points || cone_touches_ball(light - frame.points, around.ball);
}

void main() {
  uint group = group_index(), lane = lane_index();
  if (group >= ((MODE & k_occupied) != 0 ? queue.count : frame.cells)) return;  // the whole group
  uint tile = (MODE & k_occupied) != 0 ? queue.tiles[group] : group;
  Range range = range_of(tile);
  if (is_empty(range)) return;  // the whole group
  Around around = around_tile(tile);
  for (uint word = 0; word < frame.words; word += 2) {
    if (lane < 2) bits[lane] = 0;
    barrier();
    uint light = 32 * word + lane;
    if (light < frame.lights && meets_tile(light, tile, range, around)) atomicOr(bits[lane / 32], 1u << (lane % 32));
    barrier();
    if (lane < 2 && word + lane < frame.words) masks[tile * frame.words + word + lane] = bits[lane];
  }
}
