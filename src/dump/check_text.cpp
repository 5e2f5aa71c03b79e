#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "core/text.h"
#include "dump/judge.h"

namespace clusterbench::dump {
namespace {

std::string format(const char* form, double value) {
  char text[48];
  std::snprintf(text, sizeof text, form, value);
  return text;
}

std::string number(std::uint64_t value) {
  return std::to_string(value);
}

std::string cell_text(const result::CellIndex& cell) {
  return "(" + number(cell[0]) + ", " + number(cell[1]) + ", " + number(cell[2]) + ")";
}

// "0.0314 mm", "12.3 mm", "1.57 m"
std::string length_text(double mm) {
  if (!std::isfinite(mm)) return "all of its endless range";
  return mm >= 1000.0 ? format("%.3g m", mm / 1000.0) : format("%.3g mm", mm);
}

std::string faults_text(const result::ListReading& reading) {
  std::string out;
  constexpr std::size_t k_most_shown = 3;
  const std::size_t shown = std::min(k_most_shown, reading.faults.size());
  for (const result::ReadingFault& fault : std::span(reading.faults).first(shown)) {
    out += "    ";
    if (!fault.buffer.empty()) out += "buffer '" + fault.buffer + "', byte " + number(fault.byte) + ": ";
    out += fault.message + ", in cell " + cell_text(fault.cell) + "\n";
  }
  if (reading.fault_count > shown) out += "    and " + number(reading.fault_count - shown) + " more\n";
  return out;
}

std::string other_text(const result::CheckedSet& set) {
  const result::OtherReading& other = *set.other_reading;
  std::string out = "  Probably it is the description: with grid.axes '" + other.axes + "', first_row '" +
                    other.first_row + "', first_slice '" + other.first_slice + "'";
  if (!other.camera.empty()) out += " and " + other.camera;
  if (set.error->lost_pairs == 0)
    return out + " the listed pairs are true, and " + number_of(other.lost_pairs, "pair") + " would be lost.\n";
  return out + ", " + number_of(other.lost_pairs, "pair") + " would be lost in place of " +
         number(set.error->lost_pairs) + ".\n";
}

std::string lost_text(const result::CheckedSet& set, std::size_t most, bool is_world) {
  std::string out;
  const std::size_t shown = std::min(most, set.lost.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const result::LostInCell& lost = set.lost[i];
    out += "    light " + number(lost.light) + ", cell " + cell_text(lost.cell) + " (number " + number(lost.row) +
           (is_world ? ", z " : ", depth ") + format("%.4g", lost.from_m) + " to " + format("%.4g", lost.to_m) +
           " m): reaches in by " + length_text(lost.reach_mm) + ", " + format("%.3g", lost.reach_percent) +
           " % of its range" + (lost.is_within_rounding ? ", within rounding" : "") + "\n";
  }
  if (set.error->lost_pairs > shown) out += "    and " + number(set.error->lost_pairs - shown) + " more\n";
  return out;
}

std::string errors_text(const result::CheckedSet& set) {
  const result::ListErrors& error = *set.error;
  std::string out = "    " + number_of(error.true_pairs, "true pair") + " of a cell and a light; listed are " +
                    number(error.listed_pairs) + ", " + number(error.false_positives) + " of them for nothing";
  if (error.true_pairs > 0)
    out += format(" (%.1f %% of the true ones)",
                  100.0 * static_cast<double>(error.false_positives) / static_cast<double>(error.true_pairs));
  if (error.undecided > 0) out += "; " + number(error.undecided) + " undecided";
  return out + "\n";
}

std::string verdict_text(const result::CheckedSet& set) {
  if (set.verdict == "unreadable")
    return "these are no lists: " + number_of(set.reading.fault_count, "value") + " cannot be right";
  if (set.verdict == "right") return "right: no light is lost";
  if (set.verdict == "empty") return "no light reaches a cell, so nothing was checked";
  if (set.verdict == "misread" && set.error->lost_pairs == 0)
    return "no light is lost, but " + number(set.error->false_positives) + " of " + number(set.error->listed_pairs) +
           " listed pairs are not true";
  if (set.verdict == "twice") return number_of(set.reading.fault_count, "light") + " twice in a list";
  const result::ListErrors& error = *set.error;
  const std::uint64_t beyond = error.lost_pairs - error.lost_within_rounding;
  if (set.verdict == "rounding")
    return number_of(error.lost_pairs, "pair") + " lost, all within rounding; the deepest reaches in by " +
           length_text(error.deepest_mm);
  std::string out = "LOST: " + number_of(beyond, "pair") + " of a cell and a light";
  if (error.lost_within_rounding > 0) out += ", and " + number(error.lost_within_rounding) + " within rounding";
  out += " (" + number_of(error.lost_lights, "light");
  if (error.absent_lights > 0) out += ", " + number(error.absent_lights) + " in no list at all";
  return out + "); the deepest reaches in by " + length_text(error.deepest_mm) + ", " +
         format("%.3g", error.deepest_percent) + " % of its range";
}

std::string set_text(const result::CheckedSet& set, std::size_t most, bool is_world) {
  std::string out;
  if (set.other_reading) out += other_text(set);
  out += "  " + set.name + ": " + verdict_text(set) + "\n" + faults_text(set.reading);
  if (set.verdict == "unreadable")
    out += set.reading.likely_reading ? "    " + *set.reading.likely_reading + "\n"
                                      : std::string("    none of the readings that were tried is without faults\n");
  if (set.error) out += lost_text(set, most, is_world) + errors_text(set);
  out += "    " + number_of(set.bytes, "byte") + ", longest list " + number(set.longest_list);
  if (set.longest_cell) out += " in cell " + cell_text(*set.longest_cell);
  return out + "\n";
}

std::string methods_text(const std::vector<result::CheckedMethod>& methods) {
  if (methods.empty()) return "";
  char line[160];
  std::snprintf(line, sizeof line, "  %-28s %10s %10s %8s %12s\n", "methods of clusterbench", "pairs", "for nothing",
                "lost", "bytes packed");
  std::string out = line;
  for (const result::CheckedMethod& method : methods) {
    std::snprintf(
        line, sizeof line, "    %-26s %10llu %11llu %8llu %12llu\n", method.name.c_str(),
        static_cast<unsigned long long>(method.listed_pairs), static_cast<unsigned long long>(method.false_positives),
        static_cast<unsigned long long>(method.lost_pairs), static_cast<unsigned long long>(method.packed_bytes));
    out += line;
  }
  return out;
}

}  // namespace

std::string check_text(const result::CheckedDump& checked, std::size_t most) {
  std::string out = checked.name + (checked.engine.empty() ? "" : " (" + checked.engine + ")") + ": " +
                    checked.grid_kind + " grid of " + number(checked.cells[0]) + " x " + number(checked.cells[1]) +
                    " x " + number(checked.cells[2]) + " cells, " + number_of(checked.points, "point light") + " and " +
                    number_of(checked.spots, "spot light") + "\n";
  for (const result::CheckedSet& set : checked.sets) out += set_text(set, most, checked.grid_kind == "world");
  return out + methods_text(checked.methods);
}

}  // namespace clusterbench::dump
