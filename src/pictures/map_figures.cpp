#include "pictures/map_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "pictures/colours.h"

namespace clusterbench::pictures {
namespace {

using State = PixelMaps::State;

constexpr int k_shades = 48;

// A colour in light from dark to full, for surfaces.
class Shades {
 public:
  Shades(const Rgb& colour, double most, std::vector<Rgb>& palette, int shades = k_shades)
      : shades_(shades), first_(static_cast<Colour>(palette.size())) {
    constexpr double k_darkest = 0.3;
    for (int i = 0; i < shades; ++i)
      palette.push_back(shaded(colour, most * (k_darkest + (1.0 - k_darkest) * i / (shades - 1))));
  }

  Colour at(float light) const {
    return static_cast<Colour>(first_ + std::lround(light * static_cast<float>(shades_ - 1)));
  }
  Colour middle() const { return at(0.6f); }

 private:
  int shades_;
  Colour first_;
};

// Dark, so that overlays stand out.
constexpr double k_stone_light = 0.72;

Colour without_answer(std::size_t pixel, int width) {
  const auto x = static_cast<int>(pixel % static_cast<std::size_t>(width)),
             y = static_cast<int>(pixel / static_cast<std::size_t>(width));
  return ((x + y) / 3) % 2 == 0 ? k_no_answer_dark : k_no_answer_light;
}

Panel panel_of(Vec2i size, const std::vector<State>& state, const std::function<Colour(std::size_t)>& colour) {
  Panel panel{size, {}, ""};
  panel.colours.reserve(state.size());
  for (std::size_t i = 0; i < state.size(); ++i)
    panel.colours.push_back(state[i] == State::no_surface  ? Colour{k_no_surface}
                            : state[i] == State::no_answer ? without_answer(i, size.x)
                                                           : colour(i));
  return panel;
}

Figure figure_of(const Heading& heading, std::string title) {
  Figure figure;
  figure.palette = basic_palette();
  figure.title = std::move(title) + (heading.method.empty() ? "" : ": " + heading.method);
  figure.lines = {heading.scene_line, heading.grid_line};
  return figure;
}

const std::vector<Colour> k_hatch = {k_no_answer_dark, k_no_answer_light, k_no_answer_dark, k_no_answer_light,
                                     k_no_answer_dark, k_no_answer_light, k_no_answer_dark};

void add_swatches(Figure& figure, std::uint64_t pixels, std::uint64_t surfaces, std::uint64_t unanswered) {
  if (surfaces < pixels) figure.swatches.push_back({{k_no_surface}, "no surface"});
  if (unanswered > 0) figure.swatches.push_back({k_hatch, "no answer: outside of the cells"});
}
void add_swatches(Figure& figure, const PixelMaps& maps) {
  add_swatches(figure, maps.state.size(), maps.surfaces, maps.unanswered);
}

std::string pixel_text(const Seen& seen, std::size_t index) {
  const Vec2d at = seen.surface.image.pixels.pixel(index);
  return std::to_string(static_cast<int>(at.x)) + "," + std::to_string(static_cast<int>(at.y));
}

double per_pixel(std::uint64_t sum, std::uint64_t pixels) {
  return pixels == 0 ? 0.0 : static_cast<double>(sum) / static_cast<double>(pixels);
}

std::string lights_at_most(const Seen& seen, const MapTotals& total) {
  return total.most == 0 ? "" : ", at most " + grouped(total.most) + " (pixel " + pixel_text(seen, total.most_at) + ")";
}

}  // namespace

const char* name_of(Kind kind) {
  return std::find_if(k_kind_names.begin(), k_kind_names.end(), [&](const KindName& row) { return row.kind == kind; })
      ->name;
}

Figure lights_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps, std::uint32_t top) {
  Figure figure = figure_of(heading, "Lights per pixel");
  const CountScale scale(0, top, lights_colour, figure.palette);
  figure.panels = {panel_of(seen.surface.image.pixels.size, maps.state,
                            [&](std::size_t i) { return scale.colour_of(maps.lights(i)); })};
  figure.bar_label = "lights that a pixel evaluates";
  figure.bar = scale.bar();
  figure.ticks = scale.ticks(maps.lights_total.most > top);
  add_swatches(figure, maps);
  figure.notes = {"Mean " + short_number(per_pixel(maps.lights_total.sum, maps.surfaces)) +
                  lights_at_most(seen, maps.lights_total) + ". Needed: mean " +
                  short_number(per_pixel(seen.needed, maps.surfaces)) + "."};
  return figure;
}

Figure levels_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps) {
  constexpr std::array<std::uint32_t, 3> k_most = {0, 3, 5};  // of a level; the last one has no end
  Figure figure = figure_of(heading, "Lights per pixel in steps");
  constexpr std::array<Rgb, 4> k_colours = {k_stone, Rgb{66, 135, 245}, Rgb{72, 200, 90}, Rgb{240, 66, 54}};
  std::vector<Shades> levels;
  for (std::size_t level = 0; level < k_colours.size(); ++level)
    levels.emplace_back(k_colours[level], level == 0 ? k_stone_light : 1.0, figure.palette);
  std::array<std::uint64_t, 4> pixels{};
  figure.panels = {panel_of(seen.surface.image.pixels.size, maps.state, [&](std::size_t i) {
    const auto level =
        static_cast<std::size_t>(std::lower_bound(k_most.begin(), k_most.end(), maps.lights(i)) - k_most.begin());
    ++pixels[level];
    return levels[level].at(seen.relief[i]);
  })};
  constexpr std::array<const char*, 4> k_labels = {"no light", "1 to 3", "4 and 5", "6 and more"};
  for (std::size_t level = 0; level < levels.size(); ++level)
    figure.swatches.push_back({{levels[level].middle()},
                               std::string(k_labels[level]) + ": " +
                                   percent(static_cast<double>(pixels[level]), static_cast<double>(maps.surfaces))});
  add_swatches(figure, maps);
  figure.notes = {"Mean " + short_number(per_pixel(maps.lights_total.sum, maps.surfaces)) +
                  lights_at_most(seen, maps.lights_total) + "."};
  return figure;
}

Figure types_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps) {
  constexpr std::uint32_t k_steps = 14;
  Figure figure = figure_of(heading, "Points red, spots green");
  const auto first = static_cast<std::uint32_t>(figure.palette.size());
  const auto level = [](std::uint32_t step) {  // the first step is clearly above zero
    return step == 0 ? 0.0 : 95.0 + 160.0 * (step - 1) / (k_steps - 2);
  };
  for (std::uint32_t spots = 0; spots < k_steps; ++spots)
    for (std::uint32_t points = 0; points < k_steps; ++points)
      figure.palette.push_back({static_cast<std::uint8_t>(level(points)), static_cast<std::uint8_t>(level(spots)), 0});
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < maps.points.size(); ++i) most = std::max({most, maps.points[i], maps.spots[i]});
  const std::uint32_t top =
      scale_top(usual_most(maps, [&](std::size_t i) { return std::max(maps.points[i], maps.spots[i]); }));
  const auto step_of = [&](std::uint32_t all) -> std::uint32_t {
    const std::uint32_t count = std::min(all, top);
    if (count == 0) return 0;
    return top < k_steps ? count * (k_steps - 1) / top
                         : 1 + static_cast<std::uint32_t>(std::uint64_t{count - 1} * (k_steps - 2) / (top - 1));
  };
  const auto colour = [&](std::uint32_t points, std::uint32_t spots) {
    return static_cast<Colour>(first + step_of(spots) * k_steps + step_of(points));
  };
  figure.panels = {panel_of(seen.surface.image.pixels.size, maps.state,
                            [&](std::size_t i) { return colour(maps.points[i], maps.spots[i]); })};
  for (std::uint32_t spots = k_steps; spots-- > 0;)
    for (std::uint32_t points = 0; points < k_steps; ++points)
      figure.square.push_back(static_cast<Colour>(first + spots * k_steps + points));
  const std::string range = "0 to " + grouped(top) + (most > top ? "+" : "");
  figure.square_right = range + " points to the right";
  figure.square_up = range + " spots upwards";
  add_swatches(figure, maps);
  figure.notes = {"Mean " + short_number(per_pixel(maps.points_total, maps.surfaces)) + " points and " +
                  short_number(per_pixel(maps.spots_total, maps.surfaces)) + " spots per pixel."};
  return figure;
}

namespace {

// Counts drawn over the relief of the scene, which stays visible where there are none.
Figure overlay_figure(Figure figure, const Seen& seen, const PixelMaps& maps, const std::vector<std::uint32_t>& counts,
                      std::uint32_t top, Rgb (*colour)(double), std::uint32_t most, const std::string& none) {
  const Shades stone(k_stone, k_stone_light, figure.palette);
  const CountScale scale(1, top, colour, figure.palette);
  figure.panels = {panel_of(seen.surface.image.pixels.size, maps.state, [&](std::size_t i) {
    return counts[i] == 0 ? stone.at(seen.relief[i]) : scale.colour_of(counts[i]);
  })};
  // A pixel without an answer can miss lights, too.
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (maps.state[i] == State::no_answer && counts[i] > 0)
      figure.panels.front().colours[i] = scale.colour_of(counts[i]);
  if (most > 0) {
    figure.bar = scale.bar();
    figure.ticks = scale.ticks(most > top);
  }
  figure.swatches.push_back({{stone.middle()}, none});
  add_swatches(figure, maps);
  return figure;
}

}  // namespace

Figure false_positives_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps, std::uint32_t top) {
  Figure figure = figure_of(heading, "False positives per pixel");
  figure.bar_label = "lights that a pixel evaluates and that do not reach it";
  const MapTotals& total = maps.false_positives_total;
  figure = overlay_figure(std::move(figure), seen, maps, maps.false_positives, top, false_positives_colour, total.most,
                          "none");
  const std::uint64_t evaluated = maps.lights_total.sum;
  figure.notes = {"Mean " + short_number(per_pixel(total.sum, maps.surfaces)) + lights_at_most(seen, total) + ": " +
                  percent(static_cast<double>(total.sum), static_cast<double>(evaluated)) + " of " +
                  grouped(evaluated) + " evaluations" +
                  (seen.needed > 0 ? ", overshade " +
                                         short_number(static_cast<double>(evaluated) / static_cast<double>(seen.needed))
                                   : "") +
                  "."};
  return figure;
}

Figure missed_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps) {
  Figure figure = figure_of(heading, "Missed lights per pixel");
  figure.bar_label = "lights that reach a pixel and that it does not evaluate";
  const MapTotals& total = maps.missed_total;
  figure = overlay_figure(std::move(figure), seen, maps, maps.missed, scale_top(total.most), missed_colour, total.most,
                          "none missed");
  if (total.sum == 0) {
    figure.notes = {"None of " + grouped(seen.needed) + " lights that the pixels need is missed."};
    return figure;
  }
  figure.notes = {grouped(total.sum) + " of " + grouped(seen.needed) + " lights that the pixels need are missed (" +
                  percent(static_cast<double>(total.sum), static_cast<double>(seen.needed)) + "), in " +
                  grouped(total.pixels) + " pixels of " + grouped(maps.surfaces) + lights_at_most(seen, total) + "."};
  return figure;
}

Figure lists_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps, const ListMap& lists) {
  constexpr std::uint32_t k_colours = 240;
  Figure figure = figure_of(heading, "A colour per list");
  const auto first = static_cast<std::uint32_t>(figure.palette.size());
  for (const Rgb& colour : distinct_colours(k_colours)) figure.palette.push_back(colour);
  figure.panels = {panel_of(seen.surface.image.pixels.size, maps.state, [&](std::size_t i) {
    return lists.list[i] == 0 ? Colour{k_empty} : static_cast<Colour>(first + (lists.list[i] - 1) % k_colours);
  })};
  std::vector<Colour> some;
  for (std::uint32_t i = 0; i < std::min(lists.lists, 8u); ++i) some.push_back(static_cast<Colour>(first + i));
  if (!some.empty()) figure.swatches.push_back({some, "pixels that loop over the same lights"});
  figure.swatches.push_back({{k_empty}, "no light"});
  add_swatches(figure, maps);
  figure.notes = {
      grouped(lists.lists) + " distinct lists in " + grouped(maps.surfaces) + " pixels; the most frequent has " +
      percent(static_cast<double>(lists.most_pixels), static_cast<double>(maps.surfaces)) + " of them." +
      (lists.lists > k_colours ? " Every " + std::to_string(k_colours) + "th, from the top left, has the same colour."
                               : "")};
  return figure;
}

Figure depth_figure(const Heading& heading, const Seen& seen) {
  constexpr int k_greys = 160;
  Figure figure = figure_of(heading, "Depth");
  const auto first = static_cast<int>(figure.palette.size());
  for (int i = 0; i < k_greys; ++i)  // near is light
    figure.palette.push_back(shaded({255, 255, 255}, 0.95 - 0.87 * i / (k_greys - 1)));
  const std::vector<float>& depths = seen.surface.image.nearest;
  double nearest = INFINITY, farthest = 0.0;
  std::uint64_t surfaces = 0;
  for (const float depth : depths) {
    if (!std::isfinite(depth)) continue;
    nearest = std::min(nearest, static_cast<double>(depth));
    farthest = std::max(farthest, static_cast<double>(depth));
    ++surfaces;
  }
  const bool has_span = farthest > nearest && nearest > 0.0;
  std::vector<State> state;
  state.reserve(depths.size());
  for (const float depth : depths) state.push_back(std::isfinite(depth) ? State::answered : State::no_surface);
  figure.panels = {panel_of(seen.surface.image.pixels.size, state, [&](std::size_t i) {
    const double share =
        has_span ? std::log2(static_cast<double>(depths[i]) / nearest) / std::log2(farthest / nearest) : 0.0;
    return static_cast<Colour>(first + std::lround(share * (k_greys - 1)));
  })};
  if (surfaces > 0) {
    figure.bar_label = "depth along the view, evenly in its logarithm";
    for (int i = 0; i < k_greys; ++i) figure.bar.push_back(static_cast<Colour>(first + i));
    figure.ticks = depth_ticks(nearest, farthest);
    figure.notes = {"From " + short_number(nearest) + " m to " + short_number(farthest) + " m, in " +
                    grouped(surfaces) + " of " + grouped(depths.size()) + " pixels."};
  }
  add_swatches(figure, depths.size(), surfaces, 0);
  return figure;
}

Figure strip_figure(const Heading& heading, const std::vector<StripFrame>& frames, std::uint32_t top) {
  Figure figure = figure_of(heading, "Lights per pixel along the path");
  const CountScale scale(0, top, lights_colour, figure.palette);
  figure.columns = std::min(4, static_cast<int>(frames.size()));
  std::uint64_t pixels = 0, surfaces = 0, unanswered = 0;
  std::uint32_t most = 0;
  for (const StripFrame& frame : frames) {
    Panel& panel = figure.panels.emplace_back(
        panel_of(frame.size, frame.state, [&](std::size_t i) { return scale.colour_of(frame.lights[i]); }));
    panel.caption = "frame " + std::to_string(frame.frame) + ": mean " +
                    short_number(per_pixel(frame.total.sum, frame.surfaces)) + ", most " + grouped(frame.total.most);
    pixels += frame.state.size();
    surfaces += frame.surfaces;
    unanswered += static_cast<std::uint64_t>(std::count(frame.state.begin(), frame.state.end(), State::no_answer));
    most = std::max(most, frame.total.most);
  }
  figure.bar_label = "lights that a pixel evaluates";
  figure.bar = scale.bar();
  figure.ticks = scale.ticks(most > top);
  add_swatches(figure, pixels, surfaces, unanswered);
  return figure;
}

}  // namespace clusterbench::pictures
