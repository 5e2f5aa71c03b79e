#include "report/tables/reaction_table.h"

#include "report/cases/case_sides.h"
#include "report/cases/columns.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::number;
using result::Reaction;
using result::Saved;

std::string of_frames(const Case& result_case, std::uint64_t frames) {
  return std::to_string(frames) + " of " + std::to_string(result_case.frames);
}

std::string tiles_text(const result::Counts2& tiles) {
  return std::to_string(tiles[0]) + "x" + std::to_string(tiles[1]);
}

const Cells k_reaction_headings{"",        "assigner", "storage", "reacted", "over",   "fewest",
                                "changed", "entries",  "bytes",   "pairs",   "excess", "evaluated"};

Cells reaction_row(const Case& result_case) {
  const Reaction& react = *result_case.react;
  const Saved saved = react.saved.value_or(Saved());
  return {"",
          method_name(result_case),
          storage_name(result_case),
          of_frames(result_case, react.frames.reacted),
          std::to_string(react.frames.over),
          tiles_text(react.tiles.fewest),
          std::to_string(react.moves.changed),
          against_other(number<&Saved::index_entries>(saved)),
          against_other(number<&Saved::bytes>(saved)),
          against_other(number<&Saved::pairs>(saved)),
          against_other(number<&Saved::false_positives>(saved)),
          evaluated_against_other(saved)};
}

std::string reaction_text(const Reaction& react) {
  const bool is_of_lists = react.to == "entries";
  return "  tiles asked for: " + tiles_text(react.tiles.asked) + "; room for " + std::to_string(react.most) +
         (is_of_lists ? " entries of " + shown(react.of.value_or("")) : " words of masks") + ", needed " +
         text_of(number<&result::Extremes::min>(react.needed), "%.0f") + " to " +
         text_of(number<&result::Extremes::max>(react.needed), "%.0f") + "\n";
}

const Cells k_fallback_headings{"", "assigner", "storage", "frames", "cells", "entries", "bytes", "evaluated"};

Cells fallback_row(const Case& result_case) {
  const result::Fallback& fallback = *result_case.fallback;
  return {"",
          method_name(result_case),
          storage_name(result_case),
          of_frames(result_case, fallback.frames),
          std::to_string(fallback.cells),
          against_other(number<&Saved::index_entries>(fallback.saved)),
          against_other(number<&Saved::bytes>(fallback.saved)),
          evaluated_against_other(fallback.saved)};
}

std::string no_text(const result::Fallback&) {
  return "";
}

// A block per grid, with lines of its cases that have a part.
template <class Part>
std::string table_beside(const result::Result& result, std::optional<Part> Case::*part, const std::string& title,
                         const Cells& headings, Cells (*to_row)(const Case&), std::string (*to_text)(const Part&)) {
  std::string out;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    for (const CaseBlock& block : blocks_of(result.cases, scene)) {
      std::vector<Cells> rows{headings};
      const Part* any = nullptr;
      for (const Case* result_case : block.cases) {
        if (!(result_case->*part)) continue;
        rows.push_back(to_row(*result_case));
        any = &*(result_case->*part);
      }
      if (any == nullptr) continue;
      blocks += " " + block.name + "\n" + to_text(*any);
      const std::vector<std::size_t> widths = widths_of(rows);
      for (const Cells& row : rows) blocks += aligned(row, widths);
    }
    if (!blocks.empty()) out += title + " of " + shown(scene.name) + "\n" + blocks + "\n";
  }
  return out;
}

}  // namespace

std::string reaction_table(const result::Result& result) {
  const std::string out =
      table_beside(result, &Case::react, "tiles that react", k_reaction_headings, reaction_row, reaction_text);
  if (out.empty()) return "";
  return "\n" + out +
         "reacted: frames with other tiles than asked for. over: frames whose own tiles have more than there is\nroom "
         "for; a frame after one has larger tiles.\n"
         "changed: frames with other tiles than the frame before. entries to evaluated: against the same case in the "
         "tiles "
         "asked for; below 0 is saved. entries, bytes: high water. excess: false positives.\n";
}

std::string fallback_table(const result::Result& result) {
  const std::string out =
      table_beside(result, &Case::fallback, "lists that have no room", k_fallback_headings, fallback_row, no_text);
  if (out.empty()) return "";
  return "\n" + out +
         "frames: with a cell that reads all lights for want of room. cells: such cells, over all frames. entries to "
         "evaluated: against the same case with room for all; below 0 is saved.\n";
}

}  // namespace clusterbench::report
