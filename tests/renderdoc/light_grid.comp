// A program of others, for tests/scripts/test_renderdoc.py: an invocation per cell tests all lights against the box around
// its cell and writes what touches, at most 32 of them.
#version 450
layout(local_size_x = 64) in;

struct Light {
  vec4 position_range;  // view space
};
struct Cell {
  uint count;
  uint lights[32];
};
layout(std140, set = 0, binding = 0) uniform Frame {
  vec4 scale_near_far;  // of the projection: x, y; then near and far
  uvec4 cells_lights;   // columns, rows, slices, lights
} frame;
layout(std430, set = 0, binding = 1) readonly buffer Lights { Light lights[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Cells { Cell cells[]; };

float end_of_slice(uint slice) {
  float near = frame.scale_near_far.z, far = frame.scale_near_far.w;
  return near * pow(far / near, float(slice) / float(frame.cells_lights.z));
}

void main() {
  uint number = gl_GlobalInvocationID.x;
  uvec3 counts = frame.cells_lights.xyz;
  if (number >= counts.x * counts.y * counts.z) return;
  uvec3 at = uvec3(number % counts.x, number / counts.x % counts.y, number / (counts.x * counts.y));
  float near = end_of_slice(at.z), far = end_of_slice(at.z + 1);
  vec2 lo = (vec2(at.xy) / vec2(counts.xy) * 2.0 - 1.0) / frame.scale_near_far.xy;
  vec2 hi = (vec2(at.xy + 1) / vec2(counts.xy) * 2.0 - 1.0) / frame.scale_near_far.xy;
  vec3 box_lo = vec3(min(lo * near, lo * far), near), box_hi = vec3(max(hi * near, hi * far), far);
  uint count = 0;
  for (uint i = 0; i < frame.cells_lights.w; ++i) {
    vec4 light = lights[i].position_range;
    // The picture's rows go down, depth goes forward.
    vec3 center = vec3(light.x, -light.y, -light.z);
    vec3 away = center - clamp(center, box_lo, box_hi);
    float reach = light.w * 1.0001;  // more than rounding takes
    if (dot(away, away) <= reach * reach && count < 32) cells[number].lights[count++] = i;
  }
  cells[number].count = count;
}
