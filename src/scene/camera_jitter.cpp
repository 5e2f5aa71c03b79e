#include "scene/camera_jitter.h"

namespace clusterbench::scene {
namespace {

// Radical inverse: the digits of `index` in a base, mirrored at the point: 6 is 110 in base 2, so 0.011.
double mirrored_digits(int index, int base) {
  double value = 0.0;
  for (double digit = 1.0 / base; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

}  // namespace

std::vector<Vec2d> halton_jitter(int count) {
  std::vector<Vec2d> offsets;
  for (int i = 1; i <= count; ++i) offsets.emplace_back(mirrored_digits(i, 2) - 0.5, mirrored_digits(i, 3) - 0.5);
  return offsets;
}

}  // namespace clusterbench::scene
