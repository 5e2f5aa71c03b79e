#include "result/rounding.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace clusterbench::result {
namespace {

double to_digits(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

}  // namespace

double counted(double value) {
  return std::floor(value) == value ? value : to_digits(value, 9);
}

double measured(double value) {
  return to_digits(value, 6);
}

}  // namespace clusterbench::result
