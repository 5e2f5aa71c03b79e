// An engine's matrices as a view.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "library/assign.h"

namespace clusterbench::library {
namespace {

// at(row, column) of the matrix M of p' = M p.
class Matrix {
 public:
  template <class Number>
  Matrix(const Number* numbers, Conventions::Order order) {
    for (int i = 0; i < 16; ++i) {
      const int column = order == Conventions::Order::columns ? i / 4 : i % 4;
      const int row = order == Conventions::Order::columns ? i % 4 : i / 4;
      at_[row][column] = static_cast<double>(numbers[i]);
    }
  }
  double at(int row, int column) const { return at_[row][column]; }
  bool is_finite() const {
    for (const auto& row : at_)
      if (!std::all_of(row.begin(), row.end(), [](double number) { return std::isfinite(number); })) return false;
    return true;
  }
  void divide_by(double divisor) {
    for (auto& row : at_)
      for (double& number : row) number /= divisor;
  }

 private:
  std::array<std::array<double, 4>, 4> at_{};
};

// By how much the first three rows differ from unit and orthogonal ones.
double distance_from_rotation(const Matrix& m) {
  double most = 0.0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      double dot = 0.0;
      for (int i = 0; i < 3; ++i) dot += m.at(a, i) * m.at(b, i);
      most = std::max(most, std::abs(dot - (a == b ? 1.0 : 0.0)));
    }
  return most;
}

const char* fault_of_view_matrix(const Matrix& m) {
  constexpr double k_rigid = 1e-3;  // single-precision matrices after many rotations are within
  if (!m.is_finite()) return "world_to_view: has a number that is not finite";
  if (std::abs(m.at(3, 0)) + std::abs(m.at(3, 1)) + std::abs(m.at(3, 2)) > 1e-6 || std::abs(m.at(3, 3) - 1.0) > 1e-6)
    return "world_to_view: its last row is not (0, 0, 0, 1), as if the other Conventions::order were meant";
  if (distance_from_rotation(m) > k_rigid)
    return "world_to_view: is no rotation with a translation; allowed are unit, orthogonal axes, up to 1e-3";
  return nullptr;
}

// The point that the matrix moves to 0, by Cramer's rule.
void set_eye(const Matrix& m, double (&eye)[3]) {
  const auto minor = [&m](int row, int column) {
    const int r0 = (row + 1) % 3, r1 = (row + 2) % 3, c0 = (column + 1) % 3, c1 = (column + 2) % 3;
    return m.at(r0, c0) * m.at(r1, c1) - m.at(r0, c1) * m.at(r1, c0);
  };
  const double volume = m.at(0, 0) * minor(0, 0) + m.at(0, 1) * minor(0, 1) + m.at(0, 2) * minor(0, 2);
  for (int column = 0; column < 3; ++column) {
    double sum = 0.0;
    for (int row = 0; row < 3; ++row) sum += minor(row, column) * m.at(row, 3);
    eye[column] = -sum / volume;
  }
}

void set_pose(const Matrix& m, double forward, View& out) {
  for (int i = 0; i < 3; ++i) {
    out.to_right[i] = m.at(0, i);
    out.to_top[i] = m.at(1, i);
    out.forward[i] = forward * m.at(2, i);
  }
  set_eye(m, out.eye);
}

const char* fault_of_projection(const Matrix& m, double forward, bool is_orthographic) {
  const double w = is_orthographic ? m.at(3, 3) : m.at(3, 2);
  if (w == 0.0) return "projection: its last row is 0, so it projects nothing";
  const double others = std::abs(m.at(3, 0)) + std::abs(m.at(3, 1)) + (is_orthographic ? 0.0 : std::abs(m.at(3, 3)));
  if (others > 1e-6 || std::abs(std::abs(w) - 1.0) > 1e-6)
    return "projection: its last row is none of (0, 0, 1, 0), (0, 0, -1, 0) and (0, 0, 0, 1), as if the other "
           "Conventions::order were meant";
  if (!is_orthographic && w * forward < 0.0)
    return "projection: is that of a camera that looks the other way along z; see Conventions::looks_along_positive_z";
  const double skew = std::abs(m.at(0, 1)) + std::abs(m.at(1, 0)) + std::abs(m.at(2, 0)) + std::abs(m.at(2, 1));
  if (m.at(0, 0) == 0.0 || m.at(1, 1) == 0.0 || skew > 1e-6 * std::abs(m.at(0, 0)))
    return "projection: is singular or skewed; allowed are perspective and orthographic ones";
  return nullptr;
}

struct ClipEnds {
  double near, far;
};

ClipEnds clip_ends(Conventions::Depth depth) {
  if (depth == Conventions::Depth::minus_one_to_one) return {-1.0, 1.0};
  return depth == Conventions::Depth::one_to_zero ? ClipEnds{1.0, 0.0} : ClipEnds{0.0, 1.0};
}

double depth_at(const Matrix& m, double forward, bool is_orthographic, double clip) {
  constexpr double k_infinite = 1e12;  // rounding may leave an infinite far plane there, or behind the eye
  const double slope = forward * m.at(2, 2), shift = m.at(2, 3);
  if (is_orthographic) return (clip - shift) / slope;
  const double depth = shift / (clip - slope);
  return depth >= 0.0 && depth <= k_infinite ? depth : std::numeric_limits<double>::infinity();
}

// Of the slope x / depth (perspective), or of metres, at clip -1 and 1.
ClipEnds picture_ends(const Matrix& m, int axis, double forward, bool is_orthographic, double sign) {
  const double scale = sign * m.at(axis, axis);
  const double shift = sign * (is_orthographic ? m.at(axis, 3) : forward * m.at(axis, 2));
  return {(-1.0 - shift) / scale, (1.0 - shift) / scale};
}

const char* set_projection(Matrix m, const Conventions& conventions, double forward, View& out) {
  if (!m.is_finite()) return "projection: has a number that is not finite";
  out.is_orthographic = std::abs(m.at(3, 2)) < 1e-9 && m.at(3, 3) != 0.0;
  if (const char* fault = fault_of_projection(m, forward, out.is_orthographic)) return fault;
  m.divide_by(out.is_orthographic ? m.at(3, 3) : std::abs(m.at(3, 2)));
  const ClipEnds x = picture_ends(m, 0, forward, out.is_orthographic, 1.0);
  const ClipEnds y = picture_ends(m, 1, forward, out.is_orthographic, conventions.is_clip_y_down ? -1.0 : 1.0);
  if (!(x.near < x.far)) return "projection: mirrors the picture; number (0, 0) must be above 0";
  if (!(y.near < y.far)) return "projection: turns the picture upside down; see Conventions::is_clip_y_down";
  out.left = x.near, out.right = x.far, out.bottom = y.near, out.top = y.far;
  const ClipEnds clip = clip_ends(conventions.depth);
  out.near_m = depth_at(m, forward, out.is_orthographic, clip.near);
  out.far_m = depth_at(m, forward, out.is_orthographic, clip.far);
  if (!out.is_orthographic && out.near_m == 0.0)
    return "projection: has its near plane at the eye; the last number of its third row must not be 0";
  if (out.near_m < out.far_m) return nullptr;
  return "projection: its near plane is beyond its far plane, as if another Conventions::depth were meant";
}

const char* fault_of_conventions(const Conventions& conventions) {
  using Order = Conventions::Order;
  using Depth = Conventions::Depth;
  if (conventions.order != Order::columns && conventions.order != Order::rows)
    return "conventions.order: is none; allowed: columns, rows";
  const Depth depth = conventions.depth;
  if (depth != Depth::zero_to_one && depth != Depth::one_to_zero && depth != Depth::minus_one_to_one)
    return "conventions.depth: is none; allowed: zero_to_one, one_to_zero, minus_one_to_one";
  return nullptr;
}

template <class Number>
const char* set_all(View& view, const Number* world_to_view, const Number* projection, const Conventions& conventions) {
  if (world_to_view == nullptr) return "world_to_view: is null; allowed: 16 numbers";
  if (projection == nullptr) return "projection: is null; allowed: 16 numbers";
  if (const char* fault = fault_of_conventions(conventions)) return fault;
  const Matrix pose(world_to_view, conventions.order);
  if (const char* fault = fault_of_view_matrix(pose)) return fault;
  const double forward = conventions.looks_along_positive_z ? 1.0 : -1.0;
  View out = view;
  set_pose(pose, forward, out);
  const char* fault = set_projection(Matrix(projection, conventions.order), conventions, forward, out);
  if (fault == nullptr) view = out;
  return fault;
}

}  // namespace

const char* View::set_matrices(const double* world_to_view, const double* projection,
                               const Conventions& conventions) noexcept {
  return set_all(*this, world_to_view, projection, conventions);
}

const char* View::set_matrices(const float* world_to_view, const float* projection,
                               const Conventions& conventions) noexcept {
  return set_all(*this, world_to_view, projection, conventions);
}

}  // namespace clusterbench::library
