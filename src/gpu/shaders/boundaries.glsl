// The boundaries of a grid of cells, by which the cells themselves are defined.

// Of columns ascending, of rows from the top, of slices.
layout(std430, set = 0, binding = 11) readonly buffer Boundaries { float boundaries[]; };

// Below and above: slopes, or metres in an orthographic view; depths.
struct Sides {
  vec2 x, y, depth;
};

Sides sides_of(uvec3 at) {
  uint row = frame.columns + 1 + at.y, slice = frame.columns + 1 + frame.rows + 1 + at.z;
  return Sides(vec2(boundaries[at.x], boundaries[at.x + 1]), vec2(boundaries[row + 1], boundaries[row]),
               vec2(boundaries[slice], boundaries[slice + 1]));
}
