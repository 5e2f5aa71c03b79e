#include "report/cases/percent_change.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

#include "geom/numbers/rational.h"

namespace clusterbench::report {
namespace {

using geom::Rational;

// The shortest decimal that reads as this double, at most 17 digits: the number as written. 2.9 is 29/10.
Rational decimal(double value) {
  char text[64];
  const auto [end, failed] = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific);
  const std::string_view all(text, static_cast<std::size_t>(end - text));
  const std::size_t e = all.find('e');
  std::int64_t number = 0;
  int exponent = 0;
  std::string_view exponent_text = all.substr(e + 1);
  if (exponent_text.starts_with('+')) exponent_text.remove_prefix(1);
  std::from_chars(exponent_text.data(), exponent_text.data() + exponent_text.size(), exponent);
  bool is_negative = false, is_behind_point = false;
  for (const char c : all.substr(0, e)) {
    is_negative = is_negative || c == '-';
    is_behind_point = is_behind_point || c == '.';
    if (c == '-' || c == '.') continue;
    number = 10 * number + (c - '0');
    if (is_behind_point) --exponent;
  }
  Rational power = 1;
  for (int i = 0; i < std::abs(exponent); ++i) power *= 10;
  const Rational size = exponent < 0 ? number / power : number * power;
  return is_negative ? -size : size;
}

Rational exact_value(const Quotient& quotient) {
  return geom::exact(quotient.numerator) / geom::exact(quotient.denominator);
}

// -1, 0 or 1: the change is less than, equal to or more than `percent`.
int compared_change(const Quotient& then, const Quotient& now, double percent) {
  const Rational before = exact_value(then), after = exact_value(now);
  if (before == 0 && after == 0) return percent > 0.0 ? -1 : percent < 0.0 ? 1 : 0;
  return Rational(100 * after - before * (100 + decimal(percent))).sign();
}

// A number with the same position relative to the budget's limits as the exact change: below, at or above.
double stand_in(const config::LimitRule& rule, const Quotient& then, const Quotient& now) {
  constexpr double k_endless = std::numeric_limits<double>::infinity();
  const int at_limit = compared_change(then, now, rule.limit);
  if (at_limit < 0) return std::nextafter(rule.limit, -k_endless);
  if (at_limit == 0) return rule.limit;
  if (rule.side != config::LimitRule::Side::outside) return std::nextafter(rule.limit, k_endless);
  return compared_change(then, now, rule.upper) > 0 ? std::nextafter(rule.upper, k_endless) : rule.upper;
}

}  // namespace

double percent_change(const Quotient& then, const Quotient& now) {
  const double before = then.value(), after = now.value();
  return before == after ? 0.0 : 100.0 * (after - before) / before;
}

std::string percent_text(double percent, double beside) {
  char text[48];
  for (int digits = 3; digits <= 12; ++digits) {
    std::snprintf(text, sizeof text, "%+.*g %%", digits, percent);
    const double read = std::strtod(text, nullptr);
    if ((read < beside) == (percent < beside) && (read > beside) == (percent > beside)) break;
  }
  return text;
}

bool is_broken_by_change(const config::LimitRule& rule, const Quotient& then, const Quotient& now) {
  return rule.is_broken_by(stand_in(rule, then, now));
}

}  // namespace clusterbench::report
