#pragma once
// Polynomials over any number type, and their roots in [-1, 1].

#include <algorithm>
#include <array>
#include <cmath>

namespace clusterbench::geom {

// A polynomial c[0] + c[1] t + ... of degree `degree` <= 4.
template <class Real>
struct Polynomial {
  std::array<Real, 5> c;
  int degree;

  Real value_at(const Real& t) const {
    Real value = c[static_cast<std::size_t>(degree)];
    for (int i = degree; i-- > 0;) value = value * t + c[static_cast<std::size_t>(i)];
    return value;
  }
  Polynomial derivative() const {
    Polynomial d{{}, degree - 1};
    for (std::size_t i = 1; i <= static_cast<std::size_t>(degree); ++i)
      d.c[i - 1] = Real(static_cast<double>(i)) * c[i];
    return d;
  }
};

// A few numbers in [-1, 1].
template <class Real>
struct Roots {
  std::array<Real, 16> at;
  std::size_t count = 0;

  void add(const Real& root) { at[count++] = root; }
  const Real* begin() const { return at.data(); }
  const Real* end() const { return at.data() + count; }
};

// The root between lo and hi, where the value's sign changes: Newton's steps where they stay inside, else halving.
template <class Real>
Real root_between(const Polynomial<Real>& polynomial, const Polynomial<Real>& derivative, Real lo, Real hi, bool rises,
                  int bits) {
  using std::abs;
  using std::ldexp;
  const Real least = ldexp(Real(1), -bits);
  Real t = (lo + hi) / Real(2), previous_step = hi - lo;
  for (int i = 0; i < 2 * bits && hi - lo > least; ++i) {
    const Real value = polynomial.value_at(t), slope = derivative.value_at(t);
    if (value == Real(0)) return t;
    ((value < Real(0)) == rises ? lo : hi) = t;
    const Real newton = slope == Real(0) ? hi - lo : -value / slope;
    if (abs(newton) <= least) return t + newton;
    const bool is_good = lo < t + newton && t + newton < hi && abs(newton) * Real(2) <= previous_step;
    Real next = is_good ? t + newton : (lo + hi) / Real(2);
    previous_step = abs(next - t);
    if (previous_step <= least) return next;
    t = next;
  }
  return t;
}

// The roots in [-1, 1], and its derivatives' roots there (a double root shows as one of these). Roots of the
// derivative separate the roots, so each lies in an interval at whose ends the signs differ.
template <class Real>
Roots<Real> roots_of(const Polynomial<Real>& polynomial, int bits) {
  Roots<Real> roots;
  if (polynomial.degree < 1) return roots;
  const Polynomial<Real> derivative = polynomial.derivative();
  roots = roots_of(derivative, bits);
  Roots<Real> ends = roots;
  ends.add(Real(-1));
  ends.add(Real(1));
  std::sort(ends.at.data(), ends.at.data() + ends.count);
  for (std::size_t i = 0; i + 1 < ends.count; ++i) {
    const Real &lo = ends.begin()[i], &hi = ends.begin()[i + 1];
    const bool rises = polynomial.value_at(lo) < Real(0);
    if (rises != (polynomial.value_at(hi) < Real(0)))
      roots.add(root_between(polynomial, derivative, lo, hi, rises, bits));
  }
  return roots;
}

}  // namespace clusterbench::geom
