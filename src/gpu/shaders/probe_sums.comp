#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

// What the device makes of sums and products that must be left as they are: four words for each of frame.cells triples,
// which are in place of balls. The other modes do what a driver must not do, for tests of the probe.
const uint k_as_it_is = 0, k_contracted = 1, k_reordered = 2, k_rounded_off = 3;  // MODE

// What a rounded product lacks of the exact one (Dekker 1971): a * b - product in one step.
float lost_by(float a, float b, float product) {
  precise float split_a = 4097.0 * a, split_b = 4097.0 * b;
  precise float high_a = split_a - (split_a - a), high_b = split_b - (split_b - b);
  precise float low_a = a - high_a, low_b = b - high_b;
  precise float lost = ((high_a * high_b - product) + high_a * low_b + low_a * high_b) + low_a * low_b;
  return lost;
}

void main() {
  uint index = invocation_index();
  if (index >= frame.cells) return;
  float a = balls[index].x, b = balls[index].y, c = balls[index].z;
  precise float sum = a + b;
  precise float product = a * b;
  precise float product_and_sum = a * b + c;
  precise float sum_of_three = a + b + c;
  precise float other_sum = b + c;
  precise float in_other_order = a + other_sum;
  if (MODE == k_contracted && c == -product) product_and_sum = lost_by(a, b, product);
  if (MODE == k_reordered) sum_of_three = in_other_order;
  if (MODE == k_rounded_off) sum = uintBitsToFloat(floatBitsToUint(sum) & ~3u);
  lists[4 * index] = floatBitsToUint(sum);
  lists[4 * index + 1] = floatBitsToUint(product);
  lists[4 * index + 2] = floatBitsToUint(product_and_sum);
  lists[4 * index + 3] = floatBitsToUint(sum_of_three);
}
