#version 450
// The box around each cell in view space: the corners of its tile, unprojected, and carried along their rays to the two
// depths between which its slice lies. After the description of DaveH355's tutorial; row 0 is at the bottom.
layout(local_size_x = 1) in;

struct Cell {
  vec4 lowest, highest;
  uint count;
  uint lights[100];
};
layout(std430, set = 0, binding = 0) buffer Cells { Cell cells[]; };
layout(std140, set = 0, binding = 1) uniform Frame {
  mat4 inverse_projection;
  mat4 view;
  uvec4 grid;         // columns, rows, slices, lights
  vec2 screen;        // in pixels
  float near, far;
} frame;

// The point of a pixel on the near plane.
vec3 unprojected(vec2 pixel) {
  vec4 clip = vec4(pixel / frame.screen * 2.0 - 1.0, -1.0, 1.0);
  vec4 view = frame.inverse_projection * clip;
  return view.xyz / view.w;
}

vec3 at_depth(vec3 on_ray, float depth) { return on_ray * (depth / -on_ray.z); }

void main() {
  uvec3 at = gl_WorkGroupID;
  vec2 tile = frame.screen / vec2(frame.grid.xy);
  vec3 low = unprojected(vec2(at.xy) * tile), high = unprojected(vec2(at.xy + 1u) * tile);
  float ratio = frame.far / frame.near;
  float first = frame.near * pow(ratio, float(at.z) / float(frame.grid.z));
  float last = frame.near * pow(ratio, float(at.z + 1u) / float(frame.grid.z));
  vec3 a = at_depth(low, first), b = at_depth(high, first), c = at_depth(low, last), d = at_depth(high, last);
  uint index = at.x + frame.grid.x * (at.y + frame.grid.y * at.z);
  cells[index].lowest = vec4(min(min(a, b), min(c, d)), 0.0);
  cells[index].highest = vec4(max(max(a, b), max(c, d)), 0.0);
}
