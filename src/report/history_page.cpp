#include "report/history_page.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace clusterbench::report {
namespace {

constexpr double k_width = 320.0, k_height = 90.0, k_margin = 8.0;

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

// From a series to the chart's picture: commits to the right, the largest value on top.
struct Scale {
  double low, high;
  std::size_t count;

  double x(double place) const {
    const double step = count < 2 ? 0.0 : (k_width - 2.0 * k_margin) / static_cast<double>(count - 1);
    return k_margin + step * place;
  }
  double y(double value) const {
    const double share = high > low ? (value - low) / (high - low) : 0.5;
    return k_height - k_margin - share * (k_height - 2.0 * k_margin);
  }
};

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
    lines += "<line class=\"" + direction(*series.metric, change) + "\" x1=\"" + x + "\" x2=\"" + x +
             "\" y1=\"0\" y2=\"" + coordinate(k_height) + "\"/>";
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
  const Scale scale{*low, *high, series.values.size()};
  const std::string title =
      std::string(series.metric->name) + " in " + std::string(series.metric->unit) + " of " + escaped(series.case_name);
  std::string out = "<figure>\n<figcaption><b>" + std::string(series.metric->name) + "</b> " +
                    escaped(series.case_name) + "<br>" + figure_text(series.values.front()) + " to " +
                    figure_text(series.values.back()) + " " + std::string(series.metric->unit) + " on " +
                    escaped(series.machine) + "</figcaption>\n<svg role=\"img\" viewBox=\"0 0 320 90\" aria-label=\"" +
                    title + ", " + std::to_string(series.values.size()) + " values from " + figure_text(*low) + " to " +
                    figure_text(*high) + "\">" + change_lines(series, scale) + curve(series, scale) + "</svg>\n";
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
  return std::string(k_start) + "<h1>clusterbench history</h1>\n<p>" + std::to_string(entries) + " results, " +
         std::to_string(series.size()) + " series, " + std::to_string(changes) +
         " changes of their mean (dashed: E-divisive means with Student's t test). " + std::to_string(constant) +
         " series never changed and are not drawn.</p>\n<main>\n" + figures + "</main>\n</html>\n";
}

}  // namespace clusterbench::report
