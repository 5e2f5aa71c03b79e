#version 460
#extension GL_GOOGLE_include_directive : require
#include "read.glsl"

// What any reading costs without its lights: the lookup and a result; or the result alone. And the lookup's cells.
void main() {
  uint index = invocation_index();
  if (index >= args.samples) return;
  if (k_output == k_write_only) {
    results[index] = index;
    return;
  }
  vec3 at = position_of(index);
  Place place = place_of(index, at);
  if (k_output == k_cells)
    results[index] = uint(place.cell);
  else
    results[index] = floatBitsToUint(at.x) ^ floatBitsToUint(at.y) ^ floatBitsToUint(at.z) ^ uint(place.cell);
}
