#pragma once
// The page around a map: its heading above, the meaning of its colours below.

#include <string>
#include <vector>

#include "pictures/canvas.h"
#include "pictures/scale.h"

namespace clusterbench::pictures {

// A map in the figure's palette, row by row.
struct Panel {
  Vec2i size{0, 0};
  std::vector<Colour> colours;
  std::string caption;  // below it; "": none
};

struct Swatch {
  std::vector<Colour> colours;  // side by side
  std::string label;
};

struct Figure {
  std::vector<Rgb> palette;  // begins with basic_palette()
  std::string title;
  std::vector<std::string> lines;  // below the title
  std::vector<Panel> panels;       // all of one size
  int columns = 1;

  // The legend: a bar with ticks, or a square of two counts, and swatches.
  std::string bar_label;
  std::vector<Colour> bar;
  std::vector<Tick> ticks;
  std::vector<Colour> square;  // row by row from the top, as many rows as columns; empty: there is no square
  std::string square_right, square_up;
  std::vector<Swatch> swatches;

  std::vector<std::string> notes;  // numbers below the legend
};

// Small panels are enlarged by a whole factor, so that text has room.
Canvas drawn(const Figure& figure);

}  // namespace clusterbench::pictures
