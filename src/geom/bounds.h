#pragma once
// Cosine, sine and square root of rational numbers, between rational bounds.

#include <optional>

#include "geom/rational.h"

namespace clusterbench::geom {

struct RationalInterval {
  Rational lo, hi;
};

struct AngleBounds {
  RationalInterval cosine, sine;  // wide by less than 2^-500; of an angle of 0 exact
};

// angle: radians, 0 <= angle < 2.
AngleBounds bounds_of_angle(const Rational& angle);

// Its square root, if that is rational; value >= 0.
std::optional<Rational> exact_root(const Rational& value);
// At least sqrt(value) and above it by less than 2^-500 of it; value >= 0.
Rational root_above(const Rational& value);

}  // namespace clusterbench::geom
