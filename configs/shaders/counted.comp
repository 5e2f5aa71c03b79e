#version 450
// An invocation for each cell: it lists the lights whose ball touches the box around the cell, in room for `cap` of
// them, and counts on where that is full.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint cap = 128;

struct Light { vec3 position; float range; uint spare[4]; };  // in view space
layout(std430, set = 0, binding = 0) readonly buffer Lights { Light lights[]; };
layout(std430, set = 0, binding = 1) readonly buffer Frame {
  mat4 inverse_projection;
  uvec3 grid;
  uint light_count;
  float first_depth, last_depth;  // where the slices begin and end
} frame;
layout(std430, set = 0, binding = 2) writeonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Lists { uint lists[]; };

// The point of the view at depth 1 that a corner of tiles shows. Rows count from the top, and so does clip space.
vec2 at_depth_1(uvec2 corner) {
  vec4 point = frame.inverse_projection * vec4(2.0 * vec2(corner) / vec2(frame.grid.xy) - 1.0, 1.0, 1.0);
  return point.xy / -point.z;
}

float slice_depth(uint slice) {
  return frame.first_depth * pow(frame.last_depth / frame.first_depth, float(slice) / float(frame.grid.z));
}

void main() {
  uint cell = gl_GlobalInvocationID.x;
  if (cell >= frame.grid.x * frame.grid.y * frame.grid.z) return;
  uvec3 at = uvec3(cell % frame.grid.x, cell / frame.grid.x % frame.grid.y, cell / frame.grid.x / frame.grid.y);
  float near = slice_depth(at.z), far = slice_depth(at.z + 1u);
  vec2 a = at_depth_1(at.xy), b = at_depth_1(at.xy + 1u);
  vec2 least = min(a, b), most = max(a, b);
  vec3 low = vec3(min(least * near, least * far), -far), high = vec3(max(most * near, most * far), -near);

  uint count = 0u;
  for (uint light = 0u; light < frame.light_count; ++light) {
    vec3 apart = lights[light].position - clamp(lights[light].position, low, high);
    // A hair more than the range, for the roundings above.
    if (dot(apart, apart) > lights[light].range * lights[light].range * 1.00001) continue;
    if (count < cap) lists[cell * cap + count] = light;
    ++count;
  }
  counts[cell] = count;
}
