#include "report/precision_table.h"

#include <set>

#include "report/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

const Cells k_precision_headings{"", "assigner", "lights", "missed", "deepest", "pairs", "extra"};

Cells precision_row(const NamedCase& named) {
  const Json& result_case = *named.result_case;
  const bool has_lost = result_case.contains("error") && result_case["error"]["false_negatives"] != 0;
  return {"",
          named.name,
          result_case["precision"]["label"].get<std::string>(),
          text_at(result_case, "/error/false_negatives", "%.0f"),
          has_lost ? text_at(result_case, "/error/deepest_miss", "%.3g %%", 100.0) : "-",
          short_count(result_case, "/occupancy/pairs/mean"),
          text_at(result_case, "/precision/extra_pairs/ratio", "%+.2f %%", 100.0)};
}

// Cases of a block, once per method, precision and what that loses. The precision has a column of its own.
std::vector<NamedCase> precision_lines(const Json& cases, const Json& scene, const std::string& block) {
  std::vector<NamedCase> lines = distinct_cases(cases, scene, block, {"precision", "error", "occupancy"});
  std::erase_if(lines, [](const NamedCase& line) { return !line.result_case->contains("precision"); });
  for (NamedCase& line : lines) {
    const Json& result_case = *line.result_case;
    const std::string storage = line.name.substr(method_name(result_case).size());
    line.name = shown(result_case["assigner"]["label"]) + storage;
  }
  return lines;
}

std::string loss_text(const Json& precision) {
  const auto metres = [&](const char* key) {
    const std::string pointer = std::string("/") + key;
    return text_at(precision, (pointer + "/mean").c_str(), "%.3g") + " m, at most " +
           text_at(precision, (pointer + "/max").c_str(), "%.3g") + " m";
  };
  const std::string name = precision["packing"];
  std::string text = "  " + name + ": positions are off by " + metres("position_error_m") + "; safe inflation " +
                     metres("safe_inflation_m") + "\n";
  const Json& beyond = precision["unrepresentable"];
  if (beyond["lights"] != 0)
    text += "  " + name + " cannot hold up to " + number_of(beyond["lights"].get<std::uint64_t>(), "light") + " in " +
            number_of(beyond["frames"].get<std::uint64_t>(), "frame") +
            " (too far, too large or without end): here they stay in float32,\n" +
            "  an engine's conversion makes them infinite or cuts them off\n";
  return text;
}

std::string precision_block(const std::string& block, const std::vector<NamedCase>& lines) {
  std::string out = " " + block + "\n";
  std::set<std::string> told;
  std::vector<Cells> rows{k_precision_headings};
  for (const NamedCase& named : lines) {
    const Json& precision = (*named.result_case)["precision"];
    const std::string packing = precision["packing"];
    if (packing != "float32" && told.insert(packing).second) out += loss_text(precision);
    rows.push_back(precision_row(named));
  }
  const std::vector<std::size_t> widths = widths_of(rows);
  for (const Cells& row : rows) out += aligned(row, widths);
  return out;
}

}  // namespace

std::string precision_table(const Json& result) {
  std::string out;
  for (const Json& scene : result["scenes"]) {
    std::string blocks;
    for (const std::string& block : blocks_of(result["cases"], scene)) {
      const std::vector<NamedCase> lines = precision_lines(result["cases"], scene, block);
      if (!lines.empty()) blocks += precision_block(block, lines);
    }
    if (!blocks.empty()) out += "precision of " + shown(scene["name"]) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "missed: true pairs that are lost; on packed lights without inflate that fails no run.\n"
         "deepest: how far inside its range a light is lost.\n"
         "extra: pairs per frame against the same assigner in float32.\n";
}

}  // namespace clusterbench::report
