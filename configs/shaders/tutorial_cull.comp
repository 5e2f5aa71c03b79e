#version 450
// An invocation for each cell: every light against its box, until there is room for no more.
layout(local_size_x = 128) in;

struct Cell {
  vec4 lowest, highest;
  uint count;
  uint lights[100];
};
struct Light {
  vec4 position;  // in the world
  vec4 color;
  float intensity, range;
};
layout(std430, set = 0, binding = 0) buffer Cells { Cell cells[]; };
layout(std140, set = 0, binding = 1) uniform Frame {
  mat4 inverse_projection;
  mat4 view;
  uvec4 grid;
  vec2 screen;
  float near, far;
} frame;
layout(std430, set = 1, binding = 0) readonly buffer Lights { Light lights[]; };

bool touches(uint light, uint cell) {
  vec3 center = (frame.view * vec4(lights[light].position.xyz, 1.0)).xyz;
  vec3 nearest = clamp(center, cells[cell].lowest.xyz, cells[cell].highest.xyz);
  vec3 apart = center - nearest;
  return dot(apart, apart) <= lights[light].range * lights[light].range;
}

void main() {
  uint cell = gl_GlobalInvocationID.x;
  if (cell >= frame.grid.x * frame.grid.y * frame.grid.z) return;
  uint count = 0u;
  for (uint light = 0u; light < frame.grid.w && count < 100u; ++light) {
    if (!touches(light, cell)) continue;
    cells[cell].lights[count] = light;
    ++count;
  }
  cells[cell].count = count;
}
