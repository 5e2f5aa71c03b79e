#include "report/tables/shadows_table.h"

#include "report/cases/columns.h"
#include "report/cases/json_values.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::BeforeAfter;
using result::Case;
using result::MeanMax;
using result::number;
using result::ShadowCull;
using result::ShadowCullSamples;
using result::Shadows;
using result::SharedFrusta;
using result::Timing;

const Cells k_cull_headings{"",          "assigner", "map",   "texels", "pairs", "true",
                            "evaluated", "lit",      "wrong", "lost",   "MiB",   "step us"};

std::string percent(const std::optional<double>& share) {
  return text_of(share, "%.2f %%", 100.0);
}

std::string per_visible_sample(const ShadowCull& cull, std::optional<double> (*count)(const ShadowCullSamples&)) {
  if (!cull.opaque || cull.opaque->samples == 0) return "-";
  return text_of(count(*cull.opaque), "%.2f", 1.0 / static_cast<double>(cull.opaque->samples));
}

std::string step_text(const Case& result_case, std::size_t index) {
  const auto* times = result::part<&Case::timing, &Timing::shadow_cull>(result_case);
  if (times == nullptr || index >= times->size()) return "-";
  return text_of(number<&result::ShadowCullTimes::step_ns, &MeanMax::mean>((*times)[index]), "%.0f", 1e-3);
}

Cells cull_row(const NamedCase& named, std::size_t index) {
  const ShadowCull& cull = (*named.result_case->shadows->culls)[index];
  const std::string evaluated = per_visible_sample(cull, number<&ShadowCullSamples::evaluated, &BeforeAfter::before>),
                    kept = per_visible_sample(cull, number<&ShadowCullSamples::evaluated, &BeforeAfter::after>);
  return {"",
          named.name,
          std::to_string(cull.resolution),
          cull.texels,
          percent(number<&ShadowCull::pairs, &BeforeAfter::removed>(cull)),
          percent(number<&ShadowCull::true_pairs, &BeforeAfter::removed>(cull)),
          evaluated == "-" ? "-" : evaluated + " to " + kept,
          per_visible_sample(cull, number<&ShadowCullSamples::lit>),
          text_of(number<&ShadowCull::opaque, &ShadowCullSamples::wrongly_removed>(cull), "%.0f"),
          text_of(number<&ShadowCull::opaque, &ShadowCullSamples::lost_irradiance>(cull), "%.3g %%", 100.0),
          text("%.2f", 0x1p-20 * static_cast<double>(cull.maps.bytes)),
          step_text(*named.result_case, index)};
}

std::string mean_max(const MeanMax& value, const char* format) {
  return text_of(number<&MeanMax::mean>(value), format) + " (at most " + text_of(number<&MeanMax::max>(value), format) +
         ")";
}

std::string frusta_text(const SharedFrusta& frusta) {
  std::string out = "  spots in view per frame: " + mean_max(frusta.spots, "%.4g") +
                    "; maps if they share: " + mean_max(frusta.maps, "%.4g") + ", " +
                    percent(number<&SharedFrusta::saved>(frusta)) + " saved\n";
  if (frusta.most_members < 2) return out;
  return out + "  up to " + std::to_string(frusta.most_members) +
         " in a map; its frustum's volume: " + mean_max(frusta.volume.over_largest, "%.3g") +
         " of the largest member's, " + mean_max(frusta.volume.over_sum, "%.3g") + " of all together\n";
}

std::string shadows_block(const std::string& block, const std::vector<NamedCase>& lines) {
  std::string out = " " + block + "\n";
  const Shadows& first = *lines.front().result_case->shadows;
  if (first.frusta) out += frusta_text(*first.frusta);
  std::vector<Cells> rows{k_cull_headings};
  for (const NamedCase& named : lines) {
    const Shadows& shadows = *named.result_case->shadows;
    for (std::size_t i = 0; shadows.culls && i < shadows.culls->size(); ++i) rows.push_back(cull_row(named, i));
  }
  if (rows.size() == 1) return out;
  return out + aligned_rows(rows);
}

Json part_of(const Case& result_case) {
  return result_case.shadows ? result::to_json(*result_case.shadows) : Json();
}

}  // namespace

std::string shadows_table(const result::Result& result) {
  std::string out;
  bool has_culls = false;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    for (const CaseBlock& block : blocks_of(result.cases, scene)) {
      const std::vector<NamedCase> lines = distinct_cases(block.cases, part_of);
      if (lines.empty()) continue;
      blocks += shadows_block(block.name, lines);
      for (const NamedCase& named : lines) has_culls = has_culls || named.result_case->shadows->culls;
    }
    if (!blocks.empty()) out += "shadows of " + shown(scene.name) + "\n" + blocks + "\n";
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
         (value_at(result.config, "/samples/opaque") == nullptr
              ? "Without samples.opaque nothing is known of visible surfaces.\n"
              : "");
}

}  // namespace clusterbench::report
