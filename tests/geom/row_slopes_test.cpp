#include "geom/projection/row_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"

namespace clusterbench::geom {
namespace {

// A disk whose rim goes through the eye but for a few unit roundoffs of its radius.
struct Disk {
  double u, w, squared_radius;
  double near, far;
};

Disk disk_at_the_eye(SplitMix64& random, double epsilon) {
  const double angle = random.between(-M_PI, M_PI), distance = std::exp2(random.between(-10, 30));
  Disk disk;
  disk.u = static_cast<float>(distance * std::sin(angle));
  disk.w = static_cast<float>(distance * std::cos(angle));
  const double roundoffs = std::round(random.between(-20, 20));
  disk.squared_radius = (disk.u * disk.u + disk.w * disk.w) * (1.0 + roundoffs * epsilon);
  disk.near = random.below(2) == 0 ? 0.0 : distance * std::exp2(random.between(-36, -2));
  disk.far = disk.near + distance * std::exp2(random.between(-36, 2));
  return disk;
}

template <class Real>
SlopeHull<Real> slopes(const Disk& disk, Real squared_radius, Errs errs) {
  SlopeHull<Real> hull;
  add_disk<Real>(hull, static_cast<Real>(disk.u), static_cast<Real>(disk.w), squared_radius,
                 static_cast<Real>(disk.near), static_cast<Real>(disk.far), Real(1), errs);
  return hull;
}

// A few hundred roundoffs lie between the disk that is asked for and the one that must lie within the answer (or hold
// it); these are found with far more digits.
template <class Real>
void expect_to_err_as_asked(std::uint64_t seed, int tries) {
  constexpr Real k_epsilon = std::numeric_limits<Real>::epsilon();
  constexpr long double k_gap = 200.0L * k_epsilon;
  SplitMix64 random(seed);
  for (int i = 0; i < tries; ++i) {
    Disk disk = disk_at_the_eye(random, k_epsilon);
    disk.near = static_cast<Real>(disk.near);
    disk.far = static_cast<Real>(disk.far);
    const auto square = static_cast<Real>(disk.squared_radius);
    const SlopeHull<long double> least = slopes<long double>(disk, square * (1.0L - k_gap), Errs::inward);
    const SlopeHull<long double> most = slopes<long double>(disk, square * (1.0L + k_gap), Errs::outward);
    const SlopeHull<Real> outer = slopes<Real>(disk, square, Errs::outward);
    const SlopeHull<Real> inner = slopes<Real>(disk, square, Errs::inward);
    SCOPED_TRACE(::testing::Message() << "try " << i << " u " << disk.u << " w " << disk.w << " r^2 " << square
                                      << " depths " << disk.near << ".." << disk.far);
    ASSERT_LE(outer.lo, least.lo);
    ASSERT_GE(outer.hi, least.hi);
    ASSERT_GE(inner.lo, most.lo);
    ASSERT_LE(inner.hi, most.hi);
  }
}

TEST(RowSlopes, of_a_disk_whose_rim_goes_through_the_eye_err_only_as_asked_in_double_precision) {
  expect_to_err_as_asked<double>(1, 200000);
}

TEST(RowSlopes, of_a_disk_whose_rim_goes_through_the_eye_err_only_as_asked_in_single_precision) {
  expect_to_err_as_asked<float>(2, 200000);
}

}  // namespace
}  // namespace clusterbench::geom
