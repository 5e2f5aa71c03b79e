#include "report/comparing/ratios.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/pattern.h"
#include "core/text.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "result/at.h"
#include "result/rounding.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::RatioBlock;
using result::RatioCase;
using result::RatioPair;
using result::Ratios;
using result::Result;
using result::Timing;

bool is_beside(const Case& a, const Case& b) {
  return a.scene == b.scene && block_of(a) == block_of(b);
}

struct Timed {
  const Case* result_case = nullptr;
  run::Contender contender;
  double frame_ns = 0.0;
};

// Cases whose times are compared with each other, the fastest first.
struct Block {
  std::string scene, name;
  std::vector<Timed> cases;
};

std::string name_of_case(const Case& result_case, bool across_grids) {
  return (across_grids ? result_case.grid.name + " / " : "") + method_name(result_case) + " / " +
         storage_name(result_case);
}

std::string name_of_block(const Case& result_case, bool across_grids) {
  if (!across_grids) return block_of(result_case);
  return "camera " + result_case.camera + ", " + viewport_text(result_case.viewport) + machine_part(result_case);
}

// In the order of the cases.
std::vector<Block> timed_blocks(const Result& result, const RatioRequest& request) {
  const Pattern pattern(request.methods, "--methods");
  std::vector<Block> blocks;
  for (const Case& result_case : result.cases) {
    const auto frame_ns = result::number<&Case::timing, &Timing::frame_ns, &result::Time::median>(result_case);
    // Also matches the method's name alone, so that one pattern works with grids and without.
    const auto is_wanted = [&](bool with_grid) { return pattern.is_in(name_of_case(result_case, with_grid)); };
    if (!frame_ns || frame_rounds(result_case).empty() ||
        !(is_wanted(false) || (request.across_grids && is_wanted(true))))
      continue;
    const std::string name = name_of_block(result_case, request.across_grids);
    auto block = std::ranges::find_if(
        blocks, [&](const Block& had) { return result_case.scene == had.scene && name == had.name; });
    if (block == blocks.end()) block = blocks.insert(block, Block{result_case.scene, name, {}});
    block->cases.push_back({&result_case, contender_of(result_case), *frame_ns});
  }
  for (Block& block : blocks) std::ranges::stable_sort(block.cases, {}, &Timed::frame_ns);
  return blocks;
}

// A case compared with another one, for the page; null without a ratio.
result::Nullable<result::Beside> beside(const Timed& timed, const Timed& other,
                                        const std::optional<measure::Ratio>& ratio) {
  if (!ratio || timed.result_case == other.result_case) return {};
  return result::Beside{other.result_case->id,
                        result::measured(ratio->ratio),
                        {result::measured(ratio->ci95.low), result::measured(ratio->ci95.high)}};
}

std::vector<RatioPair> pairs_of(const Block& block, std::uint64_t seed) {
  std::vector<RatioPair> pairs;
  for (std::size_t i = 1; i < block.cases.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const run::Contender &slower = block.cases[i].contender, &faster = block.cases[j].contender;
      const std::optional<measure::Ratio> ratio = run::ratio_between(slower, faster, seed);
      if (!ratio) continue;
      pairs.push_back({.slower = i,
                       .faster = j,
                       .ratio = result::measured(ratio->ratio),
                       .ci95 = {result::measured(ratio->ci95.low), result::measured(ratio->ci95.high)},
                       .over = slower.grid == faster.grid ? "rounds" : "launches",
                       .takes_longer = measure::takes_longer(ratio)});
    }
  return pairs;
}

RatioBlock block_of_ratios(const Block& block, std::uint64_t seed, bool across_grids) {
  RatioBlock out{.scene = block.scene, .name = block.name, .pairs = pairs_of(block, seed)};
  for (const Timed& timed : block.cases)
    out.cases.push_back({.id = timed.result_case->id,
                         .name = timed.result_case->name,
                         .label = name_of_case(*timed.result_case, across_grids),
                         .frame_ns = result::measured(timed.frame_ns),
                         .samples_search = samples_search(*timed.result_case)});
  return out;
}

// A block's pairs by the indices of their cases.
class PairIndex {
 public:
  explicit PairIndex(const RatioBlock& block) : cases_(block.cases.size()), pairs_(cases_ * cases_, nullptr) {
    for (const RatioPair& pair : block.pairs) pairs_[pair.slower * cases_ + pair.faster] = &pair;
  }

  // The pair of a slower and a faster case; nullptr if they have no ratio.
  const RatioPair* find(std::size_t slower, std::size_t faster) const { return pairs_[slower * cases_ + faster]; }

 private:
  std::size_t cases_;
  std::vector<const RatioPair*> pairs_;
};

measure::Interval interval_of(const RatioPair& pair) {
  const auto [low, high] = pair.ci95;
  return std::isfinite(low) && std::isfinite(high) ? measure::Interval{low, high} : measure::Interval{};
}

std::string ratio_text(const RatioPair* pair) {
  if (pair == nullptr) return "-";
  const measure::Interval ci95 = interval_of(*pair);
  const std::string ratio = text("%.2f", pair->ratio);
  if (!ci95.is_known()) return ratio + " (" + k_unknown_interval + ")";
  return ratio + text(" (%.2f", ci95.low) + text(" to %.2f)", ci95.high);
}

bool is_longer(const RatioPair* pair) {
  return pair != nullptr && pair->takes_longer;
}

std::string label_at(const RatioBlock& block, std::size_t index) {
  return shown(block.cases[index].label);
}

std::vector<Cells> ranking(const RatioBlock& block) {
  std::vector<Cells> rows{{"", "assigner", "frame us", "/ fastest", "/ row above"}};
  const PairIndex pairs(block);
  for (std::size_t i = 0; i < block.cases.size(); ++i) {
    const RatioPair* above = i > 0 ? pairs.find(i, i - 1) : nullptr;
    rows.push_back({i > 0 && !is_longer(above) ? "~" : "", label_at(block, i),
                    text("%.2f", block.cases[i].frame_ns / 1e3), i == 0 ? "" : ratio_text(pairs.find(i, 0)),
                    i == 0 ? "" : ratio_text(above)});
  }
  return rows;
}

std::vector<Cells> pair_rows(const RatioBlock& block) {
  std::vector<Cells> rows{{"", "assigner", "/ assigner", "ratio"}};
  const PairIndex pairs(block);
  for (std::size_t i = 1; i < block.cases.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const RatioPair* pair = pairs.find(i, j);
      rows.push_back({is_longer(pair) ? "" : "~", label_at(block, i), label_at(block, j), ratio_text(pair)});
    }
  return rows;
}

std::vector<Cells> rows_of(const RatioBlock& block, bool all_pairs) {
  return all_pairs ? pair_rows(block) : ranking(block);
}

std::string legend_of(const Ratios& ratios, bool all_pairs) {
  bool has_unknown = false, has_searched = false;
  for (const RatioBlock& block : ratios.blocks) {
    for (const RatioPair& pair : block.pairs) has_unknown |= !interval_of(pair).is_known();
    for (const RatioCase& one : block.cases) has_searched |= one.samples_search.value_or(false);
  }
  const std::string unknown = has_unknown ? k_unknown_interval + (": " + what_intervals_take()) + ".\n" : "";
  return unknown + std::string("Ratios of frame times of the same ") +
         (ratios.across_grids ? "rounds, or of other grids of the same launches" : "rounds") +
         ", median and 95 % interval; not the quotient of the two times.\n~: the interval does not say that " +
         (all_pairs ? "the first takes longer.\n" : "it takes longer than the row above.\n") +
         (has_searched ? "Without lists: samples search the structure, which these times leave out.\n" : "");
}

std::string csv_field(const std::string& words) {
  std::string out = "\"";
  for (const char c : printable(words)) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csv_row(const std::vector<std::string>& names, double ratio, const measure::Interval& interval) {
  std::string row;
  for (const std::string& name : names) row += csv_field(name) + ",";
  row += text("%.4f,", ratio);
  return row + (interval.is_known() ? text("%.4f,", interval.low) + text("%.4f\n", interval.high) : ",\n");
}

}  // namespace

std::optional<measure::Ratio> ratio_of_cases(const Result& result, const Case& numerator, const Case& denominator,
                                             RankBy by) {
  if (!is_beside(numerator, denominator)) return std::nullopt;
  return run::ratio_between(contender_of(numerator, by), contender_of(denominator, by), seed_of(result));
}

bool takes_longer(const Result& result, const Case& numerator, const Case& denominator, RankBy by) {
  return measure::takes_longer(ratio_of_cases(result, numerator, denominator, by));
}

Ratios ratios_of(const Result& result, const RatioRequest& request) {
  Ratios out{.ratios_version = 1, .name = result.name, .tool = result.tool, .across_grids = request.across_grids};
  for (const Block& block : timed_blocks(result, request))
    out.blocks.push_back(block_of_ratios(block, seed_of(result), request.across_grids));
  return out;
}

std::vector<result::Ranked> ratio_rankings(const Result& result) {
  RatioRequest request;
  request.across_grids = true;
  std::vector<result::Ranked> out;
  std::vector<Block> blocks = timed_blocks(result, request);
  for (Block& block : blocks)
    std::erase_if(block.cases, [](const Timed& timed) { return samples_search(*timed.result_case); });
  for (const Block& block : blocks)
    for (std::size_t i = 0; i < block.cases.size(); ++i) {
      const Timed &timed = block.cases[i], &fastest = block.cases.front(), &above = block.cases[i == 0 ? 0 : i - 1];
      const auto to_fastest = run::ratio_between(timed.contender, fastest.contender, seed_of(result)),
                 to_above = run::ratio_between(timed.contender, above.contender, seed_of(result));
      out.push_back({timed.result_case->id, beside(timed, fastest, to_fastest), beside(timed, above, to_above),
                     i > 0 && to_above && !measure::takes_longer(to_above)});
    }
  return out;
}

std::string ratio_table(const Ratios& ratios, bool all_pairs) {
  std::string out, scene;
  for (const RatioBlock& block : ratios.blocks) {
    if (block.scene != scene) out += shown(block.scene) + "\n";
    scene = block.scene;
    const std::vector<Cells> rows = rows_of(block, all_pairs);
    const std::vector<std::size_t> widths = widths_of(rows);
    out += " " + shown(block.name) + "\n";
    for (const Cells& row : rows) out += aligned(row, widths);
  }
  if (out.empty()) return out;
  return out + "\n" + legend_of(ratios, all_pairs);
}

std::string ratio_markdown(const Ratios& ratios, bool all_pairs) {
  std::string out;
  for (const RatioBlock& block : ratios.blocks) {
    out += "### " + markdown_cell(block.scene) + ", " + markdown_cell(block.name) + "\n\n";
    const std::vector<Cells> rows = rows_of(block, all_pairs);
    for (const Cells& row : rows) {
      out += "|";
      for (const std::string& cell : row) out += " " + markdown_cell(cell) + " |";
      out += "\n";
      if (&row == &rows.front()) out += all_pairs ? "|---|---|---|---:|\n" : "|---|---|---:|---:|---:|\n";
    }
    out += "\n";
  }
  return out + legend_of(ratios, all_pairs);
}

std::string ratio_csv(const Ratios& ratios) {
  std::string out =
      ratios.across_grids ? "scene,view,case,other,ratio,low,high\n" : "scene,grid,method,other,ratio,low,high\n";
  for (const RatioBlock& block : ratios.blocks) {
    const PairIndex pairs(block);
    const std::vector<RatioCase>& cases = block.cases;
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (std::size_t j = 0; j < cases.size(); ++j) {
        const RatioPair* pair = pairs.find(std::max(i, j), std::min(i, j));
        if (pair == nullptr) continue;
        const double ratio = pair->ratio;
        const measure::Interval ci95 = interval_of(*pair);
        const std::vector<std::string> names{block.scene, block.name, cases[i].label, cases[j].label};
        out += i > j ? csv_row(names, ratio, ci95) : csv_row(names, 1.0 / ratio, {1.0 / ci95.high, 1.0 / ci95.low});
      }
  }
  return out;
}

}  // namespace clusterbench::report
