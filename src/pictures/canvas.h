#pragma once
// A picture with a palette, and functions that draw boxes and text on it.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::pictures {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;

  friend bool operator==(const Rgb&, const Rgb&) = default;
};

using Colour = std::uint8_t;  // index in the palette

// Left, top, width and height, in pixels from the top left.
struct Box {
  int left = 0, top = 0, width = 0, height = 0;

  int right() const { return left + width; }
  int bottom() const { return top + height; }
};

struct Canvas {
  Vec2i size{0, 0};
  std::vector<Rgb> palette;    // at most 256
  std::vector<Colour> pixels;  // row by row

  Canvas(Vec2i of_size, std::vector<Rgb> colours);

  // Both clip at the canvas.
  void fill(const Box& box, Colour colour);
  void set(int x, int y, Colour colour);
};

enum class Font : std::uint8_t { text, title };
int line_height(Font font);
int text_width(std::string_view text, Font font);
// `at`: the upper left corner. Characters beyond ASCII are shown as '?'.
void draw_text(Canvas& canvas, Vec2i at, std::string_view text, Font font, Colour colour);
// The text in lines no wider than that, broken at blanks; a longer word is cut.
std::vector<std::string> wrapped(std::string_view text, Font font, int width);

}  // namespace clusterbench::pictures
