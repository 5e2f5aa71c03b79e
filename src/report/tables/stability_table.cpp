#include "report/tables/stability_table.h"

#include <algorithm>

#include "report/cases/columns.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Churn;
using result::number;
using result::Stability;

const Cells k_stability_headings{"", "assigner", "changed", "max", "excess", "flickers", "excess"};

Cells method_row(const Case& result_case) {
  const Stability& steps = *result_case.stability;
  return {"",
          method_name(result_case),
          text_of(number<&Churn::mean>(steps.changed.method), "%.2f"),
          std::to_string(steps.changed.method.max),
          text_of(number<&result::ExcessChurn::ratio>(steps.excess_churn), "%.1f %%", 100.0),
          std::to_string(steps.flickers.method),
          text("%+.0f", static_cast<double>(steps.excess_flickers.count))};
}

Cells truth_row(const Stability& steps) {
  return {"",
          "(truth)",
          text_of(number<&Churn::mean>(steps.changed.truth), "%.2f"),
          std::to_string(steps.changed.truth.max),
          "",
          std::to_string(steps.flickers.truth),
          ""};
}

// Cases of a block with steps, once per method, since lists do not depend on their storage. The fewest changes first.
std::vector<const Case*> stability_lines(const std::vector<const Case*>& cases) {
  std::vector<const Case*> lines;
  for (const Case* result_case : cases) {
    if (!result_case->stability) continue;
    const bool is_known = std::any_of(
        lines.begin(), lines.end(), [&](const Case* line) { return method_name(*line) == method_name(*result_case); });
    if (!is_known) lines.push_back(result_case);
  }
  std::ranges::stable_sort(lines, {},
                           [](const Case* result_case) { return result_case->stability->changed.method.total; });
  return lines;
}

std::string stability_block(const std::string& block, const std::vector<const Case*>& lines) {
  const Stability& steps = *lines.front()->stability;
  std::vector<Cells> rows{k_stability_headings, truth_row(steps)};
  for (const Case* result_case : lines) rows.push_back(method_row(*result_case));
  const std::vector<std::size_t> widths = widths_of(rows);
  std::string out = " " + block + "\n  " + shown(steps.path);
  if (!steps.drift)
    out += "; at most " + text_of(number<&Stability::step_m>(steps), "%.3g", 1e3) + " mm and " +
           text_of(number<&Stability::step_deg>(steps), "%.3g") + " degrees each";
  out += "\n";
  if (steps.grids > 1) out += "  the grid follows the lights: cells themselves move\n";
  for (const Cells& row : rows) out += aligned(row, widths);
  return out;
}

}  // namespace

std::string stability_table(const result::Result& result) {
  std::string out, window;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    for (const CaseBlock& block : blocks_of(result.cases, scene)) {
      const std::vector<const Case*> lines = stability_lines(block.cases);
      if (lines.empty()) continue;
      blocks += stability_block(block.name, lines);
      window = std::to_string(lines.front()->stability->window);
    }
    if (!blocks.empty()) out += "stability of " + shown(scene.name) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out + "changed: pairs (cell, light) added or removed per step. flickers: changes back within " +
         window + " steps.\nexcess: more than the truth's own.\n";
}

}  // namespace clusterbench::report
