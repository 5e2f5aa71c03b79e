// A comparison for people: a table for terminals, Markdown for pull requests.

#include <algorithm>
#include <array>

#include "report/columns.h"
#include "report/compare.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(const Json& ratio) {
  return ratio.is_null() ? "-" : text("%+.2f %%", 100.0 * (ratio.get<double>() - 1.0));
}

std::string interval(const Json& one) {
  if (!one.contains("ci95")) return "-";
  if (one["ci95"][1].is_null()) return k_unknown_interval;
  return percent(one["ci95"][0]) + " .. " + percent(one["ci95"][1]);
}

std::string micros(const Json& one, const char* key) {
  if (!one.contains(key)) return "-";
  const double us = one[key].get<double>() / 1000.0;
  return text(us < 1000.0 ? "%.4g" : "%.0f", us);
}

std::string version(const Json& side) {
  const Json& tool = side["tool"];
  return tool["version"].get<std::string>() + " (" + tool["git_sha"].get<std::string>() + ")";
}

const char* kind_of_times(const Json& comparison) {
  if (comparison["data"] == "paired") return ", times of assignment side by side";
  if (comparison["summary"]["methods_timed"] == 0) return ", no times";
  return ", frame times of separate runs";
}

std::string heading(const Json& comparison) {
  return "base " + version(comparison["base"]) + ", new " + version(comparison["new"]) + kind_of_times(comparison) +
         ", threshold " + text("%g", 100.0 * comparison["threshold"].get<double>()) + " %";
}

bool is_hint(const Json& one) {
  return one.contains("hint") && one["hint"] != "none";
}

std::string word_of(const Json& one) {
  if (one.contains("verdict")) return one["verdict"].get<std::string>();
  return is_hint(one) ? one["hint"].get<std::string>() + "?" : "-";
}

std::string instructions(const Json& one) {
  return one.contains("instructions") ? percent(one["instructions"]["assign_ratio"]) : "-";
}

// name, verdict, base, new, change, interval, instructions, counts
constexpr std::array k_columns{"case", "time", "base us", "new us", "change", "95 % interval", "instr", "counts"};
Cells row_of(const Json& one) {
  return {shown(one["name"]),
          word_of(one),
          micros(one, "base_ns"),
          micros(one, "new_ns"),
          one.contains("ratio") ? percent(one["ratio"]) : "-",
          interval(one),
          instructions(one),
          one["counts"].get<std::string>()};
}

bool is_remarkable(const Json& one) {
  return (one.contains("verdict") && one["verdict"] != "same") || one["counts"] != "same" ||
         (one.contains("instructions") && one["instructions"]["verdict"] != "same");
}

bool is_worse(const Json& one) {
  return (one.contains("verdict") && one["verdict"] == "slower") || one["counts"] == "worse" ||
         (one.contains("instructions") && one["instructions"]["verdict"] == "more");
}

bool is_open(const Json& one) {
  return is_hint(one) || (one.contains("verdict") && one["verdict"] == "inconclusive");
}

const char* mark_of(const Json& one) {
  return is_worse(one) ? "!" : is_open(one) ? "?" : is_remarkable(one) ? "+" : " ";
}

// Of the marks that the table has.
std::string legend(const Json& cases) {
  const auto has = [&](const std::string& mark) {
    return std::any_of(cases.begin(), cases.end(), [&](const Json& one) { return mark_of(one) == mark; });
  };
  const bool has_hint = std::any_of(cases.begin(), cases.end(), is_hint);
  std::string out = has("!") ? "! slower, more instructions, or what is counted is worse.\n" : "";
  if (has("+")) out += "+ faster, fewer instructions, or what is counted is better.\n";
  if (has("?"))
    out += has_hint ? "? a hint: medians of separate runs differ beyond the threshold and their intervals.\n"
                    : "? inconclusive: too noisy to tell.\n";
  return out;
}

// The first place where two lists part, both values elsewhere.
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
std::vector<std::string> details(const Json& one) {
  std::vector<std::string> lines;
  if (one.contains("lists")) lines.push_back(list_text(one["lists"]));
  for (const Json& difference : one["differences"])
    lines.push_back(difference["what"].get<std::string>().substr(1) + " " + difference["is"].get<std::string>() + ": " +
                    times_text(difference["base"], difference["new"]));
  if (one.contains("place")) lines.push_back("deepest lost light: " + one["place"].get<std::string>());
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
  for (const Json& one : cases) add(row_of(one), mark_of(one));
  std::string text;
  const std::vector<std::size_t> widths = widths_of(rows);
  for (const Cells& row : rows) text += aligned(row, widths);
  return text + legend(cases);
}

std::string markdown_row(const Cells& cells) {
  std::string row = "|";
  for (const std::string& one : cells) row += " " + markdown_cell(one) + " |";
  return row + "\n";
}

std::string markdown_table(const std::vector<const Json*>& cases) {
  std::string out = markdown_row({k_columns.begin(), k_columns.end()}) + "|---|---|---:|---:|---:|---:|---:|---|\n";
  for (const Json* one : cases) out += markdown_row(row_of(*one));
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
  for (const Json& one : cases)
    for (const std::string& line : details(one)) lines.push_back(shown(one["name"]) + ": " + line);
  return lines;
}

}  // namespace

std::string comparison_text(const Json& comparison) {
  std::string out = heading(comparison) + "\n" + table(comparison["cases"]);
  for (const Json& line : details_of_all(comparison["cases"])) out += "counted: " + line.get<std::string>() + "\n";
  for (const Json& warning : comparison["warnings"]) out += "warning: " + warning.get<std::string>() + "\n";
  for (const Json& failure : comparison["failures"]) out += "FAILED " + failure.get<std::string>() + "\n";
  return out + summary_text(comparison) + "\n";
}

std::string comparison_markdown(const Json& comparison) {
  std::vector<const Json*> remarkable, rest;
  for (const Json& one : comparison["cases"]) (is_remarkable(one) ? remarkable : rest).push_back(&one);
  std::string out = "### clusterbench: " + std::string(comparison["failures"].empty() ? "passed" : "failed") + "\n\n" +
                    markdown_cell(summary_text(comparison)) + "\n\n" + markdown_cell(heading(comparison)) + "\n";
  if (!remarkable.empty()) out += "\n" + markdown_table(remarkable);
  out += markdown_list("Failed", comparison["failures"]);
  out += markdown_list("What is counted", details_of_all(comparison["cases"]));
  out += markdown_list("Warnings", comparison["warnings"]);
  if (!rest.empty())
    out += "\n<details><summary>" + number_of(rest.size(), "case") +
           " without a verdict or a change of counts</summary>\n\n" + markdown_table(rest) + "\n</details>\n";
  return out;
}

}  // namespace clusterbench::report
