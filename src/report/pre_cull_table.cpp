#include "report/pre_cull_table.h"

#include "report/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

const Cells k_pre_cull_headings{"",           "assigner",     "lights",  "kept",     "distant",
                                "pairs lost", "samples lost", "cull us", "frame us", "sets"};

// Of visible surfaces if there are some, else of those anywhere in the view.
std::string lost_at_samples(const Json& pre_cull) {
  for (const char* set : {"opaque", "volume"}) {
    const auto found = pre_cull["lost_at_samples"].find(set);
    if (found == pre_cull["lost_at_samples"].end() || (*found)["needed"] == 0) continue;
    return text("%.3g %%", 100.0 * (*found)["lost"].get<double>() / (*found)["needed"].get<double>());
  }
  return "-";
}

Cells pre_cull_row(const NamedCase& named) {
  const Json &result_case = *named.result_case, &pre_cull = result_case["pre_cull"];
  const std::string storage = named.name.substr(method_name(result_case).size());
  return {"",
          shown(result_case["assigner"]["label"]) + storage,
          shown(pre_cull["label"]) + (pre_cull["conservative"] == true ? "" : " *"),
          text_at(pre_cull, "/kept/mean", "%.1f"),
          text_at(pre_cull, "/distant/mean", "%.1f"),
          text_at(pre_cull, "/lost_pairs", "%.0f"),
          lost_at_samples(pre_cull),
          text_at(result_case, "/timing/pre_cull_ns/median", "%.2f", 1e-3),
          text_at(result_case, "/timing/frame_ns/median", "%.2f", 1e-3),
          text_at(pre_cull, "/bytes", "%.0f B")};
}

}  // namespace

std::string pre_cull_table(const Json& result) {
  std::string out;
  for (const Json& scene : result["scenes"]) {
    std::string blocks;
    for (const std::string& block : blocks_of(result["cases"], scene)) {
      std::vector<Cells> rows{k_pre_cull_headings};
      for (const NamedCase& line : distinct_cases(result["cases"], scene, block, {"pre_cull", "error", "timing"}))
        if (line.result_case->contains("pre_cull")) rows.push_back(pre_cull_row(line));
      if (rows.size() == 1) continue;
      const std::vector<std::size_t> widths = widths_of(rows);
      blocks += " " + block + "\n";
      for (const Cells& row : rows) blocks += aligned(row, widths);
    }
    if (!blocks.empty()) out += "pre-culls of " + shown(scene["name"]) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "lights: what happens to them before the assigner gets them; * may lose some, which fails no run.\n"
         "kept, distant: lights per frame that the assigner gets, and that are drawn and not shaded.\n"
         "pairs lost: true pairs of lights that are removed; samples lost: share of the lights that samples need, "
         "those\n"
         "of visible surfaces where they are asked for.\n"
         "cull us: of the frame's time; sets: bytes of visible sets.\n";
}

}  // namespace clusterbench::report
