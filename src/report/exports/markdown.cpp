// The reasons of a failed run, and a table, as GitHub and GitLab render them. Only columns with a figure; the parts
// viewport and precision of a name only if they differ.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "report/cases/columns.h"
#include "report/exports/export_formats.h"

namespace clusterbench::report {
namespace {

using result::Figure;

// Four digits, or all digits of a count: 40.61, 1234.6, 102905.
std::string short_number(double value) {
  char text[48];
  std::snprintf(text, sizeof text,
                std::floor(value) == value ? "%.0f"
                : std::abs(value) < 1e3    ? "%.4g"
                                           : "%.1f",
                value);
  return text;
}

bool is_used(const Figure& figure, const ExportResult& result) {
  for (const ExportCase& export_case : result.cases)
    if (find_figure(export_case, figure.exported_as()) != nullptr) return true;
  return false;
}

// "assign time (ns)"; the unit is added only if the name does not contain it.
std::string heading(const Figure& figure) {
  std::string name(figure.exported_as());
  std::replace(name.begin(), name.end(), '_', ' ');
  return figure.unit == "ratio" || name.find(figure.unit) != std::string::npos
             ? name
             : name + " (" + std::string(figure.unit) + ")";
}

// Indices of the shown parts.
std::vector<std::size_t> shown_parts(const ExportResult& result) {
  std::vector<std::size_t> shown;
  if (result.cases.empty()) return shown;
  const auto& first = result.cases.front().parts;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool may_hide = first[i].first == "viewport" || first[i].first == "precision";
    const bool differs = std::any_of(result.cases.begin(), result.cases.end(),
                                     [&](const ExportCase& export_case) { return export_case.parts[i] != first[i]; });
    if (!may_hide || differs) shown.push_back(i);
  }
  return shown;
}

// Budgets, with the value and that of the baseline, and cases in which a plug-in broke down. "" if there are none.
std::string failed_list(const ExportResult& result) {
  if (result.failed.empty()) return "";
  std::string out = "**FAILED**\n\n";
  for (const std::string& sentence : result.failed) out += "- " + markdown_cell(sentence) + "\n";
  return out + "\n";
}

}  // namespace

std::string markdown(const ExportResult& result) {
  std::vector<const Figure*> columns;
  for (const Figure* figure : export_figures())
    if (is_used(*figure, result)) columns.push_back(figure);

  const std::vector<std::size_t> parts = shown_parts(result);
  std::string out = failed_list(result) + "|", rule = "|";
  for (const std::size_t part : parts) {
    out += " " + result.cases.front().parts[part].first + " |";
    rule += "---|";
  }
  for (const Figure* column : columns) {
    out += " " + heading(*column) + " |";
    rule += "---:|";
  }
  out += "\n" + rule + "\n";
  for (const ExportCase& export_case : result.cases) {
    out += "|";
    for (const std::size_t part : parts) out += " " + markdown_cell(export_case.parts[part].second) + " |";
    for (const Figure* column : columns) {
      const Measured* figure = find_figure(export_case, column->exported_as());
      out += " " + (figure == nullptr ? "" : short_number(figure->value)) + " |";
    }
    out += "\n";
  }
  return out;
}

}  // namespace clusterbench::report
