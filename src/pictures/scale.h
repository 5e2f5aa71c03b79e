#pragma once
// Counts to colours, and the legend's ticks.

#include <cstdint>
#include <string>
#include <vector>

#include "pictures/canvas.h"

namespace clusterbench::pictures {

// "1,234,567".
std::string grouped(std::uint64_t number);
// About three significant digits: "12.3", "0.0123", "1,234".
std::string short_number(double number);
// "12.3 %" of a share.
std::string percent(double part, double whole);

// A round number for the end of a scale, not below the largest count; small counts unchanged.
std::uint32_t scale_top(std::uint32_t largest);

struct Tick {
  double at = 0.0;  // share of the bar's length
  std::string label;
};

// Whole numbers from `least` to `top`: each has its own colour if there are few, else they are spread evenly over the
// colours. Numbers beyond the top get the top's colour.
class CountScale {
 public:
  // Its colours are appended to the palette.
  CountScale(std::uint32_t least, std::uint32_t top, Rgb (*colour)(double share), std::vector<Rgb>& palette);

  Colour colour_of(std::uint32_t count) const;
  std::uint32_t top() const { return top_; }
  // From the least to the top, equally wide.
  std::vector<Colour> bar() const;
  // `goes_beyond`: there are counts above the top.
  std::vector<Tick> ticks(bool goes_beyond) const;

 private:
  bool has_each() const { return top_ - least_ < colours_; }

  std::uint32_t least_, top_, colours_ = 0;
  Colour first_;
};

// Depths from near to far, evenly in their logarithm.
std::vector<Tick> depth_ticks(double nearest_m, double farthest_m);

}  // namespace clusterbench::pictures
