// The box and the ball around a cell between two sides (slopes, or metres in an orthographic view), two others below and
// above, and two depths. Boxes are those of geom's box_around(), bit for bit and on every device, but for products below
// the least normal number, which are rounded outward: what single precision does not give so is computed in integers.

const uint k_infinity = 0x7f800000u, k_largest = 0x7f7fffffu, k_sign = 0x80000000u;
// Far below the square of any length of the domain, and far above numbers that a device may take for 0.
const float k_least_square = 1e-34;

struct Around {
  vec3 lo, hi;
  vec4 ball;
};

// The product rounded toward minus or plus infinity. Its 48 bits are exact. Numbers below the normal ones count as 0 or as
// the least normal one, whichever is outward.
float outward_product(float a, float b, bool up) {
  uint bits_a = floatBitsToUint(a), bits_b = floatBitsToUint(b);
  if (bits_a << 1 == 0 || bits_b << 1 == 0) return 0.0;
  uint sign = (bits_a ^ bits_b) & k_sign;
  bool away = up == (sign == 0);  // from 0
  uint exponent_a = bits_a >> 23 & 255, exponent_b = bits_b >> 23 & 255;
  if (max(exponent_a, exponent_b) == 255) return uintBitsToFloat(sign | k_infinity);
  if (!away && (exponent_a == 0 || exponent_b == 0)) return 0.0;
  uint mantissa_a = exponent_a == 0 ? 1u << 23 : bits_a & 0x7fffffu | 1u << 23;
  uint mantissa_b = exponent_b == 0 ? 1u << 23 : bits_b & 0x7fffffu | 1u << 23;
  uint high, low;
  umulExtended(mantissa_a, mantissa_b, high, low);
  uint shift = high >> 15 == 0 ? 23 : 24;
  uint mantissa = high << (32 - shift) | low >> shift;
  int exponent = int(max(exponent_a, 1u) + max(exponent_b, 1u)) - 127 + int(shift) - 23;
  if (away && low << (32 - shift) != 0) ++mantissa;
  if (mantissa == 1u << 24) {
    mantissa >>= 1;
    ++exponent;
  }
  if (exponent <= 0) return uintBitsToFloat(sign | (away ? 1u << 23 : 0));
  if (exponent >= 255) return uintBitsToFloat(sign | (away ? k_infinity : k_largest));
  return uintBitsToFloat(sign | uint(exponent) << 23 | mantissa & 0x7fffffu);
}

// The least float whose rounded square is not below the square, by bisection of the floats in their order.
float root_above(float square) {
  uint below = 0, above = k_infinity;
  while (above - below > 1) {
    uint middle = (below + above) / 2;
    precise float squared = uintBitsToFloat(middle) * uintBitsToFloat(middle);
    if (squared < square)
      below = middle;
    else
      above = middle;
  }
  return uintBitsToFloat(above);
}

// The square of the distance from a point to the farthest corner of the cell's face at this depth.
float squared_to_corner(vec3 center, vec2 x, vec2 y, float depth) {
  precise float across = max(x.y - center.x, center.x - x.x), up = max(y.y - center.y, center.y - y.x);
  precise float along = abs(depth + center.z);
  precise float squared = across * across + up * up + along * along;
  return squared;
}

// The box around a cell, and the ball around its eight corners, with its centre in the middle of the box. In roundoffs of
// the squared distance: a difference 1, so its square 3, the sum of three 2 more, the factor's product 1, the square of the
// root 1: 7, or 14 where the device may round either way. The factor covers 32.
Around around(vec2 x, vec2 y, vec2 depth) {
  Around cell;
  vec2 near_x = x, far_x = x, near_y = y, far_y = y;
  if (frame.is_orthographic == 0) {
    near_x = vec2(outward_product(x.x, depth.x, false), outward_product(x.y, depth.x, true));
    far_x = vec2(outward_product(x.x, depth.y, false), outward_product(x.y, depth.y, true));
    near_y = vec2(outward_product(y.x, depth.x, false), outward_product(y.y, depth.x, true));
    far_y = vec2(outward_product(y.x, depth.y, false), outward_product(y.y, depth.y, true));
  }
  cell.lo = vec3(min(near_x.x, far_x.x), min(near_y.x, far_y.x), -depth.y);
  cell.hi = vec3(max(near_x.y, far_x.y), max(near_y.y, far_y.y), -depth.x);
  precise vec3 center = 0.5 * cell.lo + 0.5 * cell.hi;
  precise float squared = max(squared_to_corner(center, near_x, near_y, depth.x),
                              squared_to_corner(center, far_x, far_y, depth.y));
  precise float padded = squared * (1.0 + 32.0 / 16777216.0);
  cell.ball = vec4(center, padded < 1e38 ? root_above(max(padded, k_least_square)) : 1e19);
  return cell;
}
