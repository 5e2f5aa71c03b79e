#include "pictures/figure.h"

#include <algorithm>
#include <cmath>

#include "core/memory.h"
#include "pictures/colours.h"

namespace clusterbench::pictures {
namespace {

constexpr int k_margin = 14, k_gap = 10, k_least_width = 640;
constexpr int k_bar_height = 16, k_tick = 4, k_swatch = 14, k_square = 84;

// Positions: down the page, in one column as wide as the panels.
class Layout {
 public:
  explicit Layout(const Figure& figure) : figure_(figure) {
    const Vec2i panel = figure.panels.front().size;
    columns_ = std::min(figure.columns, static_cast<int>(figure.panels.size()));
    const int wanted = (k_least_width - (columns_ - 1) * k_gap) / columns_;
    factor_ = std::max(1, (wanted + panel.x - 1) / panel.x);
    inner_ = columns_ * panel.x * factor_ + (columns_ - 1) * k_gap;
  }

  Canvas draw() {
    place(nullptr);
    check_memory("pixels of a picture",
                 static_cast<std::uint64_t>(inner_ + 2 * k_margin) * static_cast<std::uint64_t>(y_), sizeof(Colour),
                 "ask for a larger --image-divisor");
    Canvas canvas({inner_ + 2 * k_margin, y_}, figure_.palette);
    place(&canvas);
    return canvas;
  }

 private:
  // Without a canvas only to find its height.
  void place(Canvas* canvas) {
    canvas_ = canvas;
    y_ = k_margin;
    add_text(figure_.title, k_ink, 0, Font::title);
    for (const std::string& line : figure_.lines) add_text(line, k_faint);
    y_ += k_gap / 2;
    add_panels();
    if (!figure_.bar.empty()) add_bar();
    const int top = y_, left = figure_.square.empty() ? 0 : add_square();
    const int below_square = y_;
    y_ = top;
    for (const std::string& line : {figure_.square_up, figure_.square_right}) add_text(line, k_ink, left);
    add_swatches(left);
    for (const std::string& note : figure_.notes) add_text(note, k_ink, left);
    y_ = std::max(y_, below_square) + k_margin - 2;
  }

  void text(int x, int y, const std::string& words, Font font, Colour colour) {
    if (canvas_ != nullptr) draw_text(*canvas_, {x, y}, words, font, colour);
  }
  void box(const Box& where, Colour colour) {
    if (canvas_ != nullptr) canvas_->fill(where, colour);
  }

  // `left`: from the column's left side.
  void add_text(const std::string& words, Colour colour, int left = 0, Font font = Font::text) {
    for (const std::string& line : wrapped(words, font, inner_ - left)) {
      text(k_margin + left, y_, line, font, colour);
      y_ += line_height(font);
    }
  }

  void add_panels() {
    const Vec2i size = figure_.panels.front().size * factor_;
    for (std::size_t first = 0; first < figure_.panels.size(); first += static_cast<std::size_t>(columns_)) {
      bool has_captions = false;
      for (int column = 0; column < columns_; ++column) {
        const std::size_t index = first + static_cast<std::size_t>(column);
        if (index >= figure_.panels.size()) break;
        const Panel& panel = figure_.panels[index];
        const int left = k_margin + column * (size.x + k_gap);
        draw_panel(panel, left, y_);
        text(left, y_ + size.y + 2, panel.caption, Font::text, k_ink);
        has_captions |= !panel.caption.empty();
      }
      y_ += size.y + (has_captions ? line_height(Font::text) + 2 : 0) + k_gap;
    }
  }

  void draw_panel(const Panel& panel, int left, int top) {
    if (canvas_ == nullptr) return;
    for (int y = 0; y < panel.size.y * factor_; ++y)
      for (int x = 0; x < panel.size.x * factor_; ++x)
        canvas_->set(left + x, top + y,
                     panel.colours[static_cast<std::size_t>(y / factor_) * static_cast<std::size_t>(panel.size.x) +
                                   static_cast<std::size_t>(x / factor_)]);
  }

  void add_bar() {
    add_text(figure_.bar_label, k_ink);
    const auto colours = static_cast<int>(figure_.bar.size());
    for (int i = 0; i < colours; ++i) {
      const int from = inner_ * i / colours, to = inner_ * (i + 1) / colours;
      box({k_margin + from, y_, to - from, k_bar_height}, figure_.bar[static_cast<std::size_t>(i)]);
    }
    y_ += k_bar_height;
    int free_from = -1;
    for (const Tick& tick : figure_.ticks) {
      const int x = static_cast<int>(std::lround(tick.at * (inner_ - 1)));
      const int width = text_width(tick.label, Font::text), left = std::clamp(x - width / 2, 0, inner_ - width);
      const bool is_last = &tick == &figure_.ticks.back();
      const int last_width = text_width(figure_.ticks.back().label, Font::text);
      if (left <= free_from || (!is_last && left + width + 7 > inner_ - last_width)) continue;
      box({k_margin + x, y_, 1, k_tick}, k_ink);
      text(k_margin + left, y_ + k_tick + 1, tick.label, Font::text, k_ink);
      free_from = left + width + 7;
    }
    y_ += k_tick + line_height(Font::text) + k_gap / 2;
  }

  // Returns the left side of the free room beside it.
  int add_square() {
    int side = 1;
    while (static_cast<std::size_t>(side) * static_cast<std::size_t>(side) < figure_.square.size()) ++side;
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const int left = k_square * column / side, right = k_square * (column + 1) / side;
        const int top = k_square * row / side, bottom = k_square * (row + 1) / side;
        box({k_margin + left, y_ + top, right - left, bottom - top},
            figure_.square[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
                           static_cast<std::size_t>(column)]);
      }
    y_ += k_square;
    return k_square + k_gap;
  }

  void add_swatches(int left) {
    int x = k_margin + left;
    for (const Swatch& swatch : figure_.swatches) {
      const int wide = k_swatch * std::min(4, static_cast<int>(swatch.colours.size()));
      const int width = wide + 6 + text_width(swatch.label, Font::text);
      if (x > k_margin + left && x + width > k_margin + inner_) {
        x = k_margin + left;
        y_ += k_swatch + 6;
      }
      const auto count = static_cast<int>(swatch.colours.size());
      for (int i = 0; i < count; ++i)
        box({x + wide * i / count, y_, wide * (i + 1) / count - wide * i / count, k_swatch},
            swatch.colours[static_cast<std::size_t>(i)]);
      text(x + wide + 6, y_ + 1, swatch.label, Font::text, k_ink);
      x += width + 22;
    }
    if (!figure_.swatches.empty()) y_ += k_swatch + 6;
  }

  const Figure& figure_;
  int columns_ = 1, factor_ = 1, inner_ = 0, y_ = 0;
  Canvas* canvas_ = nullptr;
};

}  // namespace

Canvas drawn(const Figure& figure) {
  return Layout(figure).draw();
}

}  // namespace clusterbench::pictures
