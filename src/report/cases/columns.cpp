#include "report/cases/columns.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/text.h"
#include "measure/statistics/time_change.h"
#include "result/at.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::Scene;
using result::Time;
using result::Timing;

std::string count_text(double value) {
  if (value < 10000.0) return text("%.0f", value);
  if (value < 1e6) return text("%.1fk", value / 1e3);
  return text("%.2fM", value / 1e6);
}

// Width in terminal columns: a character of several bytes has width one.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

}  // namespace

std::vector<std::size_t> widths_of(const std::vector<Cells>& rows) {
  std::vector<std::size_t> widths;
  for (const Cells& row : rows) widths.resize(std::max(widths.size(), row.size()), 0);
  for (const Cells& row : rows)
    for (std::size_t column = 0; column < row.size(); ++column)
      widths[column] = std::max(widths[column], width_of(row[column]));
  widths[0] = 1;
  return widths;
}

std::string aligned(const Cells& cells, const std::vector<std::size_t>& widths) {
  std::string row = "  ";
  for (std::size_t column = 0; column < cells.size(); ++column) {
    const std::string padding(widths[column] - width_of(cells[column]), ' ');
    row += column < 2 ? cells[column] + padding : padding + cells[column];
    row += column == 0 ? " " : "  ";
  }
  while (!row.empty() && row.back() == ' ') row.pop_back();
  return row + "\n";
}

std::string aligned_rows(const std::vector<Cells>& rows) {
  std::string out;
  const std::vector<std::size_t> widths = widths_of(rows);
  for (const Cells& row : rows) out += aligned(row, widths);
  return out;
}

std::string what_intervals_take() {
  return "an interval takes " + std::to_string(static_cast<int>(measure::k_least_freedom) + 1) + " launches, or " +
         std::to_string(measure::k_least_rounds) + " rounds of a single one";
}

std::string text(const char* format, double value) {
  const int length = std::snprintf(nullptr, 0, format, value);
  std::string out(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::snprintf(out.data(), out.size() + 1, format, value);
  return out;
}

std::string interval_text(const Time& time) {
  constexpr double k_wide_percent = 20.0;
  if (!(time.median > 0.0)) return "-";
  const auto [low, high] = result::Pair(time.ci95);
  if (!std::isfinite(low) || !std::isfinite(high)) return k_unknown_interval;
  const double below = 100.0 * (1.0 - low / time.median), above = 100.0 * (high / time.median - 1.0);
  if (std::max(below, above) < k_wide_percent) return text("%.1f %%", 0.5 * (below + above));
  return text("-%.0f", below) + text("/+%.0f %%", above);
}

std::string frame_interval_text(const Case& result_case) {
  return result_case.timing ? interval_text(result_case.timing->frame_ns) : "-";
}

std::string unlit_text(const std::optional<double>& share) {
  if (!share) return "-";
  const double percent = 100.0 * *share;
  if (percent == 0.0) return "0 %";
  return percent < 0.01 ? "<0.01 %" : text(percent < 1.0 ? "%.2f %%" : "%.1f %%", percent);
}

std::string height_text(double metres) {
  constexpr double k_nothing_m = 1e-6;
  return text("%.4g", std::abs(metres) < k_nothing_m ? 0.0 : metres);
}

std::string amount_text(double value) {
  const bool is_count = value == std::floor(value) && std::abs(value) < 1e9;
  return text(is_count ? "%.0f" : std::abs(value) < 1e5 ? "%.4g" : "%.6g", value);
}

std::string text_of(const std::optional<double>& value, const char* format, double scale) {
  return value ? text(format, scale * *value) : "-";
}

std::string short_count(const std::optional<double>& count) {
  return count ? count_text(*count) : "-";
}

std::string storage_name(const Case& result_case) {
  return result_case.storage == run::k_own_structure ? run::own_structure_name(result_case.assigner.name)
                                                     : printable(result_case.storage);
}

std::string method_name(const Case& result_case) {
  std::string label = printable(result_case.assigner.label);
  if (result_case.preset) label = printable(*result_case.preset) + ": " + label;
  if (result_case.precision && result_case.precision->packing != "float32")
    label += " " + printable(result_case.precision->label);
  if (result_case.pre_cull) label += " after " + printable(result_case.pre_cull->label);
  return label;
}

std::vector<NamedCase> distinct_cases(const std::vector<const Case*>& cases, PartOfCase part) {
  std::vector<NamedCase> out;
  for (const Case* result_case : cases) {
    const Json of_case = part(*result_case);
    const auto is_same = [&](const NamedCase& other) {
      return other.name == method_name(*result_case) && of_case == part(*other.result_case);
    };
    if (!of_case.is_null() && std::none_of(out.begin(), out.end(), is_same))
      out.push_back({method_name(*result_case), result_case});
  }
  std::map<std::string, int> uses;
  for (const NamedCase& named : out) ++uses[named.name];
  for (NamedCase& named : out)
    if (uses[named.name] > 1) named.name += " / " + storage_name(*named.result_case);
  return out;
}

std::string machine_part(const Case& result_case) {
  return result_case.machine ? ", " + printable(*result_case.machine) : "";
}

std::string block_of(const Case& result_case) {
  return printable(result_case.grid.name) + ", camera " + printable(result_case.camera) + ", " +
         viewport_text(result_case.viewport) + machine_part(result_case);
}

std::vector<CaseBlock> blocks_of(const std::vector<Case>& cases, const Scene& scene) {
  std::vector<CaseBlock> blocks;
  std::map<std::string, std::size_t> index_of;
  for (const Case& result_case : cases) {
    if (result_case.scene != scene.name) continue;
    const auto [at, is_new] = index_of.try_emplace(block_of(result_case), blocks.size());
    if (is_new) blocks.push_back({at->first, {}});
    blocks[at->second].cases.push_back(&result_case);
  }
  return blocks;
}

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : printable_lines(text)) {
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) {
      out += ' ';
      continue;
    }
    if (std::string_view("\\|`*_[]<>&#").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

}  // namespace clusterbench::report
