// What all shaders share: arguments, buffers, and the tests of a light against a cell.
//
// Every result of single-precision arithmetic that a decision rests on is `precise`, so that no driver contracts or
// reorders it (SPIR-V: NoContraction; tests/gpu checks the modules). There is no dot(), length(), sqrt or division,
// whose error is the driver's: squares are compared instead.

#extension GL_EXT_control_flow_attributes : enable
#include "rounding.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint MODE = 0;  // as gpu/methods/frame_arguments.h
const uint k_count = 0, k_fill = 1, k_fixed = 2;

// As gpu/methods/frame_arguments.h.
layout(push_constant) uniform FrameArguments {
  uint cells, lights, points, tests_cones;
  uint columns, rows, slices;
  uint column_pitch, row_pitch;    // bounds from one slice to the next
  uint first_row, first_slice;     // where the bounds of rows and of slices begin
  uint words;                      // of 32 lights each
  uint capacity;                   // of a cell (k_fixed), of all lists (k_fill)
  float cone_slack;
  uint picture_width, is_orthographic;
  uint first_box;                  // boxes follow points and spots
  float corner_slack;
} frame;

#ifndef CELLS_ACCESS
#define CELLS_ACCESS readonly  // bounds.comp writes them
#endif
layout(std430, set = 0, binding = 0) readonly buffer Balls { vec4 balls[]; };           // centre, padded radius; < 0: empty
layout(std430, set = 0, binding = 1) CELLS_ACCESS buffer Bounds { vec2 bounds[]; };         // of columns, rows, slices
layout(std430, set = 0, binding = 2) CELLS_ACCESS buffer CellBalls { vec4 cell_balls[]; };  // only for cones
layout(std430, set = 0, binding = 3) readonly buffer Cones { vec4 cones[]; };           // three for each spot
layout(std430, set = 0, binding = 4) buffer Counts { uint counts[]; };                  // by cell
layout(std430, set = 0, binding = 5) buffer Begins { uint begins[]; };                  // by cell, and the end
layout(std430, set = 0, binding = 6) buffer Lists { uint lists[]; };
layout(std430, set = 0, binding = 7) buffer Sums { uint sums[]; };                      // of blocks of cells
layout(std430, set = 0, binding = 8) buffer Offsets { uint offsets[]; };                // by cell, within its block
layout(std430, set = 0, binding = 9) buffer Masks { uint masks[]; };                    // frame.words for each cell
layout(std430, set = 0, binding = 10) buffer Dropped { uint dropped[]; };               // a bit for each light

const uint k_block = 256;  // of cells whose counts are summed by one group

// Groups are spread over two dimensions where there are many.
uint group_index() { return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x; }
// The number of an invocation in its group, as shaders use it. Software drivers run a group's invocations in their
// order, which hides barriers that are missing; tests number them from the other end.
uint lane_index() {
#ifdef REVERSED_LANES
  return gl_WorkGroupSize.x - 1 - gl_LocalInvocationIndex;
#else
  return gl_LocalInvocationIndex;
#endif
}
uint invocation_index() { return group_index() * gl_WorkGroupSize.x + lane_index(); }

struct Cell {
  uint index;
  vec3 lo, hi;
};

Cell cell_at(uvec3 at) {
  vec2 x = bounds[at.z * frame.column_pitch + at.x];
  vec2 y = bounds[frame.first_row + at.z * frame.row_pitch + at.y];
  vec2 z = bounds[frame.first_slice + at.z];
  return Cell((at.z * frame.rows + at.y) * frame.columns + at.x, vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y));
}

Cell cell_of(uint index) {
  uint row = index / frame.columns;
  return cell_at(uvec3(index % frame.columns, row % frame.rows, row / frame.rows));
}

// Ball against box, by the box's nearest point to the centre: in the order of geom's ball_touches_box().
bool ball_touches_box(vec4 ball, vec3 lo, vec3 hi) {
  precise float x = max(0.0, max(lo.x - ball.x, ball.x - hi.x));
  precise float y = max(0.0, max(lo.y - ball.y, ball.y - hi.y));
  precise float z = max(0.0, max(lo.z - ball.z, ball.z - hi.z));
  precise float squared = x * x + y * y + z * z;
  precise float reach = ball.w * ball.w;
  return ball.w >= 0.0 && squared <= reach;
}

float size_of(vec3 v) {
  precise float size = abs(v.x) + abs(v.y) + abs(v.z);
  return size;
}

// A spot's cone against the ball around a cell; false only if the ball lies beyond the cone's side, beyond its range, or
// behind its apex. As geom's cone_touches_ball(), but squares are compared, so that there is no root.
//
// In unit roundoffs of the vector V from apex to centre: V is off by 1, a rounded axis by 1, the sum of products by 3, so
// `along` by 5; the vector across by these, the product with the axis and the difference: 8; the sum of its squares by 4
// and the product with cos^2 by 2 of themselves, so by 3 after the root. sin a * along adds 1, the sum with the reach 1,
// its square half of one: at most 8 + 3 + 5 + 3 = 19. The given apex, cosine and sine are rounded, and so is the sum that
// makes the reach: 4 more. frame.cone_slack is 32 of them; where the device may round either way, each step counts twice,
// and it is 64.
bool cone_touches_ball(uint spot, vec4 ball) {
  if (ball.w > 1e18) return true;
  vec4 apex = cones[3 * spot], axis = cones[3 * spot + 1];  // with the range; with cos a
  float sine = cones[3 * spot + 2].x;
  precise float x = ball.x - apex.x, y = ball.y - apex.y, z = ball.z - apex.z;
  precise float along = x * axis.x + y * axis.y + z * axis.z;
  precise float reach = ball.w + frame.cone_slack * (size_of(apex.xyz) + size_of(ball.xyz));
  precise float farthest = apex.w + reach;
  if (along < -reach || along > farthest) return false;
  precise float squared = x * x + y * y + z * z;
  precise float squared_farthest = farthest * farthest;
  if (squared > squared_farthest) return false;
  precise float across_x = x - along * axis.x, across_y = y - along * axis.y, across_z = z - along * axis.z;
  precise float across = across_x * across_x + across_y * across_y + across_z * across_z;
  precise float beside = reach + sine * along;  // beside the cone if cos a * |across| is more
  precise float left = axis.w * axis.w * across, right = beside * beside;
  return beside >= 0.0 && left <= right;
}

bool touches(uint light, vec4 ball, Cell cell) {
  if (!ball_touches_box(ball, cell.lo, cell.hi)) return false;
  return frame.tests_cones == 0 || light < frame.points ||
         cone_touches_ball(light - frame.points, cell_balls[cell.index]);
}

// Where the list of a cell begins, after its counts were summed.
uint list_begin(uint cell) { return sums[cell / k_block] + offsets[cell]; }
