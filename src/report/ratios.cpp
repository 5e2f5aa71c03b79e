#include "report/ratios.h"

#include <algorithm>

#include "core/pattern.h"
#include "core/text.h"
#include "report/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> frame_samples(const Json& one) {
  const Json samples = one.value(Json::json_pointer("/timing/frame_ns/samples"), Json());
  return samples.is_array() ? samples.get<std::vector<double>>() : std::vector<double>{};
}

bool is_beside(const Json& one, const Json& other) {
  return one["scene"] == other["scene"] && block_of(one) == block_of(other);
}

std::string name_of_case(const Json& one) {
  return method_name(one) + " / " + one["storage"].get<std::string>();
}

double time_of_case(const Json& one) {
  return one["timing"]["frame_ns"]["median"].get<double>();
}

struct Block {
  std::string scene, name;
  std::vector<const Json*> cases;  // the fastest first
};

std::vector<Block> timed_blocks(const Json& result, const std::string& methods) {
  const Pattern pattern(methods, "--methods");
  std::vector<Block> blocks;
  for (const Json& scene : result["scenes"])
    for (const std::string& name : blocks_of(result["cases"], scene)) {
      Block block{scene["name"], name, {}};
      for (const Json& one : result["cases"])
        if (one["scene"] == scene["name"] && block_of(one) == name && !frame_samples(one).empty() &&
            one["timing"]["frame_ns"]["median"].is_number() && pattern.is_in(name_of_case(one)))
          block.cases.push_back(&one);
      std::ranges::stable_sort(block.cases,
                               [](const Json* a, const Json* b) { return time_of_case(*a) < time_of_case(*b); });
      if (!block.cases.empty()) blocks.push_back(block);
    }
  return blocks;
}

std::string ratio_text(const std::optional<measure::Ratio>& ratio) {
  if (!ratio) return "-";
  if (!ratio->ci95.is_known()) return text("%.2f", ratio->ratio) + " (" + k_unknown_interval + ")";
  return text("%.2f", ratio->ratio) + text(" (%.2f", ratio->ci95.low) + text(" to %.2f)", ratio->ci95.high);
}

std::vector<Cells> ranking(const Json& result, const Block& block) {
  std::vector<Cells> rows{{"", "assigner", "frame us", "/ fastest", "/ row above"}};
  for (std::size_t i = 0; i < block.cases.size(); ++i) {
    const Json& one = *block.cases[i];
    const bool is_like_above = i > 0 && !takes_longer(result, one, *block.cases[i - 1]);
    rows.push_back({is_like_above ? "~" : "", shown(name_of_case(one)), text("%.2f", time_of_case(one) / 1e3),
                    i == 0 ? "" : ratio_text(ratio_of_cases(result, one, *block.cases.front())),
                    i == 0 ? "" : ratio_text(ratio_of_cases(result, one, *block.cases[i - 1]))});
  }
  return rows;
}

std::vector<Cells> pairs(const Json& result, const Block& block) {
  std::vector<Cells> rows{{"", "assigner", "/ assigner", "ratio"}};
  for (std::size_t i = 1; i < block.cases.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      rows.push_back({takes_longer(result, *block.cases[i], *block.cases[j]) ? "" : "~",
                      shown(name_of_case(*block.cases[i])), shown(name_of_case(*block.cases[j])),
                      ratio_text(ratio_of_cases(result, *block.cases[i], *block.cases[j]))});
  return rows;
}

std::string csv_field(const std::string& words) {
  std::string out = "\"";
  for (const char c : printable(words)) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csv_row(const std::vector<std::string>& names, const measure::Ratio& ratio) {
  std::string row;
  for (const std::string& name : names) row += csv_field(name) + ",";
  if (!ratio.ci95.is_known()) return row + text("%.4f,,\n", ratio.ratio);
  return row + text("%.4f,", ratio.ratio) + text("%.4f,", ratio.ci95.low) + text("%.4f\n", ratio.ci95.high);
}

}  // namespace

std::optional<measure::Ratio> ratio_of_cases(const Json& result, const Json& one, const Json& other) {
  const std::vector<double> own = frame_samples(one), others = frame_samples(other);
  if (!is_beside(one, other) || own.empty() || own.size() != others.size()) return std::nullopt;
  if (std::ranges::any_of(others, [](double ns) { return !(ns > 0.0); })) return std::nullopt;
  const Json &timing = one["timing"], &beside = other["timing"];
  if (timing.value("launches", 1) != beside.value("launches", 1) ||
      timing.value("caches", "warm") != beside.value("caches", "warm"))
    return std::nullopt;
  return measure::paired_ratio(own, others, result["config"].value("seed", std::uint64_t{1}),
                               timing.value("launches", 1));
}

bool takes_longer(const Json& result, const Json& one, const Json& other) {
  const std::optional<measure::Ratio> ratio = ratio_of_cases(result, one, other);
  return ratio && ratio->ci95.low > 1.0;
}

std::string ratio_table(const Json& result, const std::string& methods, bool all_pairs) {
  std::string out, scene;
  for (const Block& block : timed_blocks(result, methods)) {
    if (block.scene != scene) out += shown(block.scene) + "\n";
    scene = block.scene;
    const std::vector<Cells> rows = all_pairs ? pairs(result, block) : ranking(result, block);
    const std::vector<std::size_t> widths = widths_of(rows);
    out += " " + block.name + "\n";
    for (const Cells& row : rows) out += aligned(row, widths);
  }
  if (out.empty()) return out;
  const bool has_unknown = out.find(std::string("(") + k_unknown_interval + ")") != std::string::npos;
  if (has_unknown) out += "\n" + std::string(k_unknown_interval) + ": " + what_intervals_take() + ".";
  return out +
         "\nRatios of frame times of the same rounds, median and 95 % interval. ~: the interval does not say that " +
         (all_pairs ? "the first takes longer.\n" : "it takes longer than the row above.\n");
}

std::string ratio_csv(const Json& result, const std::string& methods) {
  std::string out = "scene,grid,method,other,ratio,low,high\n";
  for (const Block& block : timed_blocks(result, methods))
    for (const Json* one : block.cases)
      for (const Json* other : block.cases)
        if (const auto ratio = one == other ? std::nullopt : ratio_of_cases(result, *one, *other))
          out += csv_row({block.scene, block.name, name_of_case(*one), name_of_case(*other)}, *ratio);
  return out;
}

}  // namespace clusterbench::report
