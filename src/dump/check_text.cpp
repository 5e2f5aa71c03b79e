#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "core/text.h"
#include "dump/judge.h"
#include "dump/lost_lights.h"

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

// From which ends cells are counted here, where the dump counts from others: ", row from the top".
std::string counting_text(const result::CheckedDump& checked) {
  const bool is_world = checked.grid_kind == "world";
  std::string out;
  if (checked.first_row == "bottom") out += is_world ? ", y as from first_row 'top'" : ", row from the top";
  if (checked.first_slice == "far") out += is_world ? ", z from the lowest" : ", slice from the near end";
  return out;
}

// `counting`: as above.
std::string cell_text(const result::CellIndex& cell, const std::string& counting) {
  return "(" + number(cell[0]) + ", " + number(cell[1]) + ", " + number(cell[2]) + ")" + counting;
}

// With this many significant digits, or all those before the point, and without an exponent: "0.0314", "12.3", "1570".
std::string significant(double value, int digits = 3) {
  constexpr double k_least = 0.001;
  if (value > 0.0 && value < k_least) return "below 0.001";
  int decimals = digits - 1;
  for (double size = std::abs(value); size >= 10.0 && decimals > 0; size /= 10.0) --decimals;
  for (double size = std::abs(value); size > 0.0 && size < 1.0; size *= 10.0) ++decimals;
  std::string text = format(("%." + std::to_string(decimals) + "f").c_str(), value);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// "0.0314 mm", "12.3 mm", "1.57 m"
std::string length_text(double mm) {
  constexpr double k_shown_as_a_metre = 999.5;
  if (!std::isfinite(mm)) return "all of its endless range";
  return mm >= k_shown_as_a_metre ? significant(mm / 1000.0) + " m" : significant(mm) + " mm";
}

std::string faults_text(const std::vector<result::ReadingFault>& faults, std::uint64_t count,
                        const std::string& counting) {
  std::string out;
  constexpr std::size_t k_most_shown = 3;
  const std::size_t shown = std::min(k_most_shown, faults.size());
  for (const result::ReadingFault& fault : std::span(faults).first(shown)) {
    out += "    ";
    if (!fault.buffer.empty()) out += "buffer '" + printable(fault.buffer) + "', byte " + number(fault.byte) + ": ";
    out += printable(fault.message) + ", in cell " + cell_text(fault.cell, counting) + "\n";
  }
  if (count > shown) out += "    and " + number(count - shown) + " more\n";
  return out;
}

std::string twice_text(std::uint64_t count) {
  return number_of(count, "pair") + " of a cell and a light " + (count == 1 ? "is" : "are") + " twice in " +
         (count == 1 ? "its list" : "their lists");
}

std::string other_text(const result::CheckedSet& set) {
  const result::OtherReading& other = *set.other_reading;
  std::vector<std::string> changes;
  for (const std::string& change : {other.order, other.lists, other.camera, other.lights})
    if (!change.empty()) changes.push_back(change);
  std::string out = "  Probably it is the description: with " + joined(changes, " and ");
  if (set.error->lost_pairs == 0)
    return out + " most listed pairs are true, and " + number_of(other.lost_pairs, "pair") + " would be lost.\n";
  return out + ", " + number_of(other.lost_pairs, "pair") + " would be lost in place of " +
         number(set.error->lost_pairs) + ".\n";
}

// Lists of any length that lose lights nearly alone where they are longest.
bool seems_limited(const result::CheckedSet& set) {
  constexpr std::uint64_t k_fewest = 10;
  constexpr double k_share = 0.9;
  const result::ListErrors& error = *set.error;
  return !set.other_reading && set.longest_list > 0 && error.lost_pairs >= k_fewest &&
         static_cast<double>(error.lost_in_longest_lists) >= k_share * static_cast<double>(error.lost_pairs);
}

std::string lost_text(const result::CheckedSet& set, std::size_t most, bool is_world, const std::string& counting) {
  std::string out;
  const std::size_t shown = std::min(most, set.lost.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const result::LostInCell& lost = set.lost[i];
    out += "    light " + number(lost.light) + ", cell " + cell_text(lost.cell, counting) + " (number " +
           number(lost.row) + (is_world ? ", z " : ", depth ") + significant(lost.from_m, 4) + " to " +
           significant(lost.to_m, 4) + " m): reaches in by " + length_text(lost.reach_mm) + ", " +
           significant(lost.reach_percent) + " % of its range" + (lost.is_within_rounding ? ", within rounding" : "") +
           "\n";
  }
  if (shown > 0 && set.error->lost_pairs > shown) out += "    and " + number(set.error->lost_pairs - shown) + " more\n";
  if (set.error->lost_in_full_lists > 0)
    out += "    " + number(set.error->lost_in_full_lists) + " of " + number(set.error->lost_pairs) +
           " lost in cells whose list is full (lists[].per_cell): there was no room for more lights\n";
  else if (seems_limited(set))
    out += "    " + number(set.error->lost_in_longest_lists) + " of " + number(set.error->lost_pairs) +
           " lost in cells whose list is as long as the longest, " + number(set.longest_list) +
           ": does the engine take no more lights for a cell?\n";
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
  if (!set.other_reading && error.false_positives > error.listed_pairs / 2)
    out += "; are camera, lights.space, grid.slices, ranges and cones described rightly?";
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
  if (set.verdict == "twice") return twice_text(set.reading.twice_count);
  const result::ListErrors& error = *set.error;
  const std::uint64_t beyond = error.lost_pairs - error.lost_within_rounding;
  if (set.verdict == "rounding")
    return number_of(error.lost_pairs, "pair") + " lost, all within rounding; the deepest reaches in by " +
           length_text(error.deepest_mm) +
           " (the dump's `rounding`, 32 roundoffs if it has none, explains that; never " + "more than " +
           length_text(1000.0 * k_most_rounding_m) + " or " + significant(100.0 * k_most_rounding_share) +
           " % of the range)";
  std::string out = "LOST: " + number_of(beyond, "pair") + " of a cell and a light";
  if (error.lost_within_rounding > 0) out += ", and " + number(error.lost_within_rounding) + " within rounding";
  out += " (" + number_of(error.lost_lights, "light");
  if (error.absent_lights > 0) out += ", " + number(error.absent_lights) + " in no list at all";
  return out + "); the deepest reaches in by " + length_text(error.deepest_mm) + ", " +
         significant(error.deepest_percent) + " % of its range";
}

// What is wrong with the entries themselves; of lists that are none, the likeliest reading first.
std::string reading_text(const result::CheckedSet& set, const std::string& counting) {
  const result::ListReading& reading = set.reading;
  const std::string faults = faults_text(reading.faults, reading.fault_count, counting);
  if (set.verdict == "unreadable")
    return faults + (reading.likely_reading ? "" : "    none of the readings that were tried is without faults\n");
  std::string out = faults;
  if (reading.twice_count > 0 && set.verdict != "twice") out += "    " + twice_text(reading.twice_count) + ":\n";
  return out + faults_text(reading.twice, reading.twice_count, counting);
}

std::string remarks_text(const result::CheckedSet& set) {
  std::string out;
  for (const std::string& remark : set.remarks) out += "  Is the description right? " + printable(remark) + "\n";
  return out;
}

std::string set_text(const result::CheckedSet& set, std::size_t most, bool is_world, const std::string& counting) {
  std::string out;
  if (set.other_reading) out += other_text(set);
  if (set.reading.likely_reading) out += "  Probably it is the description: " + *set.reading.likely_reading + "\n";
  out += remarks_text(set) + "  " + printable(set.name) + ": " + verdict_text(set) + "\n" + reading_text(set, counting);
  if (set.error) out += lost_text(set, most, is_world, counting) + errors_text(set);
  out += "    " + number_of(set.bytes, "byte");
  if (set.verdict != "unreadable") out += ", longest list " + number(set.longest_list);
  if (set.longest_cell && set.verdict != "unreadable") out += " in cell " + cell_text(*set.longest_cell, counting);
  return out + "\n";
}

std::string left_out_text(const std::vector<std::string>& methods) {
  if (methods.empty()) return "";
  return "  methods of clusterbench left out, since this frame has more than " + number(k_most_quick_steps) +
         " cells and true pairs: " + joined(methods) + " (--methods all, or names)\n";
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
  std::string out = printable(checked.name) + (checked.engine.empty() ? "" : " (" + printable(checked.engine) + ")") +
                    ": " + checked.grid_kind + " grid of " + number(checked.cells[0]) + " x " +
                    number(checked.cells[1]) + " x " + number(checked.cells[2]) + " cells, " +
                    number_of(checked.points, "point light") + " and " + number_of(checked.spots, "spot light") + "\n";
  for (const result::CheckedSet& set : checked.sets)
    out += set_text(set, most, checked.grid_kind == "world", counting_text(checked));
  return out + methods_text(checked.methods) + left_out_text(checked.methods_left_out);
}

}  // namespace clusterbench::dump
