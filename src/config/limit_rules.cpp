#include "config/limit_rules.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

constexpr LimitFigure k_figures[] = {
    {"frame_us", "median time of a frame in microseconds: assign and convert"},
    {"frame_us.max", "time of the slowest frame that is timed, in microseconds"},
    {"frame_cost_us", "modelled time of a frame with its shading, in microseconds"},
    {"assign_us", "median time to assign a frame's lights, in microseconds"},
    {"convert_us", "median time to convert a frame's lists, in microseconds"},
    {"build_us", "median time to prepare for a grid, in microseconds"},
    {"index_entries", "entries in the fullest frame: light indices, or words, nodes, boxes (docs/sizing.md)"},
    {"bytes", "bytes of indices and headers in the fullest frame"},
    {"upload_bytes", "bytes to copy in the largest frame"},
    {"scratch_bytes", "bytes of the method's own memory"},
    {"longest", "lights in the fullest cell of any frame"},
    {"pairs", "(cell, light) pairs in the fullest frame"},
    {"dropped", "pairs that the storage dropped, over all frames"},
    {"missed", "true pairs that lists lack, over all frames"},
    {"excess", "pairs beside the truth, by true pairs"},
    {"undecided", "pairs that the truth could not decide, over all frames"},
    {"unlit", "share of the lights that samples need and are not given"},
    {"lost_irradiance", "share of the irradiance that such lights carry"},
    {"overshade", "lights that samples are given, by those they need"},
};

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::vector<std::string> figure_names() {
  std::vector<std::string> names;
  for (const LimitFigure& figure : k_figures) names.emplace_back(figure.name);
  return names;
}

}  // namespace

std::span<const LimitFigure> limit_figures() {
  return k_figures;
}

LimitRule limit_rule(const std::string& text, const std::string& file, const std::string& where) {
  const auto refuse = [&](const std::string& what) { throw Error(file, where, "'" + text + "' " + what); };
  const std::size_t sign = text.find('>');
  if (sign == std::string::npos) refuse("is no budget; takes a figure, > or >=, and a number, as in 'frame_us > 200'");
  LimitRule rule;
  rule.figure = without_blanks(std::string_view(text).substr(0, sign));
  rule.is_inclusive = text.substr(sign).starts_with(">=");
  const std::string_view number = without_blanks(std::string_view(text).substr(sign + (rule.is_inclusive ? 2 : 1)));
  const std::vector<std::string> names = figure_names();
  if (std::find(names.begin(), names.end(), rule.figure) == names.end())
    refuse("names no figure of a case" + did_you_mean(rule.figure, names) + "; there are: " + joined(names));
  const auto [end, failed] = std::from_chars(number.data(), number.data() + number.size(), rule.limit);
  if (failed != std::errc() || end != number.data() + number.size() || !std::isfinite(rule.limit))
    refuse("ends with '" + std::string(number) + "', which is no number");
  return rule;
}

}  // namespace clusterbench::config
