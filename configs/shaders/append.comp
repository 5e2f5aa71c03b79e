#version 450
// A group for each cell. Its invocations share the lights: they count those that touch, one of them takes so much of a
// common array by a counter, and all append. So the order of lists, and of lights in a list, is another one each time.
layout(local_size_x_id = 0) in;

layout(std430, set = 0, binding = 0) readonly buffer Positions { float positions[]; };  // x, y, z of each light, in view space
layout(std430, set = 0, binding = 1) readonly buffer Ranges { float squared_ranges[]; };
layout(std430, set = 0, binding = 2) readonly buffer Boundaries { float boundaries[]; };  // of columns, rows, slices
layout(std430, set = 0, binding = 3) writeonly buffer Headers { uvec2 headers[]; };      // offset and count of each cell
layout(std430, set = 0, binding = 4) writeonly buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 5) buffer Counter { uint used; };

layout(push_constant) uniform Frame { uint columns, rows, slices, lights, room; } frame;

shared uint count, first, next;

vec2 span(float a, float b, float near, float far) {
  return vec2(min(min(a * near, a * far), min(b * near, b * far)), max(max(a * near, a * far), max(b * near, b * far)));
}

bool touches(uint light, vec3 low, vec3 high) {
  vec3 center = vec3(positions[3u * light], positions[3u * light + 1u], positions[3u * light + 2u]);
  vec3 apart = center - clamp(center, low, high);
  // A hair more than the range, for the roundings above.
  return dot(apart, apart) <= squared_ranges[light] * 1.00001;
}

void main() {
  uint cell = gl_WorkGroupID.x;
  uint x = cell % frame.columns, y = cell / frame.columns % frame.rows, z = cell / frame.columns / frame.rows;
  uint row = frame.columns + 1u + y, slice = frame.columns + frame.rows + 2u + z;
  float near = boundaries[slice], far = boundaries[slice + 1u];
  vec2 across = span(boundaries[x], boundaries[x + 1u], near, far);
  vec2 down = span(boundaries[row + 1u], boundaries[row], near, far);
  vec3 low = vec3(across.x, down.x, -far), high = vec3(across.y, down.y, -near);

  if (gl_LocalInvocationIndex == 0u) count = next = 0u;
  barrier();
  for (uint light = gl_LocalInvocationIndex; light < frame.lights; light += gl_WorkGroupSize.x)
    if (touches(light, low, high)) atomicAdd(count, 1u);
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    first = atomicAdd(used, count);
    headers[cell] = uvec2(first, count);
  }
  barrier();
  for (uint light = gl_LocalInvocationIndex; light < frame.lights; light += gl_WorkGroupSize.x) {
    if (!touches(light, low, high)) continue;
    uint at = first + atomicAdd(next, 1u);
    if (at < frame.room) indices[at] = light;
  }
}
