// Comma-separated values (RFC 4180, lines end in a line feed): a row per case, with a column for each part of its name.
// The columns do not depend on the measured figures, and include their units; a figure that a case does not have is an
// empty field.

#include <cmath>
#include <string_view>

#include "report/exports/export_formats.h"

namespace clusterbench::report {
namespace {

using result::Figure;

// A spreadsheet runs a cell that begins like a formula: a leading apostrophe makes it text. Names come from scene
// files, so any author can have written them.
std::string inert(const std::string& text) {
  const bool is_formula = !text.empty() && std::string_view("=+-@\t\r\n").find(text.front()) != std::string_view::npos;
  return is_formula ? "'" + text : text;
}

std::string field(const std::string& name) {
  std::string text = inert(name);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// All digits, without ".0" after counts.
std::string exact_number(double value) {
  constexpr double k_exact_integers = 9007199254740992.0;
  const bool is_whole = std::floor(value) == value && std::abs(value) < k_exact_integers;
  return is_whole ? std::to_string(static_cast<long long>(value)) : nlohmann::json(value).dump();
}

bool has_column(const Figure& figure, const ExportResult& result) {
  return figure.is_headline || result.all || (figure.is_of_device && result.has_devices);
}

// "assign_time_ns"; the unit is added only if the name does not contain it.
std::string csv_column(const Figure& figure) {
  std::string name(figure.exported_as());
  if (figure.unit == "ratio" || name.find(figure.unit) != std::string::npos) return name;
  const std::string unit = figure.unit == "pairs/s" ? "pairs_per_s" : std::string(figure.unit);
  return name + "_" + unit;
}

std::string heading(const ExportResult& result) {
  std::string line = "id,name,scene,camera,viewport,grid,assigner,precision,storage";
  if (result.has_machines) line += ",machine";
  if (result.has_devices) line += ",device";
  for (const Figure* figure : export_figures()) {
    if (!has_column(*figure, result)) continue;
    const std::string name = csv_column(*figure);
    line += "," + name;
    if (figure->interval != nullptr) line += "," + name + "_low," + name + "_high";
  }
  return line + "\n";
}

std::string row(const ExportResult& result, const ExportCase& export_case) {
  std::string line = field(export_case.id) + "," + field(export_case.name);
  for (const auto& [part, text] : export_case.parts) line += "," + field(text);
  for (const Figure* figure : export_figures()) {
    if (!has_column(*figure, result)) continue;
    const Measured* found = find_figure(export_case, figure->exported_as());
    line += "," + (found == nullptr ? "" : exact_number(found->value));
    if (figure->interval == nullptr) continue;
    const bool is_known = found != nullptr && found->ci95.is_known();
    line += is_known ? "," + exact_number(found->ci95.low) + "," + exact_number(found->ci95.high) : ",,";
  }
  return line + "\n";
}

}  // namespace

std::string csv(const ExportResult& result) {
  std::string out = heading(result);
  for (const ExportCase& export_case : result.cases) out += row(result, export_case);
  return out;
}

}  // namespace clusterbench::report
