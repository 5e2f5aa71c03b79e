#include "report/fit_table.h"

#include "report/case_sides.h"
#include "report/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

const Cells k_headings{"",        "assigner", "storage", "grids",  "cells moved", "lists new", "unfitted",
                       "entries", "bytes",    "pairs",   "excess", "evaluated",   "frame"};

Cells row_of(const Json& result_case) {
  const Json& saved = result_case["fit"]["saved"];
  const auto saving = [&](const char* key) { return against_other(saved, key); };
  const Json& frame = result_case.contains("timing") ? result_case["timing"] : Json();
  return {"",
          method_name(result_case),
          storage_name(result_case),
          text_at(result_case, "/fit/moves/changed", "%.0f"),
          text_at(result_case, "/fit/moves/cells", "%.0f %%", 100.0),
          text_at(result_case, "/fit/fitted/lists_changed", "%.1f %%", 100.0),
          text_at(result_case, "/fit/unfitted/lists_changed", "%.1f %%", 100.0),
          saving("index_entries"),
          saving("bytes"),
          saving("pairs"),
          saving("false_positives"),
          evaluated_against_other(saved),
          frame.is_object() ? text_at(result_case, "/timing/fit/ratio", "x %.2f") : "-"};
}

std::string range_text(const Json& fit) {
  const auto metres = [&](const char* pointer) { return text_at(fit, pointer, "%.4g"); };
  return "asked for " + metres("/asked/near") + " to " + metres("/asked/far") + " m; begins at " + metres("/near/min") +
         " to " + metres("/near/max") + ", ends at " + metres("/far/min") + " to " + metres("/far/max") + " m";
}

}  // namespace

std::string fit_table(const Json& result) {
  std::string out;
  for (const Json& scene : result["scenes"]) {
    std::string blocks;
    for (const std::string& block : blocks_of(result["cases"], scene)) {
      std::vector<Cells> rows{k_headings};
      const Json* any = nullptr;
      for (const Json& result_case : result["cases"]) {
        if (!result_case.contains("fit") || result_case["scene"] != scene["name"] || block_of(result_case) != block)
          continue;
        rows.push_back(row_of(result_case));
        any = &result_case["fit"];
      }
      if (any == nullptr) continue;
      blocks += " " + block + "\n  " + range_text(*any) + "\n";
      const std::vector<std::size_t> widths = widths_of(rows);
      for (const Cells& row : rows) blocks += aligned(row, widths);
    }
    if (!blocks.empty()) out += "fitted slices of " + shown(scene["name"]) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "grids: frames with another grid than the frame before. cells moved, lists new: per frame; unfitted: lists "
         "new "
         "there.\nentries to frame: against the same case without fit; below 0 is saved. entries, bytes: high water. "
         "excess: false positives.\n";
}

}  // namespace clusterbench::report
