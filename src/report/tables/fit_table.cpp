#include "report/tables/fit_table.h"

#include "report/cases/case_sides.h"
#include "report/cases/columns.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Ends;
using result::Extremes;
using result::Fit;
using result::FitSide;
using result::GridMoves;
using result::number;
using result::Saved;

const Cells k_headings{"",        "assigner", "storage", "grids",  "cells moved", "lists new", "unfitted",
                       "entries", "bytes",    "pairs",   "excess", "evaluated",   "frame"};

Cells row_of(const Case& result_case) {
  const Fit& fit = *result_case.fit;
  return {"",
          method_name(result_case),
          storage_name(result_case),
          std::to_string(fit.moves.changed),
          text_of(number<&Fit::moves, &GridMoves::cells>(fit), "%.0f %%", 100.0),
          text_of(number<&Fit::fitted, &FitSide::lists_changed>(fit), "%.1f %%", 100.0),
          text_of(number<&Fit::unfitted, &FitSide::lists_changed>(fit), "%.1f %%", 100.0),
          against_other(number<&Saved::index_entries>(fit.saved)),
          against_other(number<&Saved::bytes>(fit.saved)),
          against_other(number<&Saved::pairs>(fit.saved)),
          against_other(number<&Saved::false_positives>(fit.saved)),
          evaluated_against_other(fit.saved),
          text_of(number<&Case::timing, &result::Timing::fit, &result::FitTimes::ratio>(result_case), "x %.2f")};
}

std::string metres(const std::optional<double>& length) {
  return text_of(length, "%.4g");
}

std::string range_text(const Fit& fit) {
  return "asked for " + metres(number<&Ends::near>(fit.asked)) + " to " + metres(number<&Ends::far>(fit.asked)) +
         " m; begins at " + metres(number<&Extremes::min>(fit.near)) + " to " +
         metres(number<&Extremes::max>(fit.near)) + ", ends at " + metres(number<&Extremes::min>(fit.far)) + " to " +
         metres(number<&Extremes::max>(fit.far)) + " m";
}

}  // namespace

std::string fit_table(const result::Result& result) {
  std::string out;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    for (const CaseBlock& block : blocks_of(result.cases, scene)) {
      std::vector<Cells> rows{k_headings};
      const Fit* any = nullptr;
      for (const Case* result_case : block.cases) {
        if (!result_case->fit) continue;
        rows.push_back(row_of(*result_case));
        any = &*result_case->fit;
      }
      if (any == nullptr) continue;
      blocks += " " + block.name + "\n  " + range_text(*any) + "\n";
      blocks += aligned_rows(rows);
    }
    if (!blocks.empty()) out += "fitted slices of " + shown(scene.name) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "grids: frames with another grid than the frame before. cells moved, lists new: per frame; unfitted: lists "
         "new "
         "there.\nentries to frame: against the same case without fit; below 0 is saved. entries, bytes: high water. "
         "excess: false positives.\n";
}

}  // namespace clusterbench::report
