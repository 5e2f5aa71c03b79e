// The text of a comparison: a table for terminals, Markdown for pull requests.

#include <algorithm>
#include <array>

#include "report/cases/columns.h"
#include "report/comparing/compare.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(const Json& ratio) {
  return ratio.is_null() ? "-" : text("%+.2f %%", 100.0 * (ratio.get<double>() - 1.0));
}

std::string interval(const Json& change) {
  if (!change.contains("ci95")) return "-";
  if (change["ci95"][1].is_null()) return k_unknown_interval;
  return percent(change["ci95"][0]) + " .. " + percent(change["ci95"][1]);
}

std::string micros(const Json& compared_case, const char* key) {
  if (!compared_case.contains(key)) return "-";
  const double us = compared_case[key].get<double>() / 1000.0;
  return text(us < 1000.0 ? "%.4g" : "%.0f", us);
}

std::string version(const Json& side) {
  const Json& tool = side["tool"];
  return tool["version"].get<std::string>() + " (" + tool["git_sha"].get<std::string>() + ")";
}

const char* kind_of_times(const Json& comparison) {
  if (comparison["data"] == "paired") return ", times of assignment side by side";
  if (comparison["summary"]["methods_timed"] == 0) return ", no times in common";
  return ", frame times of separate runs";
}

std::string heading(const Json& comparison) {
  return "base " + version(comparison["base"]) + ", new " + version(comparison["new"]) + kind_of_times(comparison) +
         ", threshold " + text("%g", 100.0 * comparison["threshold"].get<double>()) + " %";
}

bool is_hint(const Json& compared_case) {
  return compared_case.contains("hint") && compared_case["hint"] != "none";
}

std::string word_of(const Json& compared_case) {
  if (compared_case.contains("verdict")) return compared_case["verdict"].get<std::string>();
  return is_hint(compared_case) ? compared_case["hint"].get<std::string>() + "?" : "-";
}

std::string instructions(const Json& compared_case) {
  return compared_case.contains("instructions") ? percent(compared_case["instructions"]["assign_ratio"]) : "-";
}

// name, verdict, base, new, change, interval, instructions, counts
constexpr std::array k_columns{"case", "time", "base us", "new us", "change", "95 % interval", "instr", "counts"};
Cells row_of(const Json& compared_case) {
  return {shown(compared_case["name"]),
          word_of(compared_case),
          micros(compared_case, "base_ns"),
          micros(compared_case, "new_ns"),
          compared_case.contains("ratio") ? percent(compared_case["ratio"]) : "-",
          interval(compared_case),
          instructions(compared_case),
          compared_case["counts"].get<std::string>()};
}

bool is_remarkable(const Json& compared_case) {
  return (compared_case.contains("verdict") && compared_case["verdict"] != "same") ||
         compared_case["counts"] != "same" ||
         (compared_case.contains("instructions") && compared_case["instructions"]["verdict"] != "same");
}

bool is_worse(const Json& compared_case) {
  return (compared_case.contains("verdict") && compared_case["verdict"] == "slower") ||
         compared_case["counts"] == "worse" ||
         (compared_case.contains("instructions") && compared_case["instructions"]["verdict"] == "more");
}

bool is_open(const Json& compared_case) {
  return is_hint(compared_case) || (compared_case.contains("verdict") && compared_case["verdict"] == "inconclusive");
}

const char* mark_of(const Json& compared_case) {
  return is_worse(compared_case) ? "!" : is_open(compared_case) ? "?" : is_remarkable(compared_case) ? "+" : " ";
}

// Of the marks that the table has.
std::string legend(const Json& cases) {
  const auto has = [&](const std::string& mark) {
    return std::any_of(cases.begin(), cases.end(),
                       [&](const Json& compared_case) { return mark_of(compared_case) == mark; });
  };
  const bool has_hint = std::any_of(cases.begin(), cases.end(), is_hint);
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

std::string list_text(const Json& lists) {
  return "lists differ in " + number_of(lists["frames"].get<std::uint64_t>(), "frame") + ", first in frame " +
         lists["frame"].dump() + ", cell " + lists["cell"].dump() + ", light " + lists["light"].dump() +
         ": only in the " + (lists["in"] == "new" ? "new" : "base") + " lists; " + lists["base_pairs"].dump() + " -> " +
         number_of(lists["new_pairs"].get<std::uint64_t>(), "pair");
}

// One line per difference of a case.
std::vector<std::string> details(const Json& compared_case) {
  std::vector<std::string> lines;
  if (compared_case.contains("lists")) lines.push_back(list_text(compared_case["lists"]));
  for (const Json& difference : compared_case["differences"])
    lines.push_back(difference["what"].get<std::string>().substr(1) + " " + difference["is"].get<std::string>() + ": " +
                    times_text(difference["base"], difference["new"]));
  if (compared_case.contains("place"))
    lines.push_back("deepest lost light: " + compared_case["place"].get<std::string>());
  return lines;
}

std::string summary_text(const Json& comparison) {
  const Json& summary = comparison["summary"];
  std::string text = number_of(summary["cases"].get<std::uint64_t>(), "case") + " in common:";
  const char* separator = " ";
  for (const char* word : {"faster", "slower", "same", "inconclusive", "counts_better", "counts_worse"}) {
    if (summary[word] == 0) continue;
    std::string name = word;
    std::replace(name.begin(), name.end(), '_', ' ');
    text += separator + summary[word].dump() + " " + name;
    separator = ", ";
  }
  const bool has_hints = summary["hints_longer"] != 0 || summary["hints_shorter"] != 0;
  if (summary["cases"] == 0)
    text += " nothing was compared";
  else if (*separator == ' ')
    text += has_hints ? " what is counted is the same" : " nothing has changed of what was compared";
  if (has_hints)
    text += "; hints of time: " + summary["hints_longer"].dump() + " longer, " + summary["hints_shorter"].dump() +
            " shorter";
  if (summary.contains("ratio"))
    text += "; geometric mean of " + number_of(summary["methods_timed"].get<std::uint64_t>(), "method") + " " +
            percent(summary["ratio"]) + " (" + interval(summary) + ")";
  for (const auto& [key, side] : {std::pair{"only_in_base", "base"}, std::pair{"only_in_new", "new"}})
    if (!comparison[key].empty())
      text += "; " + number_of(comparison[key].size(), "case") + " of the " + side + " not compared";
  return text;
}

// The left column of aligned() is a mark.
std::string table(const Json& cases) {
  std::vector<Cells> rows;
  const auto add = [&](const Cells& cells, const char* mark) {
    rows.push_back({mark});
    rows.back().insert(rows.back().end(), cells.begin(), cells.end());
  };
  add({k_columns.begin(), k_columns.end()}, " ");
  for (const Json& compared_case : cases) add(row_of(compared_case), mark_of(compared_case));
  std::string text;
  const std::vector<std::size_t> widths = widths_of(rows);
  for (const Cells& row : rows) text += aligned(row, widths);
  return text + legend(cases);
}

std::string markdown_row(const Cells& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + markdown_cell(cell) + " |";
  return row + "\n";
}

std::string markdown_table(const std::vector<const Json*>& cases) {
  std::string out = markdown_row({k_columns.begin(), k_columns.end()}) + "|---|---|---:|---:|---:|---:|---:|---|\n";
  for (const Json* compared_case : cases) out += markdown_row(row_of(*compared_case));
  return out;
}

std::string markdown_list(const char* title, const Json& lines) {
  if (lines.empty()) return "";
  std::string out = std::string("\n**") + title + "**\n\n";
  for (const Json& line : lines) out += "- " + markdown_cell(line.get<std::string>()) + "\n";
  return out;
}

Json details_of_all(const Json& cases) {
  Json lines = Json::array();
  for (const Json& compared_case : cases)
    for (const std::string& line : details(compared_case)) lines.push_back(shown(compared_case["name"]) + ": " + line);
  return lines;
}

}  // namespace

std::string comparison_text(const Json& comparison) {
  std::string out = heading(comparison) + "\n";
  if (!comparison["cases"].empty()) out += table(comparison["cases"]);
  for (const Json& line : details_of_all(comparison["cases"])) out += "counted: " + line.get<std::string>() + "\n";
  for (const Json& warning : comparison["warnings"]) out += "warning: " + warning.get<std::string>() + "\n";
  for (const Json& failure : comparison["failures"]) out += "FAILED " + failure.get<std::string>() + "\n";
  out += summary_text(comparison) + "\n";
  for (const Json& advice : comparison.value("advice", Json::array())) out += advice.get<std::string>() + "\n";
  return out;
}

std::string comparison_markdown(const Json& comparison) {
  std::vector<const Json*> remarkable, rest;
  for (const Json& compared_case : comparison["cases"])
    (is_remarkable(compared_case) ? remarkable : rest).push_back(&compared_case);
  std::string out = "### clusterbench: " + std::string(comparison["failures"].empty() ? "passed" : "failed") + "\n\n" +
                    markdown_cell(summary_text(comparison)) + "\n\n" + markdown_cell(heading(comparison)) + "\n";
  if (!remarkable.empty()) out += "\n" + markdown_table(remarkable);
  out += markdown_list("Failed", comparison["failures"]);
  out += markdown_list("What is counted", details_of_all(comparison["cases"]));
  out += markdown_list("Warnings", comparison["warnings"]);
  out += markdown_list("What to do", comparison.value("advice", Json::array()));
  if (!rest.empty())
    out += "\n<details><summary>" + number_of(rest.size(), "case") +
           " without a verdict or a change of counts</summary>\n\n" + markdown_table(rest) + "\n</details>\n";
  return out;
}

}  // namespace clusterbench::report
