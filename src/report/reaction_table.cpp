#include "report/reaction_table.h"

#include <functional>

#include "report/case_sides.h"
#include "report/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string of_frames(const Json& result_case, const char* pointer) {
  return text_at(result_case, pointer, "%.0f") + " of " + text_at(result_case, "/frames", "%.0f");
}

std::string tiles_text(const Json& tiles) {
  return std::to_string(tiles[0].get<int>()) + "x" + std::to_string(tiles[1].get<int>());
}

const Cells k_reaction_headings{"",        "assigner", "storage", "reacted", "over",   "fewest",
                                "changed", "entries",  "bytes",   "pairs",   "excess", "evaluated"};

Cells reaction_row(const Json& result_case) {
  const Json& react = result_case["react"];
  const Json saved = react.contains("saved") ? react["saved"] : Json{{"evaluated", Json::object()}};
  const auto saving = [&](const char* key) { return against_other(saved, key); };
  return {"",
          method_name(result_case),
          storage_name(result_case),
          of_frames(result_case, "/react/frames/reacted"),
          text_at(result_case, "/react/frames/over", "%.0f"),
          tiles_text(react["tiles"]["fewest"]),
          text_at(result_case, "/react/moves/changed", "%.0f"),
          saving("index_entries"),
          saving("bytes"),
          saving("pairs"),
          saving("false_positives"),
          evaluated_against_other(saved)};
}

std::string reaction_text(const Json& react) {
  const bool is_of_lists = react["to"] == "entries";
  return "tiles asked for: " + tiles_text(react["tiles"]["asked"]) + "; room for " + text_at(react, "/most", "%.0f") +
         (is_of_lists ? " entries of " + shown(react["of"]) : " words of masks") + ", needed " +
         text_at(react, "/needed/min", "%.0f") + " to " + text_at(react, "/needed/max", "%.0f");
}

const Cells k_fallback_headings{"", "assigner", "storage", "frames", "cells", "entries", "bytes", "evaluated"};

Cells fallback_row(const Json& result_case) {
  const Json& saved = result_case["fallback"]["saved"];
  return {"",
          method_name(result_case),
          storage_name(result_case),
          of_frames(result_case, "/fallback/frames"),
          text_at(result_case, "/fallback/cells", "%.0f"),
          against_other(saved, "index_entries"),
          against_other(saved, "bytes"),
          evaluated_against_other(saved)};
}

// A block per grid with lines of its cases that have a part.
std::string table_beside(const Json& result, const char* part, const std::string& title, const Cells& headings,
                         const std::function<Cells(const Json&)>& to_row,
                         const std::function<std::string(const Json&)>& to_text) {
  std::string out;
  for (const Json& scene : result["scenes"]) {
    std::string blocks;
    for (const std::string& block : blocks_of(result["cases"], scene)) {
      std::vector<Cells> rows{headings};
      const Json* any = nullptr;
      for (const Json& result_case : result["cases"]) {
        if (!result_case.contains(part) || result_case["scene"] != scene["name"] || block_of(result_case) != block)
          continue;
        rows.push_back(to_row(result_case));
        any = &result_case[part];
      }
      if (any == nullptr) continue;
      blocks += " " + block + "\n" + to_text(*any);
      const std::vector<std::size_t> widths = widths_of(rows);
      for (const Cells& row : rows) blocks += aligned(row, widths);
    }
    if (!blocks.empty()) out += title + " of " + shown(scene["name"]) + "\n" + blocks + "\n";
  }
  return out;
}

}  // namespace

std::string reaction_table(const Json& result) {
  const std::string out = table_beside(result, "react", "tiles that react", k_reaction_headings, reaction_row,
                                       [](const Json& react) { return "  " + reaction_text(react) + "\n"; });
  if (out.empty()) return "";
  return "\n" + out +
         "reacted: frames with other tiles than asked for. over: frames whose own tiles have more than there is\nroom "
         "for; a frame after one has larger tiles.\n"
         "changed: frames with other tiles than the frame before. entries to evaluated: against the same case in the "
         "tiles "
         "asked for; below 0 is saved. entries, bytes: high water. excess: false positives.\n";
}

std::string fallback_table(const Json& result) {
  const std::string out = table_beside(result, "fallback", "lists that have no room", k_fallback_headings, fallback_row,
                                       [](const Json&) { return std::string(); });
  if (out.empty()) return "";
  return "\n" + out +
         "frames: with a cell that reads all lights for want of room. cells: such cells, over all frames. entries to "
         "evaluated: against the same case with room for all; below 0 is saved.\n";
}

}  // namespace clusterbench::report
