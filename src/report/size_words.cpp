#include "report/size_words.h"

#include <algorithm>

#include "core/text.h"
#include "report/columns.h"

namespace clusterbench::report {

std::string rule_text(const AllocationRules& rules) {
  const char* rounding = rules.rounding == Rounding::page           ? ", rounded up to whole pages of 4 KiB"
                         : rules.rounding == Rounding::power_of_two ? ", rounded up to a power of two bytes"
                                                                    : "";
  return "high water x " + text("%g", rules.margin) + rounding;
}

std::string worst_text(const SizedBuffer& buffer) {
  return "camera " + buffer.worst_camera + ", frame " + std::to_string(buffer.worst_frame) +
         (buffer.worst_cell.is_null() ? "" : ", cell " + buffer.worst_cell.dump());
}

std::string share_text(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "-" : text("%.2f %%", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::vector<std::string> grid_notes(const SizedStructure& structure) {
  std::vector<std::string> notes;
  for (const nlohmann::ordered_json* result_case : structure.cases) {
    const nlohmann::ordered_json& grid = (*result_case)["grid"];
    if (!grid.contains("note")) continue;
    const auto note = grid["note"].get<std::string>();
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  }
  return notes;
}

std::string dropped_text(const SizedStructure& structure) {
  std::uint64_t pairs = 0, cells = 0, frames = 0;
  for (const nlohmann::ordered_json* result_case : structure.cases) {
    const nlohmann::ordered_json& overflow = (*result_case)["buffers"]["overflow"];
    pairs += overflow["dropped_pairs"].get<std::uint64_t>();
    cells += overflow["cells"].get<std::uint64_t>();
    frames += overflow["frames"].get<std::uint64_t>();
  }
  if (pairs == 0) return "";
  return number_of(pairs, "pair") + " dropped in " + number_of(cells, "cell") + " of " + number_of(frames, "frame");
}

}  // namespace clusterbench::report
