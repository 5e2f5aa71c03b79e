#include "report/tables/table.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "assign/contract/assigner.h"
#include "core/text.h"
#include "report/cases/case_costs.h"
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"
#include "report/cases/timing_warnings.h"
#include "report/comparing/ratios.h"
#include "report/presets/preset_ranking.h"
#include "report/tables/fit_table.h"
#include "report/tables/lookup_table.h"
#include "report/tables/pre_cull_table.h"
#include "report/tables/precision_table.h"
#include "report/tables/reaction_table.h"
#include "report/tables/reading_table.h"
#include "report/tables/samples_table.h"
#include "report/tables/shadows_table.h"
#include "report/tables/stability_table.h"
#include "report/tables/warnings.h"
#include "result/at.h"
#include "result/figures/case_figure.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::number;
using result::SampleSet;
using result::Timing;

constexpr const char* k_red = "\033[31m";
constexpr const char* k_bold = "\033[1m";
constexpr const char* k_plain = "\033[0m";

struct Line {
  const Case* result_case = nullptr;
  Cells cells;
  bool has_failed = false;
  std::pair<bool, double> sort_key;
};

// Optional columns: true if some case has the figure.
struct Extras {
  bool storages = false, times = false, conversions = false, builds = false, instructions = false, samples = false,
       dropped = false, cold = false, launches = false, costs = false, searched = false, device = false,
       device_cold = false, device_builds = false;
};

std::string time_text(const std::optional<double>& us) {
  if (!us) return "-";
  return text(*us < 10.0 ? "%.2f" : *us < 1000.0 ? "%.1f" : "%.0f", *us);
}
std::string two_digits(const std::optional<double>& value) {
  return text_of(value, "%.2f");
}

std::string worst_text(const Case& result_case) {
  const auto* worst = result::part<&Case::timing, &Timing::worst_frame>(result_case);
  return worst == nullptr ? "-"
                          : time_text(figure_of(result_case, "frame_us.max")) + " @" + std::to_string(worst->frame);
}

// The pairs of the timed frames; without timing those of all frames.
std::string pairs_text(const Case& result_case) {
  return short_count(figure_of(result_case, figure_of(result_case, "frame_us") ? "pairs_timed" : "pairs.mean"));
}

// Of the samples that rank the case, like `unlit`.
std::string lost_lux_text(const Case& result_case, result::SampleFigure figure) {
  const SampleSet* most = most_at_sets(result_case, figure);
  if (most == nullptr) return "-";
  return most->lost_lux == 0.0 ? "0" : text_of(figure(*most), "%.3g");
}

// Bytes of the structure that a sample reads to find its lights.
std::string read_bytes_text(const std::optional<double>& bytes) {
  return bytes ? text(*bytes < 100.0 ? "%.3g" : "%.0f", *bytes) : "-";
}

// Without timing the GPU cost.
std::string cost_text(const Case& result_case) {
  const std::optional<double> frame_us = figure_of(result_case, "frame_cost_us");
  return time_text(frame_us ? frame_us : figure_of(result_case, "gpu_cost_us"));
}

// By cost, cases that miss lights come last: they do not pay for the same picture.
std::pair<bool, double> sort_key(const Case& result_case, RankBy by) {
  if (by == RankBy::frame_cost)
    for (const char* figure : {"frame_cost_us", "gpu_cost_us"})
      if (const auto found = figure_of(result_case, figure)) return {!result_case.cost->lit, *found};
  for (const char* figure : {"frame_us", "device_us", "assign_instructions", "excess"})
    if (const auto found = figure_of(result_case, figure)) return {false, *found};
  return {false, 0.0};
}

constexpr const char* k_frame_heading = "frame us";
constexpr const char* k_cost_heading = "cost us";

// A figure (result/figures/figure_table.h) in a format, or its own text.
struct Column {
  const char* heading;
  const char* figure = nullptr;
  std::string (*format)(const std::optional<double>& value) = nullptr;
  std::string (*own_text)(const Case& result_case) = nullptr;
  bool Extras::*needed = nullptr;  // the column is left out if the table has no such figure
  bool is_at_samples = false;      // the heading names the samples

  std::string text(const Case& result_case) const {
    return figure != nullptr ? format(figure_of(result_case, figure)) : own_text(result_case);
  }
};

std::string device_interval_text(const Case& result_case) {
  return result_case.device ? interval_text(result_case.device->run_ns) : "-";
}

constexpr Column k_columns[] = {
    {.heading = k_frame_heading, .figure = "frame_us", .format = time_text, .needed = &Extras::times},
    {.heading = "±", .own_text = frame_interval_text, .needed = &Extras::times},
    {.heading = "worst us", .own_text = worst_text, .needed = &Extras::times},
    {.heading = "assign", .figure = "assign_us", .format = time_text, .needed = &Extras::times},
    {.heading = "convert", .figure = "convert_us", .format = time_text, .needed = &Extras::conversions},
    {.heading = "build", .figure = "build_us", .format = time_text, .needed = &Extras::builds},
    {.heading = k_cost_heading, .own_text = cost_text, .needed = &Extras::costs},
    {.heading = "instr", .figure = "assign_instructions", .format = short_count, .needed = &Extras::instructions},
    {.heading = "device us", .figure = "device_us", .format = time_text, .needed = &Extras::device},
    {.heading = "±", .own_text = device_interval_text, .needed = &Extras::device},
    {.heading = "x floor", .figure = "device_floor", .format = two_digits, .needed = &Extras::device},
    {.heading = "warm", .figure = "device_warm_us", .format = time_text, .needed = &Extras::device_cold},
    {.heading = "build", .figure = "device_build_us", .format = time_text, .needed = &Extras::device_builds},
    {.heading = "upload", .figure = "device_upload_us", .format = time_text, .needed = &Extras::device},
    {.heading = "readback", .figure = "device_readback_us", .format = time_text, .needed = &Extras::device},
    {.heading = "pairs", .own_text = pairs_text},
    {.heading = "ns/pair", .figure = "time_per_pair", .format = two_digits, .needed = &Extras::times},
    {.heading = "excess",
     .figure = "excess",
     .format = [](const std::optional<double>& ratio) { return text_of(ratio, "%.1f %%", 100.0); }},
    {.heading = "missed",
     .figure = "missed",
     .format = [](const std::optional<double>& pairs) { return text_of(pairs, "%.0f"); }},
    {.heading = "dropped", .figure = "dropped", .format = short_count, .needed = &Extras::dropped},
    {.heading = "lost lx",
     .own_text = [](const Case& result_case) { return lost_lux_text(result_case, number<&SampleSet::lost_lux>); },
     .needed = &Extras::dropped},
    {.heading = "worst lx",
     .own_text =
         [](const Case& result_case) {
           return lost_lux_text(result_case, number<&SampleSet::darkest, &result::DarkestSample::lost_lux>);
         },
     .needed = &Extras::dropped},
    {.heading = "unlit", .figure = "unlit", .format = unlit_text, .needed = &Extras::samples, .is_at_samples = true},
    {.heading = "overshade",
     .figure = "overshade",
     .format = two_digits,
     .needed = &Extras::samples,
     .is_at_samples = true},
    {.heading = "read", .figure = "read_bytes", .format = read_bytes_text, .needed = &Extras::searched},
    {.heading = "bytes", .figure = "bytes", .format = short_count},
};

bool is_shown(const Column& column, const Extras& extras) {
  return column.needed == nullptr || extras.*column.needed;
}

Cells headings(const Extras& extras, const Case& sampled) {
  Cells cells{"", "assigner"};
  for (const Column& column : k_columns)
    if (is_shown(column, extras))
      cells.push_back(column.heading + (column.is_at_samples ? heading_of_sets(sampled) : std::string()));
  return cells;
}

// The case of a block with the most sets of samples; it determines the headings.
const Case& most_sampled(const std::vector<const Case*>& cases) {
  return **std::ranges::max_element(cases, {}, [](const Case* one) { return ranking_set_names(*one).size(); });
}

// Cases whose samples search the structure share one block, so their labels include the grid, if they use one.
std::string table_label(const Case& result_case, const Extras& extras) {
  std::string label = method_name(result_case);
  if (extras.storages) label += " / " + storage_name(result_case);
  const assign::AssignerDescriptor* assigner = assign::find_assigner(result_case.assigner.name);
  if (samples_search(result_case) && (assigner == nullptr || !assigner->own_without_grid))
    label += ", " + shown(result_case.grid.name);
  return label;
}

// Figures of samples are printed only if the case has all sets of the heading: with fewer sets they are not comparable.
Line line_of(const Case& result_case, bool is_on_front, const Extras& extras, RankBy by,
             const std::vector<std::string>& sets) {
  const bool is_of_sets = ranking_set_names(result_case) == sets;
  Line line;
  line.result_case = &result_case;
  const std::string label = table_label(result_case, extras);
  line.cells = {is_on_front ? "*" : "", label};
  for (const Column& column : k_columns)
    if (is_shown(column, extras))
      line.cells.push_back(column.is_at_samples && !is_of_sets ? "-" : column.text(result_case));
  line.has_failed = !result_case.failures.empty();
  line.sort_key = sort_key(result_case, by);
  return line;
}

std::set<std::string> ids_on_front(const result::Result& result) {
  std::set<std::string> ids;
  for (const result::Front& front : result.pareto_front) ids.insert(front.ids.begin(), front.ids.end());
  return ids;
}

Extras extras_of(const std::vector<Case>& cases) {
  Extras extras;
  std::set<std::string> storages;
  for (const Case& result_case : cases) {
    storages.insert(result_case.storage);
    extras.times |= figure_of(result_case, "frame_us").has_value();
    extras.conversions |= figure_of(result_case, "convert_us").has_value();
    extras.builds |= figure_of(result_case, "builds_per_frame").value_or(0.0) != 0.0;
    extras.instructions |= result_case.count.has_value();
    extras.cold |= result_case.timing && result_case.timing->caches == "cold";
    extras.launches |= result_case.timing && result_case.timing->launches > 1u;
    extras.samples |= !ranking_set_names(result_case).empty();
    extras.costs |= result_case.cost.has_value();
    extras.searched |= samples_search(result_case) && !ranking_set_names(result_case).empty();
    extras.dropped |= result_case.buffers.overflow.dropped_pairs != 0;
    extras.device |= result_case.device.has_value();
    extras.device_cold |= result_case.device && result_case.device->warm;
    extras.device_builds |= result_case.device && result_case.device->build_ns;
  }
  extras.storages = storages.size() > 1;
  return extras;
}

// The optional columns of one block: methods on a device have times of their own.
Extras extras_in_block(Extras extras, const std::vector<const Case*>& cases) {
  if (!runs_on_device(*cases.front())) {
    extras.device = extras.device_cold = extras.device_builds = false;
    return extras;
  }
  extras.times = extras.conversions = extras.builds = extras.instructions = extras.costs = false;
  return extras;
}

// The counter with its instruction sets: "callgrind (AVX2)". "" without counts.
std::string counters(const std::vector<Case>& cases) {
  std::set<std::string> names;
  for (const Case& result_case : cases)
    if (result_case.count) names.insert(result_case.count->source + " (" + result_case.count->simd_target + ")");
  return joined(std::vector<std::string>(names.begin(), names.end()));
}

std::string scene_heading(const result::Scene& scene) {
  return shown(scene.name) + "  (" + number_of(scene.lights.point, "point") + ", " +
         number_of(scene.lights.spot, "spot") + ", " + number_of(scene.frames, "frame") + ")";
}

// Marks rows that are not slower than the row above for certain. True if there are any.
bool mark_alike(const result::Result& result, const Cells& heads, RankBy by, std::vector<Line>& lines) {
  const char* const heading = by == RankBy::frame_cost ? k_cost_heading : k_frame_heading;
  const auto column = std::find(heads.begin(), heads.end(), heading) - heads.begin();
  if (column == static_cast<std::ptrdiff_t>(heads.size())) return false;
  bool has_some = false;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (!ratio_of_cases(result, *lines[i].result_case, *lines[i - 1].result_case, by) ||
        takes_longer(result, *lines[i].result_case, *lines[i - 1].result_case, by))
      continue;
    lines[i].cells[static_cast<std::size_t>(column)].insert(0, "~");
    has_some = true;
  }
  return has_some;
}

// Explains the samples of the figures.
std::string sets_text(const std::vector<Case>& cases) {
  std::vector<std::string> lines;
  for (const Case& result_case : cases) {
    const std::vector<std::string> sets = ranking_set_names(result_case);
    if (sets.empty()) continue;
    const std::string heading = heading_of_sets(result_case);
    std::string line = heading.empty() ? "samples" : heading.substr(2, heading.size() - 3);
    line += ": " + result::words_of_sets(sets);
    if (sets.size() > 1) line += ", by the weights of the key `cost`; unlit: of the set that lacks most";
    if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
  }
  return lines.empty() ? "" : joined(lines, ". ") + ".\n";
}

// Explains the marks and columns of the table.
std::string legend(const std::vector<Case>& cases, const Extras& extras, RankBy by, bool has_front, bool is_complete) {
  std::string out;
  if (has_front)
    out += std::string("* ") + (extras.samples ? "at most 0.1 % unlit, and " : "") +
           "no other case of its camera is better in one of " +
           (by == RankBy::frame_cost ? "cost and bytes"
            : extras.times           ? "time, bytes and overshade"
                                     : "bytes and overshade") +
           " and as good in the rest.\n" +
           (extras.times ? "Times that are not known to differ count as equal.\n"
                         : "Of cases that are equal in all, a method gives way to its faster form (-fast).\n");
  if (extras.times)
    out += std::string("frame: time to make a frame's lists") + (extras.cold ? " with cold caches" : "") + ", assign" +
           (extras.conversions ? " + convert" : "") + "; ±: half of its 95 % interval" +
           (extras.launches ? " between launches" : "") + ", both sides where one is above 20 %" +
           ".\nworst: the slowest timed frame, @ its number; the frame with most pairs is always timed.\n";
  if (extras.builds) out += "build: preparing the method for a changed grid; it is part of assign.\n";
  if (extras.costs)
    out += std::string("cost: ") + (extras.times ? "frame, and " : "") +
           "upload, and reading and shading of the frame's samples, by the model of the key `cost`.\n";
  if (!is_complete) out += "-: not measured, or not comparable.\n";
  out += std::string("pairs: (cell, light) per frame") + (extras.times ? ", of the timed frames" : "") +
         ".\nexcess: false positives in % of true pairs. missed: true pairs that are not listed.\n";
  if (extras.dropped)
    out +=
        "dropped: pairs that the storage has no room for, over all frames. lost, worst: irradiance that samples lack, "
        "mean and most.\n";
  if (extras.samples)
    out +=
        "unlit: share of the lights that samples need and are not given. overshade: lights given at samples / lights "
        "needed.\n" +
        sets_text(cases);
  if (extras.searched)
    out +=
        "structures that samples search: no lists; each sample finds its lights in a hierarchy or in masks of bits, "
        "and\n" +
        std::string(extras.times ? "the times above are without that" : "that is not in their bytes") +
        ". They have no star: no GPU has measured the search (the key `cost` has a "
        "model "
        "of it). read: bytes that a\nsample reads to know its lights.\n";
  if (extras.device)
    out += std::string("device: the device's work for a frame by its own clock, from lights to lists") +
           (extras.device_cold ? ", with cold caches (warm: without)" : "") +
           "; ±: half of its 95 % interval;\nx floor: times what as many steps take that do nothing, the last of which "
           "writes\nas many bytes; upload, "
           "readback: of the frame's lights and lists" +
           (extras.device_builds ? "; build: of the cells, when the grid changes" : "") +
           ".\nThese times are not compared with the processor's.\n";
  return out + "bytes: headers and indices, largest of all frames.\n";
}

// The blocks of a scene: for each grid the cases with lists, then those that a device makes, then for each view those
// whose samples search the structure.
struct TableBlock {
  std::string heading;
  std::vector<const Case*> cases;
};
// "on llvmpipe (software, not sorted by time): "
std::string device_heading(const result::Result& result, const Case& result_case) {
  const std::string name = result.device        ? result.device->name
                           : result_case.device ? result_case.device->device
                                                : "a device";
  return "on " + shown(name) +
         (is_on_software_device(result, result_case) ? " (software, not sorted by time): " : ": ");
}

std::vector<TableBlock> table_blocks(const result::Result& result, const result::Scene& scene) {
  std::vector<TableBlock> lists, device_lists, searched;
  std::map<std::string, std::size_t> index_of;  // of a heading among its blocks
  for (const Case& result_case : result.cases) {
    if (result_case.scene != scene.name) continue;
    const bool is_searched = samples_search(result_case);
    std::string heading = block_of(result_case);
    if (is_searched) heading = "structures that samples search" + heading.substr(shown(result_case.grid.name).size());
    const bool is_on_device = runs_on_device(result_case);
    if (is_on_device) heading.insert(0, device_heading(result, result_case));
    std::vector<TableBlock>& blocks = is_on_device ? device_lists : is_searched ? searched : lists;
    const auto [at, is_new] = index_of.try_emplace(heading, blocks.size());
    if (is_new) blocks.push_back({heading, {}});
    blocks[at->second].cases.push_back(&result_case);
  }
  lists.insert(lists.end(), device_lists.begin(), device_lists.end());
  lists.insert(lists.end(), searched.begin(), searched.end());
  return lists;
}

// With the reason if all have the same, and with the methods that support boxes if some skipped ones do not.
std::string skipped_text(const std::vector<result::Skipped>& skipped) {
  if (skipped.empty()) return "";
  std::set<std::string> reasons;
  bool takes_no_boxes = false;
  for (const result::Skipped& skipped_case : skipped) {
    reasons.insert(skipped_case.reason);
    takes_no_boxes = takes_no_boxes || skipped_case.reason.ends_with(" takes no boxes");
  }
  std::string out = number_of(skipped.size(), "combination") + " of grid, method and storage left out";
  out += reasons.size() == 1 ? ": " + shown(*reasons.begin()) + ".\n"
                             : ", since they do not go together (`skipped` in the result).\n" + unable_text(skipped);
  if (!takes_no_boxes) return out;
  std::vector<std::string> names;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors())
    if (method->boxes && !method->naive) names.push_back(method->name);
  return out + "Boxes are taken by " + joined(names) + ".\n";
}

std::string broken_text(const result::Result& result) {
  if (!result.broken) return "";
  std::string out = number_of(result.broken->size(), "case") + " not measured to the end:\n";
  for (const result::BrokenCase& broken : *result.broken)
    out += "  " + shown(broken.name) + ": " + shown(broken.reason) + "\n";
  return out;
}

}  // namespace

std::string render_table(const result::Result& result, bool colour) {
  const std::vector<Case>& cases = result.cases;
  const std::set<std::string> on_front = ids_on_front(result);
  const std::string counted_by = counters(cases);
  const Extras extras = extras_of(cases);
  const RankBy by = rank_by(result);
  bool is_complete = true, has_alike = false;
  std::string out;
  for (const result::Scene& scene : result.scenes) {
    const std::vector<TableBlock> blocks = table_blocks(result, scene);
    if (blocks.empty()) continue;
    out += (colour ? k_bold : "") + scene_heading(scene) + (colour ? k_plain : "") + "\n";
    for (const TableBlock& block : blocks) {
      const Case& sampled = most_sampled(block.cases);
      const std::vector<std::string> sets = ranking_set_names(sampled);
      const Extras of_block = extras_in_block(extras, block.cases);
      const Cells heads = headings(of_block, sampled);
      std::vector<Line> lines;
      for (const Case* result_case : block.cases)
        lines.push_back(line_of(*result_case, on_front.contains(result_case->id), of_block, by, sets));
      if (!is_on_software_device(result, sampled)) std::ranges::stable_sort(lines, {}, &Line::sort_key);
      has_alike |= mark_alike(result, heads, by, lines);
      std::vector<Cells> rows{heads};
      for (const Line& line : lines) {
        rows.push_back(line.cells);
        is_complete = is_complete && std::find(line.cells.begin(), line.cells.end(), "-") == line.cells.end();
      }
      const std::vector<std::size_t> widths = widths_of(rows);
      out += " " + block.heading + "\n" + aligned(heads, widths);
      for (const Line& line : lines)
        out += line.has_failed && colour ? k_red + aligned(line.cells, widths) + k_plain : aligned(line.cells, widths);
    }
    out += "\n";
  }
  out += legend(cases, extras, by, !on_front.empty(), is_complete);
  if (has_alike) out += "~: not measurably slower than the row above (`clusterbench ratio`).\n";
  if (!counted_by.empty()) out += "instr: instructions of one frame's assignment, counted by " + counted_by + ".\n";
  out += skipped_text(result.skipped) + broken_text(result);
  return out + samples_table(result) + lookup_table(result) + stability_table(result) + fit_table(result) +
         reaction_table(result) + reading_table(result) + fallback_table(result) + precision_table(result) +
         pre_cull_table(result) + shadows_table(result) + preset_table(result) + notes_text(result) +
         warnings_text(result) + timing_warnings(result);
}

}  // namespace clusterbench::report
