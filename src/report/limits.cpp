#include "report/limits.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>

#include "core/text.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// A figure of a case: the number at `value`, by that at `divisor`, times `scale`. All are JSON pointers; "": none.
struct FigureRow {
  const char* name;
  const char* value;
  double scale = 1.0;
  const char* frame = "";
  const char* cell = "";
  const char* divisor = "";
};
constexpr double k_ns_to_us = 1e-3;
constexpr FigureRow k_figure_rows[] = {
    {"frame_us", "/timing/frame_ns/median", k_ns_to_us},
    {"frame_us.max", "/timing/worst_frame/ns", k_ns_to_us, "/timing/worst_frame/frame"},
    {"frame_cost_us", "/cost/frame_ns", k_ns_to_us},
    {"assign_us", "/timing/assign_ns/median", k_ns_to_us},
    {"convert_us", "/timing/convert_ns/median", k_ns_to_us},
    {"build_us", "/timing/build_ns/median", k_ns_to_us},
    {"index_entries", "/buffers/index_entries/high_water", 1.0, "/buffers/worst_frame", "/buffers/worst_cell"},
    {"bytes", "/buffers/bytes/high_water", 1.0, "/buffers/worst_frame", "/buffers/worst_cell"},
    {"upload_bytes", "/buffers/upload_bytes/max"},
    {"scratch_bytes", "/buffers/scratch_bytes"},
    {"longest", "/occupancy/lights_per_cell/max", 1.0, "/occupancy/worst_frame", "/occupancy/worst_cell"},
    {"pairs", "/occupancy/pairs/max"},
    {"dropped", "/buffers/overflow/dropped_pairs"},
    {"missed", "/error/false_negatives", 1.0, "/error/deepest/frame", "/error/deepest/cell"},
    {"excess", "/error/excess_ratio"},
    {"undecided", "/error/undecided"},
    {"unlit", "/shading/missed", 1.0, "/shading/worst_frame/frame", "", "/shading/needed"},
    {"lost_irradiance", "/shading/lost_irradiance"},
    {"overshade", "/shading/overshade"},
};

// With the row that has it.
struct Found {
  const FigureRow* row = nullptr;
  double value = 0.0;
};
std::optional<Found> found_in(const Json& result_case, const std::string& name) {
  for (const FigureRow& row : k_figure_rows) {
    if (row.name != name) continue;
    std::optional<double> value = number_at(result_case, row.value);
    if (!value) continue;
    if (*row.divisor != '\0') {
      const double whole = number_at(result_case, row.divisor).value_or(0.0);
      if (!(whole > 0.0)) continue;  // a share of nothing
      *value /= whole;
    }
    return Found{&row, *value * row.scale};
  }
  return {};
}

std::string budget_number(double value) {
  char text[48];
  const bool is_count = value == static_cast<double>(static_cast<long long>(value)) && value < 1e15;
  std::snprintf(text, sizeof text, is_count ? "%.0f" : "%.7g", value);
  return text;
}

std::string worst_location(const Json& result_case, const FigureRow& row) {
  std::string text;
  for (const auto& [word, pointer] : {std::pair("frame ", row.frame), std::pair("cell ", row.cell)})
    if (const Json* found = *pointer != '\0' ? value_at(result_case, pointer) : nullptr; found != nullptr)
      text += (text.empty() ? "" : ", ") + std::string(word) + found->dump();
  return text.empty() ? "" : " (" + text + ")";
}

std::string rule_text(const config::LimitRule& rule) {
  return rule.figure + (rule.is_inclusive ? " >= " : " > ") + budget_number(rule.limit);
}

// Why a case may lack a figure.
std::string reason_for_none(const std::string& figure) {
  const auto row = std::find_if(std::begin(k_figure_rows), std::end(k_figure_rows),
                                [&](const FigureRow& candidate) { return candidate.name == figure; });
  const std::string_view pointer = row == std::end(k_figure_rows) ? "" : row->value;
  if (pointer.starts_with("/timing/")) return " (--no-timing or timing.measure: false leaves times out)";
  if (figure == "overshade")
    return " (there is none where more than 0.1 % of the lights are unlit or fewer than 100 reach the samples, as with "
           "shading.samples: 0)";
  if (pointer.starts_with("/shading/")) return " (no light reaches the samples, or shading.samples: 0 leaves them out)";
  if (pointer.starts_with("/error/"))
    return " (accuracy.check: false leaves errors out; structures without cells have none)";
  if (pointer.starts_with("/occupancy/")) return " (structures without cells have none)";
  return "";
}

}  // namespace

std::optional<double> limit_figure(const Json& result_case, const std::string& name) {
  const std::optional<Found> found = found_in(result_case, name);
  return found ? std::optional(found->value) : std::nullopt;
}

LimitFindings limit_findings(const Json& result, std::span<const config::LimitRule> rules) {
  LimitFindings findings;
  for (const config::LimitRule& rule : rules) {
    std::vector<std::string> without;
    for (const Json& result_case : result["cases"]) {
      const std::optional<Found> found = found_in(result_case, rule.figure);
      if (!found) {
        without.push_back(result_case["name"].get<std::string>());
        continue;
      }
      const std::string text = result_case["name"].get<std::string>() + ": " + rule.figure + " is " +
                               budget_number(found->value) + worst_location(result_case, *found->row);
      if (rule.is_broken_by(found->value)) findings.broken.push_back(text + ", and fails with " + rule_text(rule));
      if (rule.is_near(found->value)) findings.near.push_back(text + ", less than 10 % below " + rule_text(rule));
    }
    const std::string quoted = "'" + rule_text(rule) + "'", hint = reason_for_none(rule.figure);
    if (without.size() == result["cases"].size())
      findings.broken.push_back(quoted + " could not be checked: no case has " + rule.figure + hint);
    else if (!without.empty())
      findings.unchecked.push_back(quoted + " was not checked for " + number_of(without.size(), "case") + " without " +
                                   rule.figure + hint + ": " + without.front() + (without.size() > 1 ? " ..." : ""));
  }
  return findings;
}

}  // namespace clusterbench::report
