#include "report/history_page.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "core/text.h"

namespace clusterbench::report {
namespace {

constexpr double k_width = 320.0, k_height = 110.0;
constexpr double k_left = 58.0, k_top = 16.0, k_margin = 8.0;  // k_left and k_top: for the axis and its unit

constexpr const char* k_start = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>clusterbench history</title>
<style>
:root { color-scheme: light dark; --line: #1f5fa8; --worse: #b3261e; --better: #1b6e3c; --grid: #8886; }
@media (prefers-color-scheme: dark) { :root { --line: #8ab8f0; --worse: #ff8a80; --better: #7fd19b; } }
body { font: 15px/1.4 system-ui, sans-serif; margin: 1.5rem; }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1.25rem; }
figure { margin: 0; }
figcaption { overflow-wrap: anywhere; }
svg { width: 100%; height: auto; background: #8881; }
path { fill: none; stroke: var(--line); stroke-width: 1.5; }
circle { fill: var(--line); }
line { stroke: var(--grid); stroke-width: 1; stroke-dasharray: 3 3; }
.tick { stroke-dasharray: none; stroke-width: 0.5; }
text { font-size: 9px; text-anchor: end; fill: currentColor; }
.worse { color: var(--worse); stroke: var(--worse); }
.better { color: var(--better); stroke: var(--better); }
ul { margin: 0.25rem 0 0; padding-left: 1.2rem; stroke: none; }
</style>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
  }
  return out;
}

std::string coordinate(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

bool varies(const Series& series) {
  return std::adjacent_find(series.values.begin(), series.values.end(), std::not_equal_to<>()) != series.values.end();
}

// 1, 2 or 5 times a power of ten: about a third of `range`.
double tick_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 3.0))), rest = range / 3.0 / power;
  return power * (rest < 1.5 ? 1.0 : rest < 3.5 ? 2.0 : rest < 7.5 ? 5.0 : 10.0);
}

// From a series to the chart's picture: commits to the right, the largest value on top, ticks at both ends.
struct Scale {
  double step, low, high;
  std::size_t count;

  explicit Scale(const std::vector<double>& values) : count(values.size()) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    step = tick_step(*most - *least);
    low = step * std::floor(*least / step);
    high = step * std::ceil(*most / step);
  }
  double x(double place) const {
    const double each = count < 2 ? 0.0 : (k_width - k_left - k_margin) / static_cast<double>(count - 1);
    return k_left + each * place;
  }
  double y(double value) const {
    return k_height - k_margin - (value - low) / (high - low) * (k_height - k_top - k_margin);
  }
};

std::string axis(const Series& series, const Scale& scale) {
  const auto label = [](double y, const std::string& text) {
    return "<text x=\"" + coordinate(k_left - 6.0) + "\" y=\"" + coordinate(y) + "\">" + text + "</text>";
  };
  std::string out = label(k_top - 6.0, std::string(series.metric->unit));
  const double ticks = std::round((scale.high - scale.low) / scale.step);
  for (double i = 0.0; i <= ticks; ++i) {
    const double value = scale.low + i * scale.step;
    const std::string y = coordinate(scale.y(value));
    out += "<line class=\"tick\" x1=\"" + coordinate(k_left - 3.0) + "\" x2=\"" + coordinate(k_width) + "\" y1=\"" + y +
           "\" y2=\"" + y + "\"/>" + label(scale.y(value) + 3.0, figure_text(value));
  }
  return out;
}

std::string curve(const Series& series, const Scale& scale) {
  std::string path, points;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    const std::string x = coordinate(scale.x(static_cast<double>(i))), y = coordinate(scale.y(series.values[i]));
    path += (i == 0 ? "M" : "L") + x + " " + y;
    points += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"2.5\"><title>" + escaped(series.commits[i]) + ": " +
              figure_text(series.values[i]) + "</title></circle>";
  }
  return "<path d=\"" + path + "\"/>" + points;
}

std::string change_lines(const Series& series, const Scale& scale) {
  std::string lines;
  for (const measure::ChangePoint& change : series.changes) {
    const std::string x = coordinate(scale.x(static_cast<double>(change.index) - 0.5));
    lines += "<line class=\"" + direction(*series.metric, change) + "\" x1=\"" + x + "\" x2=\"" + x + "\" y1=\"" +
             coordinate(k_top) + "\" y2=\"" + coordinate(k_height) + "\"/>";
  }
  return lines;
}

std::string sentence(const Series& series, const measure::ChangePoint& change) {
  const std::string way = direction(*series.metric, change);
  return escaped(series.commits[change.index]) + ": " + figure_text(change.before) + " to " +
         figure_text(change.after) + ", " + change_text(change) + (way.empty() ? "" : ", " + way);
}

std::string figure(const Series& series) {
  const auto [low, high] = std::minmax_element(series.values.begin(), series.values.end());
  const Scale scale(series.values);
  const std::string title =
      std::string(series.metric->name) + " in " + std::string(series.metric->unit) + " of " + escaped(series.case_name);
  std::string out = "<figure>\n<figcaption><b>" + std::string(series.metric->name) + "</b> " +
                    escaped(series.case_name) + "<br>" + figure_text(series.values.front()) + " to " +
                    figure_text(series.values.back()) + " " + std::string(series.metric->unit) +
                    (series.machine.empty() ? "" : " on " + escaped(series.machine)) +
                    (series.settings_since.empty()
                         ? ""
                         : "<br>other settings than before, from " + escaped(series.settings_since) + " on") +
                    "</figcaption>\n<svg role=\"img\" viewBox=\"0 0 " + coordinate(k_width) + " " +
                    coordinate(k_height) + "\" aria-label=\"" + title + ", " + std::to_string(series.values.size()) +
                    " values from " + figure_text(*low) + " to " + figure_text(*high) + "\">" + axis(series, scale) +
                    change_lines(series, scale) + curve(series, scale) + "</svg>\n";
  if (series.changes.empty()) return out + "</figure>\n";
  out += "<ul>";
  for (const measure::ChangePoint& change : series.changes)
    out += "<li class=\"" + direction(*series.metric, change) + "\">" + sentence(series, change) + "</li>";
  return out + "</ul>\n</figure>\n";
}

}  // namespace

std::string history_page(const std::vector<Series>& series, std::size_t entries) {
  std::string figures;
  std::size_t constant = 0, changes = 0;
  for (const Series& one : series) {
    changes += one.changes.size();
    if (varies(one))
      figures += figure(one);
    else
      ++constant;
  }
  return std::string(k_start) + "<h1>clusterbench history</h1>\n<p>" + number_of(entries, "result") + ", " +
         std::to_string(series.size()) + " series, " + number_of(changes, "change") +
         " (dashed lines). Axes begin at the lowest value, not at 0. " + std::to_string(constant) +
         " series never changed and are not drawn.</p>\n<main>\n" + figures + "</main>\n</html>\n";
}

}  // namespace clusterbench::report
