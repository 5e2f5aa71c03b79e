#include "report/stability_table.h"

#include <algorithm>

#include "report/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

const Cells k_stability_headings{"", "assigner", "changed", "max", "excess", "flickers", "excess"};

Cells method_row(const Json& result_case) {
  return {"",
          method_name(result_case),
          text_at(result_case, "/stability/changed/method/mean", "%.2f"),
          text_at(result_case, "/stability/changed/method/max", "%.0f"),
          text_at(result_case, "/stability/excess_churn/ratio", "%.1f %%", 100.0),
          text_at(result_case, "/stability/flickers/method", "%.0f"),
          text_at(result_case, "/stability/excess_flickers/count", "%+.0f")};
}

Cells truth_row(const Json& result_case) {
  return {"",
          "(truth)",
          text_at(result_case, "/stability/changed/truth/mean", "%.2f"),
          text_at(result_case, "/stability/changed/truth/max", "%.0f"),
          "",
          text_at(result_case, "/stability/flickers/truth", "%.0f"),
          ""};
}

// Cases of a block with steps, once per method: lists do not depend on their storage. The fewest changes first.
std::vector<const Json*> stability_lines(const Json& cases, const Json& scene, const std::string& block) {
  std::vector<const Json*> lines;
  for (const Json& result_case : cases) {
    if (!result_case.contains("stability") || result_case["scene"] != scene["name"] || block_of(result_case) != block)
      continue;
    const bool is_known = std::any_of(lines.begin(), lines.end(),
                                      [&](const Json* line) { return method_name(*line) == method_name(result_case); });
    if (!is_known) lines.push_back(&result_case);
  }
  const auto changes = [](const Json* result_case) {
    return (*result_case)["stability"]["changed"]["method"]["total"].get<std::uint64_t>();
  };
  std::stable_sort(lines.begin(), lines.end(), [&](const Json* a, const Json* b) { return changes(a) < changes(b); });
  return lines;
}

std::string stability_block(const std::string& block, const std::vector<const Json*>& lines) {
  const Json& steps = (*lines.front())["stability"];
  std::vector<Cells> rows{k_stability_headings, truth_row(*lines.front())};
  for (const Json* result_case : lines) rows.push_back(method_row(*result_case));
  const std::vector<std::size_t> widths = widths_of(rows);
  std::string out = " " + block + "\n  " + shown(steps["path"]);
  if (steps["drift"] == false)
    out += "; at most " + text_at(steps, "/step_m", "%.3g", 1e3) + " mm and " + text_at(steps, "/step_deg", "%.3g") +
           " degrees each";
  out += "\n";
  if (steps["grids"] > 1) out += "  the grid follows the lights: cells themselves move\n";
  for (const Cells& row : rows) out += aligned(row, widths);
  return out;
}

}  // namespace

std::string stability_table(const Json& result) {
  std::string out, window;
  for (const Json& scene : result["scenes"]) {
    std::string blocks;
    for (const std::string& block : blocks_of(result["cases"], scene)) {
      const std::vector<const Json*> lines = stability_lines(result["cases"], scene, block);
      if (lines.empty()) continue;
      blocks += stability_block(block, lines);
      window = (*lines.front())["stability"]["window"].dump();
    }
    if (!blocks.empty()) out += "stability of " + shown(scene["name"]) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out + "changed: pairs (cell, light) added or removed per step. flickers: changes back within " +
         window + " steps.\nexcess: more than the truth's own.\n";
}

}  // namespace clusterbench::report
