#include "geom/shapes/own_vectors.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/glm.hpp>

#include "core/random.h"

namespace clusterbench::geom {
namespace {

template <class T>
using Own = own_vectors::Vec<T, 3>;

template <class T>
bool have_equal_bits(const Own<T>& own, const glm::vec<3, T>& of_glm) {
  return std::memcmp(&own.x, &of_glm.x, sizeof of_glm) == 0;
}

template <class T>
bool have_equal_bits(T a, T b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class T>
class OwnVectors : public testing::Test {
 protected:
  // Of very different sizes, so that the order of sums decides their last bits.
  void draw() {
    for (int i = 0; i < 3; ++i) {
      a_[i] = of_glm_a_[i] = number();
      b_[i] = of_glm_b_[i] = number();
    }
    factor_ = number();
  }
  T number() {
    return static_cast<T>(std::ldexp(random_.between(-1.0, 1.0), static_cast<int>(random_.below(20)) - 10));
  }

  SplitMix64 random_{7};
  Own<T> a_{}, b_{};
  glm::vec<3, T> of_glm_a_{}, of_glm_b_{};
  T factor_{};
};

using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(OwnVectors, Numbers);

TYPED_TEST(OwnVectors, round_as_GLM_does) {
  static_assert(sizeof(Own<TypeParam>) == sizeof(glm::vec<3, TypeParam>));
  for (int i = 0; i < 20000; ++i) {
    this->draw();
    const Own<TypeParam>&a = this->a_, &b = this->b_;
    const glm::vec<3, TypeParam>&c = this->of_glm_a_, &d = this->of_glm_b_;
    const TypeParam factor = this->factor_;
    ASSERT_TRUE(have_equal_bits(a + b, c + d) && have_equal_bits(a - b, c - d) && have_equal_bits(-a, -c));
    ASSERT_TRUE(have_equal_bits(a * b, c * d) && have_equal_bits(a / b, c / d));
    ASSERT_TRUE(have_equal_bits(a * factor, c * factor) && have_equal_bits(factor * a, factor * c));
    ASSERT_TRUE(have_equal_bits(a / factor, c / factor) && have_equal_bits(a + factor, c + factor));
    ASSERT_TRUE(have_equal_bits(dot(a, b), glm::dot(c, d)) && have_equal_bits(length(a), glm::length(c)));
    ASSERT_TRUE(have_equal_bits(cross(a, b), glm::cross(c, d)));
    ASSERT_TRUE(have_equal_bits(normalize(a), glm::normalize(c)) && have_equal_bits(abs(a), glm::abs(c)));
    ASSERT_TRUE(have_equal_bits(min(a, b), glm::min(c, d)) && have_equal_bits(max(a, b), glm::max(c, d)));
    ASSERT_TRUE(have_equal_bits(mix(a, b, factor), glm::mix(c, d, factor)));
    ASSERT_EQ(a == b, c == d);
    ASSERT_TRUE(a == Own<TypeParam>(a.x, a.y, a.z));
    const own_vectors::Mat<TypeParam, 3> own(a, b, a - b);
    const glm::mat<3, 3, TypeParam> of_glm(c, d, c - d);
    ASSERT_TRUE(have_equal_bits(own * b, of_glm * d) && have_equal_bits(own[2], of_glm[2]));
  }
}

TEST(OwnVector, convert_and_compare) {
  using Vec3i = own_vectors::Vec<int, 3>;
  EXPECT_TRUE(Vec3i(Own<double>(1.9, -1.9, 3.0)) == Vec3i(1, -1, 3));
  EXPECT_FALSE(Vec3i(1, 2, 3) == Vec3i(1, 2, 4));
  EXPECT_TRUE((own_vectors::Mat<double, 3>(2.0) * Own<double>(1.0, 2.0, 3.0) == Own<double>(2.0, 4.0, 6.0)));
  Own<double> sum(1.0);
  sum += Own<double>(1.0, 2.0, 3.0);
  sum *= 2.0;
  EXPECT_TRUE(sum == Own<double>(4.0, 6.0, 8.0));
}

}  // namespace
}  // namespace clusterbench::geom
