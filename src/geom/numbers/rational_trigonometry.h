#pragma once
// Cosine, sine and square root of rational numbers, between rational bounds.

#include "geom/numbers/rational.h"

namespace clusterbench::geom {

struct RationalInterval {
  Rational lo, hi;
};

struct AngleBounds {
  RationalInterval cosine, sine;
};

// Bounds narrower than 2^(12 - bits); of an angle of 0 exact. angle: radians, 0 <= angle < 2. bits: at most 3100.
AngleBounds bounds_of_angle(const Rational& angle, unsigned bits);

// At least sqrt(value) and above it by less than 2^-300 of it; value >= 0.
Rational root_above(const Rational& value);

}  // namespace clusterbench::geom
