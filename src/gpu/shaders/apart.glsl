// A ball against a cell itself, in place of the box around it: of a frustum, whose slopes and depths are exact as floats.
//
// A direction n is a certificate that they are apart if the ball's centre lies farther along n than each corner of the
// cell, by more than the radius. Any n will do: way_out() looks for a good one, and its errors cost certificates, never a
// pair. Only least_gap() and is_apart() decide. Points are (x, y, depth).

// 1 / x for x from 1 on, off by less than 2^-20: a division would be off by as much as the driver likes.
float inverse(float x) {
  float guess = uintBitsToFloat(0x7ef311c7u - floatBitsToUint(x));
  for (uint turn = 0; turn < 3; ++turn) {
    precise float better = guess * (2.0 - x * guess);
    guess = better;
  }
  return guess;
}

// The slope of the side that a coordinate lies beyond at a depth; 0 if it lies between both.
float side_beyond(float at, vec2 slopes, float depth) {
  precise vec2 sides = slopes * depth;
  return at < sides.x ? slopes.x : at > sides.y ? slopes.y : 0.0;
}

// The slopes of the corners that lie farthest along n, the same at each depth, as no depth is negative.
vec2 slopes_along(vec3 n, Sides cell) {
  return vec2(n.x > 0.0 ? cell.x.y : cell.x.x, n.y > 0.0 ? cell.y.y : cell.y.x);
}

// From the cell's point nearest to the centre. At each depth the cell is a rectangle, so the square of the distance is
// convex in the depth, and quadratic as long as the centre lies beyond the same sides. The depth of the least square for
// the sides at one depth is where to look at the sides next; after three turns they rarely change.
//
// Between the cell's two depths the way is normal to the side that the centre lies beyond, or to the edge of two: its z
// follows from their slopes. A difference of depths is off by roundoffs of the depth: beside a small gap it would turn the
// way by so much that the far corners lie beyond the centre. At the near depth the way points at least as far towards the
// eye as that normal, at the far depth at least as far away.
//
// The result is scaled by a power of two to about 1: squares neither vanish, as lengths are 1e-15 m or more, nor overflow,
// but for those of a light without an end, which is apart from nothing.
vec3 way_out(vec3 center, Sides cell) {
  float depth = clamp(center.z, cell.depth.x, cell.depth.y);
  for (uint turn = 0; turn < 3; ++turn) {
    float x = side_beyond(center.x, cell.x, depth), y = side_beyond(center.y, cell.y, depth);
    precise float squared = 1.0 + x * x + y * y;
    precise float least = (center.z + x * center.x + y * center.y) * inverse(squared);
    depth = clamp(least, cell.depth.x, cell.depth.y);
  }
  precise vec2 x = cell.x * depth, y = cell.y * depth;
  precise vec3 way = center - vec3(clamp(center.x, x.x, x.y), clamp(center.y, y.x, y.y), depth);
  vec2 slopes = slopes_along(way, cell);
  precise float normal = -(way.x * slopes.x + way.y * slopes.y);
  way.z = depth <= cell.depth.x ? min(way.z, normal) : depth >= cell.depth.y ? max(way.z, normal) : normal;
  uint exponent = floatBitsToUint(max(max(abs(way.x), abs(way.y)), abs(way.z))) & 0x7f800000u;
  precise vec3 scaled = way * uintBitsToFloat((254u << 23) - exponent);
  return scaled;
}

// By how much at least the centre lies farther along n than the corner with these slopes and depth.
//
// In roundoffs, for each coordinate of the corner p and of the vector e from it to the centre: p = slope * depth is off by
// 1 of |p|, e by as much and by 1 of |e|; the product with n adds 1 of |n e|, the sums 2, and the last difference 1: in all
// 1 of |n p| and 5 of |n e|. frame.corner_slack is 2, and covers 2 and 8, with the roundoffs of `size`; where the device may
// round either way, each step counts twice, and it is 4.
float least_gap(vec3 n, vec3 center, vec2 slopes, float depth) {
  precise vec3 corner = vec3(slopes * depth, depth);
  precise vec3 apart = center - corner;
  precise float gap = n.x * apart.x + n.y * apart.y + n.z * apart.z;
  precise float size = abs(n.x) * (abs(corner.x) + 4.0 * abs(apart.x)) + abs(n.y) * (abs(corner.y) + 4.0 * abs(apart.y)) +
                       4.0 * abs(n.z) * abs(apart.z);
  precise float least = gap - frame.corner_slack * size;
  return least;
}

// By how much n is tilted towards the eye where a cell reaches much farther than the light. Beside a side n is normal to it
// but for roundoffs, which at the far corner can be more than the gap. Then the farthest corner at each depth is to move back
// along n, by 16 slacks of what its movement adds up to: the gap grows with the depth by more than roundoffs do. Far from
// normal n says that the far end is nearest, and stays as it is.
float tilt(vec3 n, vec3 center, vec2 slopes, float far) {
  precise float moves = n.x * slopes.x + n.y * slopes.y + n.z;  // of the corner, by metre of depth
  precise float size = abs(n.x * slopes.x) + abs(n.y * slopes.y) + abs(n.z);
  precise float most = moves + 16.0 * frame.corner_slack * size;
  precise float beside = 0.0009765625 * size, reaches_far = 4.0 * center.z;
  return far > reaches_far && moves < beside ? max(most, 0.0) : 0.0;
}

// Squares are compared: that of the gap is off by 1 roundoff, those of the radius by 1 and of n by 3, their product by 1: 6
// of themselves, so 3 of the radius after the root. The ball is padded by 4 of its reach, which is more.
bool is_apart(vec4 ball, Sides cell) {
  vec3 center = vec3(ball.xy, -ball.z);
  vec3 n = way_out(center, cell);
  vec2 slopes = slopes_along(n, cell);
  precise float toward_eye = n.z - tilt(n, center, slopes, cell.depth.y);
  n.z = toward_eye;
  float near = least_gap(n, center, slopes, cell.depth.x), far = least_gap(n, center, slopes, cell.depth.y);
  if (!(near > 0.0 && far > 0.0)) return false;
  precise float squared = min(near, far) * min(near, far);
  precise float reach = ball.w * ball.w * (n.x * n.x + n.y * n.y + n.z * n.z);
  return squared > reach;
}
