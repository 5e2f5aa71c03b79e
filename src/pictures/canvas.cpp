#include "pictures/canvas.h"

#include <algorithm>

namespace clusterbench::pictures {
namespace {

constexpr int k_first_glyph = 32, k_glyphs = 95;

constexpr std::uint16_t k_text_rows[] = {
#include "pictures/glyphs_7x13.inc"
};
constexpr std::uint16_t k_title_rows[] = {
#include "pictures/glyphs_9x15b.inc"
};

struct FontRows {
  int width, height;
  const std::uint16_t* rows;
};
static_assert(std::size(k_text_rows) == k_glyphs * 13 && std::size(k_title_rows) == k_glyphs * 15);

FontRows rows_of(Font font) {
  return font == Font::text ? FontRows{7, 13, k_text_rows} : FontRows{9, 15, k_title_rows};
}

// One byte per character: UTF-8 continuation bytes are left out.
std::string ascii(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) == 0x80) continue;
    out += byte >= k_first_glyph && byte < k_first_glyph + k_glyphs ? c : '?';
  }
  return out;
}

}  // namespace

Canvas::Canvas(Vec2i of_size, std::vector<Rgb> colours)
    : size(of_size),
      palette(std::move(colours)),
      pixels(static_cast<std::size_t>(of_size.x) * static_cast<std::size_t>(of_size.y), 0) {}

void Canvas::fill(const Box& box, Colour colour) {
  const int left = std::clamp(box.left, 0, size.x), right = std::clamp(box.right(), left, size.x);
  for (int y = std::max(0, box.top); y < std::min(size.y, box.bottom()); ++y)
    std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(y) * size.x + left, right - left, colour);
}

void Canvas::set(int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= size.x || y >= size.y) return;
  pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x)] = colour;
}

int line_height(Font font) {
  return rows_of(font).height + 2;
}

int text_width(std::string_view text, Font font) {
  return static_cast<int>(ascii(text).size()) * rows_of(font).width;
}

void draw_text(Canvas& canvas, Vec2i at, std::string_view text, Font font, Colour colour) {
  const FontRows form = rows_of(font);
  for (const char c : ascii(text)) {
    for (int y = 0; y < form.height; ++y)
      for (int x = 0; x < form.width; ++x)
        if ((form.rows[(c - k_first_glyph) * form.height + y] >> (form.width - 1 - x) & 1) != 0)
          canvas.set(at.x + x, at.y + y, colour);
    at.x += form.width;
  }
}

std::vector<std::string> wrapped(std::string_view text, Font font, int width) {
  const auto most = static_cast<std::size_t>(std::max(1, width / rows_of(font).width));
  std::vector<std::string> lines;
  for (std::string rest = ascii(text); !rest.empty();) {
    std::size_t end = rest.size();
    if (end > most) {
      const std::size_t blank = rest.rfind(' ', most);
      end = blank == std::string::npos || blank == 0 ? most : blank;
    }
    lines.push_back(rest.substr(0, end));
    rest.erase(0, rest.find_first_not_of(' ', end));
  }
  return lines;
}

}  // namespace clusterbench::pictures
