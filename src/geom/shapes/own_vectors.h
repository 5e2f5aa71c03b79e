#pragma once
// The part of GLM that the library for engines needs, where it is built without GLM (vec.h). Operations round as GLM's
// do, in the same order.

#include <cmath>
#include <cstdlib>
#include <type_traits>

namespace clusterbench::own_vectors {

template <class T, int size>
struct Components;
template <class T>
struct Components<T, 2> {
  T x, y;

  constexpr T& at(int i) { return i == 0 ? x : y; }
  constexpr const T& at(int i) const { return i == 0 ? x : y; }
};
template <class T>
struct Components<T, 3> {
  T x, y, z;

  constexpr T& at(int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr const T& at(int i) const { return i == 0 ? x : i == 1 ? y : z; }
};
template <class T>
struct Components<T, 4> {
  T x, y, z, w;

  constexpr T& at(int i) { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
  constexpr const T& at(int i) const { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
};

template <class T, int size>
struct Vec : Components<T, size> {
  Vec() = default;  // without values, as numbers are
  constexpr explicit Vec(T all) {
    for (int i = 0; i < size; ++i) this->at(i) = all;
  }
  template <class... Numbers>
  requires(sizeof...(Numbers) == static_cast<std::size_t>(size) &&
           (std::is_arithmetic_v<Numbers> && ...)) constexpr Vec(Numbers... numbers)
      : Components<T, size>{static_cast<T>(numbers)...} {}
  template <class Other>
  requires(!std::is_same_v<T, Other>) constexpr Vec(const Vec<Other, size>& other) {
    for (int i = 0; i < size; ++i) this->at(i) = static_cast<T>(other[i]);
  }

  template <class Index>
  constexpr T& operator[](Index i) {
    return this->at(static_cast<int>(i));
  }
  template <class Index>
  constexpr const T& operator[](Index i) const {
    return this->at(static_cast<int>(i));
  }

  template <class Operation>
  friend constexpr Vec each(const Vec& a, const Vec& b, Operation operation) {
    Vec out;
    for (int i = 0; i < size; ++i) out[i] = operation(a[i], b[i]);
    return out;
  }
  friend constexpr Vec operator+(const Vec& a, const Vec& b) {
    return each(a, b, [](T x, T y) { return x + y; });
  }
  friend constexpr Vec operator-(const Vec& a, const Vec& b) {
    return each(a, b, [](T x, T y) { return x - y; });
  }
  friend constexpr Vec operator*(const Vec& a, const Vec& b) {
    return each(a, b, [](T x, T y) { return x * y; });
  }
  friend constexpr Vec operator/(const Vec& a, const Vec& b) {
    return each(a, b, [](T x, T y) { return x / y; });
  }
  friend constexpr Vec operator+(const Vec& a, T b) { return a + Vec(b); }
  friend constexpr Vec operator-(const Vec& a, T b) { return a - Vec(b); }
  friend constexpr Vec operator*(const Vec& a, T b) { return a * Vec(b); }
  friend constexpr Vec operator*(T a, const Vec& b) { return Vec(a) * b; }
  friend constexpr Vec operator/(const Vec& a, T b) { return a / Vec(b); }
  constexpr Vec operator-() const {
    Vec out;
    for (int i = 0; i < size; ++i) out[i] = -(*this)[i];
    return out;
  }
  template <class Other>
  constexpr Vec& operator+=(const Other& other) {
    return *this = *this + other;
  }
  template <class Other>
  constexpr Vec& operator-=(const Other& other) {
    return *this = *this - other;
  }
  template <class Other>
  constexpr Vec& operator*=(const Other& other) {
    return *this = *this * other;
  }
  template <class Other>
  constexpr Vec& operator/=(const Other& other) {
    return *this = *this / other;
  }
  friend constexpr bool operator==(const Vec& a, const Vec& b) {
    for (int i = 0; i < size; ++i)
      if (!(a[i] == b[i])) return false;
    return true;
  }
};

template <class T, int size>
constexpr T dot(const Vec<T, size>& a, const Vec<T, size>& b) {
  const Vec<T, size> products = a * b;
  T sum = products[0];
  for (int i = 1; i < size; ++i) sum += products[i];
  return sum;
}
template <class T, int size>
T length(const Vec<T, size>& v) {
  return std::sqrt(dot(v, v));
}
template <class T, int size>
Vec<T, size> normalize(const Vec<T, size>& v) {
  return v * (T(1) / std::sqrt(dot(v, v)));
}
template <class T>
constexpr Vec<T, 3> cross(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
template <class T, int size>
Vec<T, size> abs(const Vec<T, size>& v) {
  return each(v, v, [](T x, T) { return std::abs(x); });
}
template <class T, int size>
constexpr Vec<T, size> min(const Vec<T, size>& a, const Vec<T, size>& b) {
  return each(a, b, [](T x, T y) { return y < x ? y : x; });
}
template <class T, int size>
constexpr Vec<T, size> max(const Vec<T, size>& a, const Vec<T, size>& b) {
  return each(a, b, [](T x, T y) { return x < y ? y : x; });
}
template <class T, int size>
constexpr Vec<T, size> mix(const Vec<T, size>& a, const Vec<T, size>& b, T share) {
  return a * (T(1) - share) + b * share;
}

// By columns.
template <class T, int size>
struct Mat {
  using Column = Vec<T, size>;

  Mat() = default;
  constexpr explicit Mat(T diagonal) {
    for (int c = 0; c < size; ++c) {
      columns[c] = Column(T(0));
      columns[c][c] = diagonal;
    }
  }
  template <class... Columns>
  requires(sizeof...(Columns) == static_cast<std::size_t>(size) &&
           (std::is_convertible_v<Columns, Column> && ...)) constexpr Mat(const Columns&... given)
      : columns{given...} {}

  template <class Index>
  constexpr Column& operator[](Index c) {
    return columns[static_cast<int>(c)];
  }
  template <class Index>
  constexpr const Column& operator[](Index c) const {
    return columns[static_cast<int>(c)];
  }
  friend constexpr Column operator*(const Mat& m, const Column& v) {
    Column out;
    for (int row = 0; row < size; ++row) {
      out[row] = m[0][row] * v[0];
      for (int c = 1; c < size; ++c) out[row] += m[c][row] * v[c];
    }
    return out;
  }
  friend constexpr bool operator==(const Mat& a, const Mat& b) {
    for (int c = 0; c < size; ++c)
      if (!(a[c] == b[c])) return false;
    return true;
  }

  Column columns[size];
};

}  // namespace clusterbench::own_vectors
