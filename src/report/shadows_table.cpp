#include "report/shadows_table.h"

#include "report/columns.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

const Cells k_cull_headings{"",          "assigner", "map",   "texels", "pairs", "true",
                            "evaluated", "lit",      "wrong", "lost",   "MiB",   "step us"};

std::string percent_at(const Json& json, const char* pointer) {
  return text_at(json, pointer, "%.2f %%", 100.0);
}

// A count per sample.
std::string per_visible_sample(const Json& cull, const char* pointer) {
  if (!cull.contains("opaque") || cull["opaque"]["samples"] == 0) return "-";
  return text_at(cull, pointer, "%.2f", 1.0 / cull["opaque"]["samples"].get<double>());
}

Cells cull_row(const NamedCase& named, std::size_t index) {
  const Json& cull = (*named.result_case)["shadows"]["culls"][index];
  const std::string evaluated = per_visible_sample(cull, "/opaque/evaluated/before"),
                    kept = per_visible_sample(cull, "/opaque/evaluated/after");
  const std::string step = "/timing/shadow_cull/" + std::to_string(index) + "/step_ns/mean";
  return {"",
          named.name,
          text_at(cull, "/resolution", "%.0f"),
          cull["texels"].get<std::string>(),
          percent_at(cull, "/pairs/removed"),
          percent_at(cull, "/true_pairs/removed"),
          evaluated == "-" ? "-" : evaluated + " to " + kept,
          per_visible_sample(cull, "/opaque/lit"),
          text_at(cull, "/opaque/wrongly_removed", "%.0f"),
          text_at(cull, "/opaque/lost_irradiance", "%.3g %%", 100.0),
          text_at(cull, "/maps/bytes", "%.2f", 0x1p-20),
          text_at(*named.result_case, step.c_str(), "%.0f", 1e-3)};
}

std::string frusta_text(const Json& frusta) {
  const auto mean_max = [&](const char* key, const char* format) {
    const std::string pointer = std::string("/") + key;
    return text_at(frusta, (pointer + "/mean").c_str(), format) + " (at most " +
           text_at(frusta, (pointer + "/max").c_str(), format) + ")";
  };
  std::string out = "  spots in view per frame: " + mean_max("spots", "%.4g") +
                    "; maps if they share: " + mean_max("maps", "%.4g") + ", " + percent_at(frusta, "/saved") +
                    " saved\n";
  if (frusta["most_members"].get<std::uint64_t>() < 2) return out;
  return out + "  up to " + std::to_string(frusta["most_members"].get<std::uint64_t>()) +
         " in a map; its frustum's volume: " + mean_max("volume/over_largest", "%.3g") + " of the largest member's, " +
         mean_max("volume/over_sum", "%.3g") + " of all together\n";
}

std::string shadows_block(const std::string& block, const std::vector<NamedCase>& lines) {
  std::string out = " " + block + "\n";
  const Json& first = (*lines.front().result_case)["shadows"];
  if (first.contains("frusta")) out += frusta_text(first["frusta"]);
  std::vector<Cells> rows{k_cull_headings};
  for (const NamedCase& named : lines) {
    const Json& shadows = (*named.result_case)["shadows"];
    for (std::size_t i = 0; shadows.contains("culls") && i < shadows["culls"].size(); ++i)
      rows.push_back(cull_row(named, i));
  }
  if (rows.size() == 1) return out;
  const std::vector<std::size_t> widths = widths_of(rows);
  for (const Cells& row : rows) out += aligned(row, widths);
  return out;
}

}  // namespace

std::string shadows_table(const Json& result) {
  std::string out;
  bool has_culls = false;
  for (const Json& scene : result["scenes"]) {
    std::string blocks;
    for (const std::string& block : blocks_of(result["cases"], scene)) {
      const std::vector<NamedCase> lines = distinct_cases(result["cases"], scene, block, {"shadows"});
      if (lines.empty()) continue;
      blocks += shadows_block(block, lines);
      for (const NamedCase& named : lines) has_culls = has_culls || (*named.result_case)["shadows"].contains("culls");
    }
    if (!blocks.empty()) out += "shadows of " + shown(scene["name"]) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  out = "\n" + out;
  if (!has_culls) return out;
  return out +
         "pairs, true: share of the pairs in lists, and of the true ones, that are taken out since the cell lies in "
         "shadow.\n"
         "evaluated: lights per visible sample, before and after; lit: those that a shadow ray finds lit.\n"
         "wrong: lit ones that were taken out, over all samples and frames, and the share of irradiance that is lost "
         "with them.\n" +
         (value_at(result, "/config/samples/opaque") == nullptr
              ? "Without samples.opaque nothing is known of visible surfaces.\n"
              : "");
}

}  // namespace clusterbench::report
