#include "pictures/scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace clusterbench::pictures {
namespace {

constexpr std::uint32_t k_most_colours = 160;
constexpr std::uint32_t k_most_ticks = 11;

// 1, 2 or 5 times a power of ten, so that at most k_most_ticks fit into the span.
std::uint32_t tick_step(std::uint32_t span) {
  for (std::uint64_t power = 1;; power *= 10)
    for (const std::uint64_t digit : {1, 2, 5})
      if (span / (digit * power) < k_most_ticks) return static_cast<std::uint32_t>(digit * power);
}

}  // namespace

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string short_number(double number) {
  if (number >= 999.5) return grouped(static_cast<std::uint64_t>(std::llround(number)));
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return text;
}

std::string percent(double part, double whole) {
  return short_number(whole > 0.0 ? 100.0 * part / whole : 0.0) + " %";
}

std::uint32_t scale_top(std::uint32_t largest) {
  constexpr std::uint32_t k_unrounded = 20;
  if (largest <= k_unrounded) return std::max(1u, largest);
  for (std::uint64_t power = 10;; power *= 10)
    for (const std::uint64_t tenths : {10, 12, 15, 20, 25, 30, 40, 50, 60, 80})
      if (tenths * power / 10 >= largest)
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(tenths * power / 10, UINT32_MAX));
}

CountScale::CountScale(std::uint32_t least, std::uint32_t top, Rgb (*colour)(double share), std::vector<Rgb>& palette)
    : least_(least), top_(std::max(least, top)), first_(static_cast<Colour>(palette.size())) {
  colours_ = std::min(top_ - least_, k_most_colours - 1) + 1;
  for (std::uint32_t i = 0; i < colours_; ++i)
    palette.push_back(colour(colours_ == 1 ? 1.0 : static_cast<double>(i) / (colours_ - 1)));
}

Colour CountScale::colour_of(std::uint32_t count) const {
  const std::uint64_t above = std::clamp(count, least_, top_) - least_, span = top_ - least_;
  const std::uint64_t at = has_each() ? above : (above * (colours_ - 1) + span / 2) / span;
  return static_cast<Colour>(first_ + at);
}

std::vector<Colour> CountScale::bar() const {
  std::vector<Colour> out;
  for (std::uint32_t i = 0; i < colours_; ++i) out.push_back(static_cast<Colour>(first_ + i));
  return out;
}

std::vector<Tick> CountScale::ticks(bool goes_beyond) const {
  const std::uint32_t span = top_ - least_, step = tick_step(span);
  std::vector<Tick> out;
  const auto add = [&](std::uint32_t count) {
    const double above = count - least_;
    out.push_back({has_each() ? (above + 0.5) / (span + 1.0) : above / span, grouped(count)});
  };
  add(least_);
  for (std::uint64_t count = (least_ / step + 1) * std::uint64_t{step}; count < top_; count += step)
    if (2 * (top_ - count) > step) add(static_cast<std::uint32_t>(count));  // not too close to the last one
  if (span > 0) add(top_);
  if (goes_beyond) out.back().label += "+";
  return out;
}

std::vector<Tick> depth_ticks(double nearest_m, double farthest_m) {
  std::vector<Tick> out;
  if (!(farthest_m > nearest_m) || !(nearest_m > 0.0)) return {{0.5, short_number(nearest_m) + " m"}};
  const double span = std::log2(farthest_m / nearest_m);
  for (int exponent = -15; exponent <= 15; ++exponent)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double depth = digit * std::pow(10.0, exponent);
      if (depth < nearest_m || depth > farthest_m) continue;
      out.push_back({std::log2(depth / nearest_m) / span, short_number(depth) + " m"});
    }
  return out;
}

}  // namespace clusterbench::pictures
