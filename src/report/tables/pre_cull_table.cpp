#include "report/tables/pre_cull_table.h"

#include "report/cases/columns.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::MeanMax;
using result::number;
using result::PreCull;
using result::Time;
using result::Timing;

const Cells k_pre_cull_headings{"",           "assigner",     "lights",  "kept",     "distant",
                                "pairs lost", "samples lost", "cull us", "frame us", "sets"};

// Of visible surfaces if there are any, else of points anywhere in the view.
std::string lost_at_samples(const PreCull& pre_cull) {
  for (const char* set : {"opaque", "volume"})
    for (const auto& [name, at_samples] : pre_cull.lost_at_samples)
      if (name == set && at_samples.needed != 0)
        return text("%.3g %%", 100.0 * static_cast<double>(at_samples.lost) / static_cast<double>(at_samples.needed));
  return "-";
}

Cells pre_cull_row(const NamedCase& named) {
  const Case& result_case = *named.result_case;
  const PreCull& pre_cull = *result_case.pre_cull;
  const std::string storage = named.name.substr(method_name(result_case).size());
  return {"",
          shown(result_case.assigner.label) + storage,
          shown(pre_cull.label) + (pre_cull.conservative ? "" : " *"),
          text_of(number<&PreCull::kept, &MeanMax::mean>(pre_cull), "%.1f"),
          text_of(number<&PreCull::distant, &MeanMax::mean>(pre_cull), "%.1f"),
          std::to_string(pre_cull.lost_pairs),
          lost_at_samples(pre_cull),
          text_of(number<&Case::timing, &Timing::pre_cull_ns, &Time::median>(result_case), "%.2f", 1e-3),
          text_of(number<&Case::timing, &Timing::frame_ns, &Time::median>(result_case), "%.2f", 1e-3),
          std::to_string(pre_cull.bytes) + " B"};
}

// The part in which two cases of a method can differ.
Json parts_of(const Case& result_case) {
  Json parts;
  if (result_case.pre_cull) parts["pre_cull"] = result::to_json(*result_case.pre_cull);
  if (result_case.error) parts["error"] = result::to_json(*result_case.error);
  if (result_case.timing) parts["timing"] = result::to_json(*result_case.timing);
  return parts;
}

}  // namespace

std::string pre_cull_table(const result::Result& result) {
  std::string out;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    for (const CaseBlock& block : blocks_of(result.cases, scene)) {
      std::vector<Cells> rows{k_pre_cull_headings};
      for (const NamedCase& line : distinct_cases(block.cases, parts_of))
        if (line.result_case->pre_cull) rows.push_back(pre_cull_row(line));
      if (rows.size() == 1) continue;
      blocks += " " + block.name + "\n";
      blocks += aligned_rows(rows);
    }
    if (!blocks.empty()) out += "pre-culls of " + shown(scene.name) + "\n" + blocks + "\n";
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
