#include "report/tables/precision_table.h"

#include <set>

#include "report/cases/columns.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::ListError;
using result::MeanMax;
using result::number;
using result::Precision;

const Cells k_precision_headings{"", "assigner", "lights", "missed", "deepest", "pairs", "extra"};

Cells precision_row(const NamedCase& named) {
  const Case& result_case = *named.result_case;
  const bool has_lost = result_case.error && result_case.error->false_negatives != 0;
  return {"",
          named.name,
          result_case.precision->label,
          text_of(number<&Case::error, &ListError::false_negatives>(result_case), "%.0f"),
          has_lost ? text_of(number<&Case::error, &ListError::deepest_miss>(result_case), "%.3g %%", 100.0) : "-",
          short_count(number<&Case::occupancy, &result::Occupancy::pairs, &result::Spread::mean>(result_case)),
          text_of(number<&Case::precision, &Precision::extra_pairs, &result::ExtraPairs::ratio>(result_case),
                  "%+.2f %%", 100.0)};
}

// The part in which two cases of a method can differ.
Json precision_of(const Case& result_case) {
  Json parts;
  if (result_case.precision) parts["precision"] = result::to_json(*result_case.precision);
  if (result_case.error) parts["error"] = result::to_json(*result_case.error);
  if (result_case.occupancy) parts["occupancy"] = result::to_json(*result_case.occupancy);
  return parts;
}

// Cases of a block, once per method, precision and loss. The precision has its own column.
std::vector<NamedCase> precision_lines(const std::vector<const Case*>& cases) {
  std::vector<NamedCase> lines = distinct_cases(cases, precision_of);
  std::erase_if(lines, [](const NamedCase& line) { return !line.result_case->precision; });
  for (NamedCase& line : lines) {
    const Case& result_case = *line.result_case;
    const std::string storage = line.name.substr(method_name(result_case).size());
    line.name = shown(result_case.assigner.label) + storage;
  }
  return lines;
}

std::string metres(const MeanMax& length) {
  return text_of(number<&MeanMax::mean>(length), "%.3g") + " m, at most " +
         text_of(number<&MeanMax::max>(length), "%.3g") + " m";
}

std::string loss_text(const Precision& precision) {
  const std::string& name = precision.packing;
  std::string text = "  " + name + ": positions are off by " + metres(precision.position_error_m) +
                     "; safe inflation " + metres(precision.safe_inflation_m) + "\n";
  const result::Unrepresentable& beyond = precision.unrepresentable;
  if (beyond.lights != 0)
    text += "  " + name + " cannot hold up to " + number_of(beyond.lights, "light") + " in " +
            number_of(beyond.frames, "frame") + " (too far, too large or without end): here they stay in float32,\n" +
            "  an engine's conversion makes them infinite or cuts them off\n";
  return text;
}

std::string precision_block(const std::string& block, const std::vector<NamedCase>& lines) {
  std::string out = " " + block + "\n";
  std::set<std::string> told;
  std::vector<Cells> rows{k_precision_headings};
  for (const NamedCase& named : lines) {
    const Precision& precision = *named.result_case->precision;
    if (precision.packing != "float32" && told.insert(precision.packing).second) out += loss_text(precision);
    rows.push_back(precision_row(named));
  }
  return out + aligned_rows(rows);
}

}  // namespace

std::string precision_table(const result::Result& result) {
  std::string out;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    for (const CaseBlock& block : blocks_of(result.cases, scene)) {
      const std::vector<NamedCase> lines = precision_lines(block.cases);
      if (!lines.empty()) blocks += precision_block(block.name, lines);
    }
    if (!blocks.empty()) out += "precision of " + shown(scene.name) + "\n" + blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "missed: true pairs that are lost; on packed lights without inflate that fails no run.\n"
         "deepest: how far inside its range a light is lost.\n"
         "extra: pairs per frame against the same assigner in float32.\n";
}

}  // namespace clusterbench::report
