// The text of a comparison: a table for terminals, Markdown for pull requests.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "report/cases/columns.h"
#include "report/comparing/compare.h"

namespace clusterbench::report {
namespace {

using result::ComparedCase;
using result::Comparison;
using result::Json;

std::string ratio_percent(double ratio) {
  return std::isfinite(ratio) ? text("%+.2f %%", 100.0 * (ratio - 1.0)) : "-";
}

std::string interval(const std::optional<result::Pair>& ci95) {
  if (!ci95) return "-";
  const auto [low, high] = *ci95;
  return std::isfinite(high) ? ratio_percent(low) + " .. " + ratio_percent(high) : k_unknown_interval;
}

std::string micros(const std::optional<double>& ns) {
  if (!ns) return "-";
  const double us = *ns / 1000.0;
  return text(us < 1000.0 ? "%.4g" : "%.0f", us);
}

std::string version(const result::Tool& tool) {
  return tool.version + " (" + tool.git_sha + ")";
}

const char* kind_of_times(const Comparison& comparison) {
  if (comparison.data == "paired") return ", times of assignment side by side";
  if (comparison.summary.methods_timed == 0) return ", no times in common";
  return ", frame times of separate runs";
}

std::string heading(const Comparison& comparison) {
  return "base " + version(comparison.base.tool) + ", new " + version(comparison.next.tool) +
         kind_of_times(comparison) + ", threshold " + text("%g", 100.0 * comparison.threshold) + " %";
}

std::string build_of(const result::Plugin& plugin) {
  constexpr std::size_t k_digits = 12;
  return plugin.version + " (" + plugin.file + ", sha256 " + plugin.sha256.substr(0, k_digits) + ")";
}

// A line for each plug-in that both results have: whether it is the same build.
std::vector<std::string> plugin_lines(const Comparison& comparison) {
  std::vector<std::string> lines;
  const std::vector<result::Plugin> none;
  for (const result::Plugin& before : comparison.base.plugins ? *comparison.base.plugins : none)
    for (const result::Plugin& now : comparison.next.plugins ? *comparison.next.plugins : none) {
      if (before.id != now.id) continue;
      const std::string name = "plug-in " + shown(before.id) + ": ";
      lines.push_back(name + (before.sha256 == now.sha256
                                  ? "the same file in both, " + shown(build_of(now))
                                  : "base " + shown(build_of(before)) + ", new " + shown(build_of(now))));
    }
  return lines;
}

bool is_hint(const ComparedCase& compared_case) {
  return compared_case.hint && compared_case.hint != "none";
}

std::string word_of(const ComparedCase& compared_case) {
  if (compared_case.verdict) return *compared_case.verdict;
  return is_hint(compared_case) ? *compared_case.hint + "?" : "-";
}

// name, verdict, base, new, change, interval, instructions, counts
constexpr std::array k_columns{"case", "time", "base us", "new us", "change", "95 % interval", "instr", "counts"};
Cells row_of(const ComparedCase& compared_case) {
  return {shown(compared_case.name),
          word_of(compared_case),
          micros(compared_case.base_ns),
          micros(compared_case.new_ns),
          ratio_percent(compared_case.ratio.value_or(result::k_none)),
          interval(compared_case.ci95),
          compared_case.instructions ? ratio_percent(compared_case.instructions->assign_ratio) : "-",
          compared_case.counts};
}

bool is_remarkable(const ComparedCase& compared_case) {
  return (compared_case.verdict && compared_case.verdict != "same") || compared_case.counts != "same" ||
         (compared_case.instructions && compared_case.instructions->verdict != "same");
}

bool is_worse(const ComparedCase& compared_case) {
  return compared_case.verdict == "slower" || compared_case.counts == "worse" ||
         (compared_case.instructions && compared_case.instructions->verdict == "more");
}

bool is_open(const ComparedCase& compared_case) {
  return is_hint(compared_case) || compared_case.verdict == "inconclusive";
}

const char* mark_of(const ComparedCase& compared_case) {
  return is_worse(compared_case) ? "!" : is_open(compared_case) ? "?" : is_remarkable(compared_case) ? "+" : " ";
}

// Explains the marks of the table.
std::string legend(const std::vector<ComparedCase>& cases) {
  const auto has = [&](const std::string& mark) {
    return std::ranges::any_of(cases, [&](const ComparedCase& one) { return mark_of(one) == mark; });
  };
  const bool has_hint = std::ranges::any_of(cases, is_hint);
  std::string out = has("!") ? "! slower, more instructions, or what is counted is worse.\n" : "";
  if (has("+")) out += "+ faster, fewer instructions, or what is counted is better.\n";
  if (has("?"))
    out += has_hint ? "? a hint: medians of separate runs differ beyond the threshold and their intervals.\n"
                    : "? inconclusive: too noisy to tell.\n";
  return out;
}

// The first element in which two lists differ; both values if they are not lists.
std::string times_text(const Json& base, const Json& next) {
  if (!base.is_array() || !next.is_array() || base.size() != next.size() || base.size() <= 3)
    return shown(base.dump() + " -> " + next.dump());
  std::size_t first = 0;
  while (first + 1 < base.size() && base[first] == next[first]) ++first;
  return "[" + std::to_string(first) + "] " + shown(base[first].dump() + " -> " + next[first].dump());
}

std::string list_text(const result::ListsDiffer& lists) {
  return "lists differ in " + number_of(lists.frames, "frame") + ", first in frame " + std::to_string(lists.frame) +
         ", cell " + Json(lists.cell).dump() + ", light " + std::to_string(lists.light) + ": only in the " +
         (lists.in == "new" ? "new" : "base") + " lists; " + std::to_string(lists.base_pairs) + " -> " +
         number_of(lists.new_pairs, "pair");
}

// One line per difference of a case.
std::vector<std::string> details(const ComparedCase& compared_case) {
  std::vector<std::string> lines;
  if (compared_case.lists) lines.push_back(list_text(*compared_case.lists));
  for (const result::Difference& difference : compared_case.differences)
    lines.push_back(difference.what.substr(1) + " " + difference.is + ": " +
                    times_text(difference.base, difference.next));
  if (compared_case.place) lines.push_back("deepest lost light: " + *compared_case.place);
  return lines;
}

std::string summary_text(const Comparison& comparison) {
  const result::ComparisonSummary& summary = comparison.summary;
  std::string text = number_of(summary.cases, "case") + " in common:";
  const char* separator = " ";
  for (const auto& [count, name] :
       {std::pair{summary.faster, "faster"}, std::pair{summary.slower, "slower"}, std::pair{summary.same, "same"},
        std::pair{summary.inconclusive, "inconclusive"}, std::pair{summary.counts_better, "counts better"},
        std::pair{summary.counts_worse, "counts worse"}}) {
    if (count == 0) continue;
    text += separator + std::to_string(count) + " " + name;
    separator = ", ";
  }
  const bool has_hints = summary.hints_longer != 0 || summary.hints_shorter != 0;
  if (summary.cases == 0)
    text += " nothing was compared";
  else if (*separator == ' ')
    text += has_hints ? " what is counted is the same" : " nothing has changed of what was compared";
  if (has_hints)
    text += "; hints of time: " + std::to_string(summary.hints_longer) + " longer, " +
            std::to_string(summary.hints_shorter) + " shorter";
  if (summary.ratio)
    text += "; geometric mean of " + number_of(summary.methods_timed, "method") + " " + ratio_percent(*summary.ratio) +
            " (" + interval(summary.ci95) + ")";
  for (const auto& [names, side] :
       {std::pair{&comparison.only_in_base, "base"}, std::pair{&comparison.only_in_new, "new"}})
    if (!names->empty()) text += "; " + number_of(names->size(), "case") + " of the " + side + " not compared";
  return text;
}

// The left column of aligned() is a mark.
std::string table(const std::vector<ComparedCase>& cases) {
  std::vector<Cells> rows;
  const auto add = [&](const Cells& cells, const char* mark) {
    rows.push_back({mark});
    rows.back().insert(rows.back().end(), cells.begin(), cells.end());
  };
  add({k_columns.begin(), k_columns.end()}, " ");
  for (const ComparedCase& compared_case : cases) add(row_of(compared_case), mark_of(compared_case));
  std::string text;
  return text + aligned_rows(rows) + legend(cases);
}

std::string markdown_row(const Cells& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + markdown_cell(cell) + " |";
  return row + "\n";
}

std::string markdown_table(const std::vector<const ComparedCase*>& cases) {
  std::string out = markdown_row({k_columns.begin(), k_columns.end()}) + "|---|---|---:|---:|---:|---:|---:|---|\n";
  for (const ComparedCase* compared_case : cases) out += markdown_row(row_of(*compared_case));
  return out;
}

std::string markdown_list(const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string out = std::string("\n**") + title + "**\n\n";
  for (const std::string& line : lines) out += "- " + markdown_cell(line) + "\n";
  return out;
}

std::vector<std::string> details_of_all(const std::vector<ComparedCase>& cases) {
  std::vector<std::string> lines;
  for (const ComparedCase& compared_case : cases)
    for (const std::string& line : details(compared_case)) lines.push_back(shown(compared_case.name) + ": " + line);
  return lines;
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
  std::string out = heading(comparison) + "\n";
  for (const std::string& line : plugin_lines(comparison)) out += line + "\n";
  if (!comparison.cases.empty()) out += table(comparison.cases);
  for (const std::string& line : details_of_all(comparison.cases)) out += "counted: " + line + "\n";
  for (const std::string& warning : comparison.warnings) out += "warning: " + warning + "\n";
  for (const std::string& failure : comparison.failures) out += "FAILED " + failure + "\n";
  out += summary_text(comparison) + "\n";
  if (comparison.advice)
    for (const std::string& advice : *comparison.advice) out += advice + "\n";
  return out;
}

std::string comparison_markdown(const Comparison& comparison) {
  std::vector<const ComparedCase*> remarkable, rest;
  for (const ComparedCase& compared_case : comparison.cases)
    (is_remarkable(compared_case) ? remarkable : rest).push_back(&compared_case);
  std::string out = "### clusterbench: " + std::string(comparison.failures.empty() ? "passed" : "failed") + "\n\n" +
                    markdown_cell(summary_text(comparison)) + "\n\n" + markdown_cell(heading(comparison)) + "\n";
  for (const std::string& line : plugin_lines(comparison)) out += "\n" + markdown_cell(line) + "\n";
  if (!remarkable.empty()) out += "\n" + markdown_table(remarkable);
  out += markdown_list("Failed", comparison.failures);
  out += markdown_list("What is counted", details_of_all(comparison.cases));
  out += markdown_list("Warnings", comparison.warnings);
  out += markdown_list("What to do", comparison.advice.value_or(std::vector<std::string>()));
  if (!rest.empty())
    out += "\n<details><summary>" + number_of(rest.size(), "case") +
           " without a verdict or a change of counts</summary>\n\n" + markdown_table(rest) + "\n</details>\n";
  return out;
}

}  // namespace clusterbench::report
