#pragma once
// Squares and square roots of numbers that are exact and have a sign().

namespace clusterbench::geom {

template <class Exact>
Exact squared(const Exact& value) {
  return value * value;
}

// a <= b * sqrt(n), n >= 0.
template <class Exact>
bool at_most_root(const Exact& a, const Exact& b, const Exact& n) {
  if (a.sign() <= 0 && b.sign() >= 0) return true;
  if (a.sign() >= 0 && b.sign() <= 0) return a.sign() == 0 && (b.sign() == 0 || n.sign() == 0);
  return a.sign() > 0 ? squared(a) <= squared(b) * n : squared(a) >= squared(b) * n;
}

}  // namespace clusterbench::geom
