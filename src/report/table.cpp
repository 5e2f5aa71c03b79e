#include "report/table.h"

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "assign/contract/assigner.h"
#include "core/text.h"
#include "report/columns.h"
#include "report/fit_table.h"
#include "report/frame_cost.h"
#include "report/json_values.h"
#include "report/limits.h"
#include "report/lookup_table.h"
#include "report/pre_cull_table.h"
#include "report/precision_table.h"
#include "report/preset_ranking.h"
#include "report/ratios.h"
#include "report/reaction_table.h"
#include "report/sample_sets.h"
#include "report/samples_table.h"
#include "report/shadows_table.h"
#include "report/stability_table.h"
#include "report/timing_warnings.h"
#include "report/warnings.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_red = "\033[31m";
constexpr const char* k_bold = "\033[1m";
constexpr const char* k_plain = "\033[0m";

constexpr const char* k_instructions = "/count/instructions_per_frame/assign";

struct Line {
  const Json* result_case = nullptr;
  Cells cells;
  bool has_failed = false;
  std::pair<bool, double> sort_key;
};

// What some cases have and others have not.
struct Extras {
  bool storages = false, times = false, conversions = false, builds = false, instructions = false, samples = false,
       dropped = false, cold = false, launches = false, costs = false, searched = false;
};

std::string time_text(const Json& result_case, const char* pointer) {
  const std::optional<double> ns = number_at(result_case, pointer);
  if (!ns) return "-";
  const double us = *ns / 1e3;
  return text(us < 10.0 ? "%.2f" : us < 1000.0 ? "%.1f" : "%.0f", us);
}

std::string worst_text(const Json& result_case) {
  const Json* frame = value_at(result_case, "/timing/worst_frame/frame");
  return frame == nullptr ? "-" : time_text(result_case, "/timing/worst_frame/ns") + " @" + frame->dump();
}

// The pairs of the frames that the time is of; without times those of all frames.
std::string pairs_text(const Json& result_case) {
  return short_count(
      result_case, number_at(result_case, "/timing/frame_ns/median") ? "/timing/pairs/mean" : "/occupancy/pairs/mean");
}

// Of the samples that the case is ranked by, as `unlit`.
std::string lost_lux_text(const Json& result_case, const char* what) {
  const Json* most = most_at_sets(result_case, what);
  const std::optional<double> loses = number_at(most != nullptr ? *most : result_case, "/lost_lux");
  if (loses && *loses == 0.0) return "0";
  return most != nullptr ? text_at(*most, what, "%.3g") : "-";
}

// What the star goes by; lists that leave lights out are short.
std::string overshade_text(const Json& result_case) {
  const std::optional<double> overshade = limit_figure(result_case, "overshade");
  return overshade ? text("%.2f", *overshade) : "-";
}

// Bytes of the structure that a sample reads to know its lights.
std::string read_bytes_text(const Json& result_case) {
  const std::optional<double> bytes = mean_at_samples(result_case, "read_bytes");
  return bytes ? text(*bytes < 100.0 ? "%.3g" : "%.0f", *bytes) : "-";
}

// Where nothing is timed what the GPU does.
std::string cost_text(const Json& result_case) {
  return time_text(result_case, number_at(result_case, "/cost/frame_ns") ? "/cost/frame_ns" : "/cost/gpu_ns");
}

// By cost those that leave lights out come last: theirs is not the cost of the same picture.
std::pair<bool, double> sort_key(const Json& result_case, RankBy by) {
  if (by == RankBy::frame_cost)
    for (const char* pointer : {"/cost/frame_ns", "/cost/gpu_ns"})
      if (const auto found = number_at(result_case, pointer)) return {!result_case["cost"].value("lit", true), *found};
  for (const char* pointer : {"/timing/frame_ns/median", k_instructions, "/error/excess_ratio"})
    if (const auto found = number_at(result_case, pointer)) return {false, *found};
  return {false, 0.0};
}

bool has_failed(const Json& result_case) {
  return !result_case["failures"].empty();
}

constexpr const char* k_frame_heading = "frame us";
constexpr const char* k_cost_heading = "cost us";

struct Column {
  const char* heading;
  std::string (*text)(const Json& result_case);
  bool Extras::*needed = nullptr;  // left out where the table has none of it
  bool is_at_samples = false;      // the heading says of which
};
constexpr bool k_at_samples = true;

constexpr Column k_columns[] = {
    {k_frame_heading, [](const Json& result_case) { return time_text(result_case, "/timing/frame_ns/median"); },
     &Extras::times},
    {"±", frame_interval_text, &Extras::times},
    {"worst us", worst_text, &Extras::times},
    {"assign", [](const Json& result_case) { return time_text(result_case, "/timing/assign_ns/median"); },
     &Extras::times},
    {"convert", [](const Json& result_case) { return time_text(result_case, "/timing/convert_ns/median"); },
     &Extras::conversions},
    {"build", [](const Json& result_case) { return time_text(result_case, "/timing/build_ns/median"); },
     &Extras::builds},
    {k_cost_heading, cost_text, &Extras::costs},
    {"instr", [](const Json& result_case) { return short_count(result_case, k_instructions); }, &Extras::instructions},
    {"pairs", pairs_text},
    {"ns/pair", [](const Json& result_case) { return text_at(result_case, "/timing/ns_per_pair", "%.2f"); },
     &Extras::times},
    {"excess", [](const Json& result_case) { return text_at(result_case, "/error/excess_ratio", "%.1f %%", 100.0); }},
    {"missed", [](const Json& result_case) { return text_at(result_case, "/error/false_negatives", "%.0f"); }},
    {"dropped", [](const Json& result_case) { return short_count(result_case, "/buffers/overflow/dropped_pairs"); },
     &Extras::dropped},
    {"lost lx", [](const Json& result_case) { return lost_lux_text(result_case, "/lost_lux"); }, &Extras::dropped},
    {"worst lx", [](const Json& result_case) { return lost_lux_text(result_case, "/darkest/lost_lux"); },
     &Extras::dropped},
    {"unlit", [](const Json& result_case) { return unlit_text(unlit_at_samples(result_case)); }, &Extras::samples,
     k_at_samples},
    {"overshade", overshade_text, &Extras::samples, k_at_samples},
    {"read", read_bytes_text, &Extras::searched},
    {"bytes", [](const Json& result_case) { return short_count(result_case, "/buffers/bytes/high_water"); }},
};

bool is_shown(const Column& column, const Extras& extras) {
  return column.needed == nullptr || extras.*column.needed;
}

Cells headings(const Extras& extras, const Json& sampled) {
  Cells cells{"", "assigner"};
  for (const Column& column : k_columns)
    if (is_shown(column, extras))
      cells.push_back(column.heading + (column.is_at_samples ? heading_of_sets(sampled) : std::string()));
  return cells;
}

// The case of a block that has the most sets of samples: headings are of these.
const Json& most_sampled(const std::vector<const Json*>& cases) {
  return **std::ranges::max_element(cases, {}, [](const Json* one) { return ranking_set_names(*one).size(); });
}

// Cases that samples search stand together, and so name their grids, where they use them.
std::string table_label(const Json& result_case, const Extras& extras) {
  std::string label = method_name(result_case);
  if (extras.storages) label += " / " + storage_name(result_case);
  const assign::AssignerDescriptor* assigner =
      assign::find_assigner(result_case["assigner"]["name"].get<std::string>());
  if (samples_search(result_case) && (assigner == nullptr || !assigner->own_without_grid))
    label += ", " + shown(result_case["grid"]["name"]);
  return label;
}

// At samples only of the sets in the heading: of fewer ones a figure is another.
Line line_of(const Json& result_case, bool is_on_front, const Extras& extras, RankBy by,
             const std::vector<std::string>& sets) {
  const bool is_of_sets = ranking_set_names(result_case) == sets;
  Line line;
  line.result_case = &result_case;
  const std::string label = table_label(result_case, extras);
  line.cells = {is_on_front ? "*" : "", label};
  for (const Column& column : k_columns)
    if (is_shown(column, extras))
      line.cells.push_back(column.is_at_samples && !is_of_sets ? "-" : column.text(result_case));
  line.has_failed = has_failed(result_case);
  line.sort_key = sort_key(result_case, by);
  return line;
}

std::set<std::string> ids_on_front(const Json& result) {
  std::set<std::string> ids;
  for (const Json& front : result["pareto_front"])
    for (const Json& id : front["ids"]) ids.insert(id.get<std::string>());
  return ids;
}

Extras extras_of(const Json& cases) {
  Extras extras;
  std::set<std::string> storages;
  for (const Json& result_case : cases) {
    storages.insert(result_case["storage"].get<std::string>());
    extras.times |= number_at(result_case, "/timing/frame_ns/median").has_value();
    extras.conversions |= number_at(result_case, "/timing/convert_ns/median").has_value();
    extras.builds |= number_at(result_case, "/timing/builds_per_frame").value_or(0.0) != 0.0;
    extras.instructions |= result_case.contains("count");
    extras.cold |= result_case.contains("timing") && result_case["timing"].value("caches", "") == "cold";
    extras.launches |= result_case.contains("timing") && result_case["timing"].value("launches", 1) > 1;
    extras.samples |= !ranking_set_names(result_case).empty();
    extras.costs |= result_case.contains("cost");
    extras.searched |= samples_search(result_case) && !ranking_set_names(result_case).empty();
    extras.dropped |= result_case["buffers"]["overflow"]["dropped_pairs"] != 0;
  }
  extras.storages = storages.size() > 1;
  return extras;
}

// What counted, on which instruction sets: "callgrind (AVX2)". "" where nothing did.
std::string counters(const Json& cases) {
  std::set<std::string> names;
  for (const Json& result_case : cases)
    if (result_case.contains("count"))
      names.insert(result_case["count"]["source"].get<std::string>() + " (" +
                   result_case["count"]["simd_target"].get<std::string>() + ")");
  return joined(std::vector<std::string>(names.begin(), names.end()));
}

std::string scene_heading(const Json& scene) {
  const Json& lights = scene["lights"];
  return shown(scene["name"]) + "  (" + number_of(lights["point"].get<std::uint64_t>(), "point") + ", " +
         number_of(lights["spot"].get<std::uint64_t>(), "spot") + ", " +
         number_of(scene["frames"].get<std::uint64_t>(), "frame") + ")";
}

// Rows that are not known to take longer than those above them. True if there are any.
bool mark_alike(const Json& result, const Cells& heads, RankBy by, std::vector<Line>& lines) {
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

// Of which samples the figures are.
std::string sets_text(const Json& cases) {
  std::vector<std::string> lines;
  for (const Json& result_case : cases) {
    const std::vector<std::string> sets = ranking_set_names(result_case);
    if (sets.empty()) continue;
    const std::string heading = heading_of_sets(result_case);
    std::string line = heading.empty() ? "samples" : heading.substr(2, heading.size() - 3);
    line += ": " + words_of_sets(sets);
    if (sets.size() > 1) line += ", by the weights of the key `cost`; unlit: of the set that lacks most";
    if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
  }
  return lines.empty() ? "" : joined(lines, ". ") + ".\n";
}

// Of the marks and columns that the table has.
std::string legend(const Json& cases, const Extras& extras, RankBy by, bool has_front, bool is_complete) {
  std::string out;
  if (has_front)
    out += std::string("* ") + (extras.samples ? "at most 0.1 % unlit, and " : "") +
           "no other case of its camera is better in one of " +
           (by == RankBy::frame_cost ? "cost and bytes"
            : extras.times           ? "time, bytes and overshade"
                                     : "bytes and overshade") +
           " and as good in the rest.\n" +
           (extras.times ? "Times that are not known to differ count as equal.\n"
                         : "Of cases that are equal in all, one ending in -fast has it.\n");
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
  return out + "bytes: headers and indices, largest of all frames.\n";
}

// The blocks of a scene: of each grid the cases with lists, then of each view those that samples search.
struct TableBlock {
  std::string heading;
  std::vector<const Json*> cases;
};
std::vector<TableBlock> table_blocks(const Json& cases, const Json& scene) {
  std::vector<TableBlock> lists, searched;
  for (const Json& result_case : cases) {
    if (result_case["scene"] != scene["name"]) continue;
    const bool is_searched = samples_search(result_case);
    std::string heading = block_of(result_case);
    if (is_searched)
      heading = "structures that samples search" + heading.substr(shown(result_case["grid"]["name"]).size());
    std::vector<TableBlock>& blocks = is_searched ? searched : lists;
    auto found = std::ranges::find(blocks, heading, &TableBlock::heading);
    if (found == blocks.end()) found = blocks.insert(blocks.end(), {heading, {}});
    found->cases.push_back(&result_case);
  }
  lists.insert(lists.end(), searched.begin(), searched.end());
  return lists;
}

// With the reason where all have one, and with what takes boxes where that is what most methods lack.
std::string skipped_text(const Json& skipped) {
  if (skipped.empty()) return "";
  std::set<std::string> reasons;
  bool takes_no_boxes = false;
  for (const Json& skipped_case : skipped) {
    const auto reason = skipped_case["reason"].get<std::string>();
    reasons.insert(reason);
    takes_no_boxes = takes_no_boxes || reason.ends_with(" takes no boxes");
  }
  std::string out = number_of(skipped.size(), "combination") + " of grid, method and storage left out";
  out += reasons.size() == 1 ? ": " + shown(Json(*reasons.begin())) + ".\n"
                             : ", since they do not go together (`skipped` in the result).\n";
  if (!takes_no_boxes) return out;
  std::vector<std::string> names;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors())
    if (method->boxes && !method->naive) names.push_back(method->name);
  return out + "Boxes are taken by " + joined(names) + ".\n";
}

}  // namespace

std::string render_table(const Json& result, bool colour) {
  const Json& cases = result["cases"];
  const std::set<std::string> on_front = ids_on_front(result);
  const std::string counted_by = counters(cases);
  const Extras extras = extras_of(cases);
  const RankBy by = rank_by(result);
  bool is_complete = true, has_alike = false;
  std::string out;
  for (const Json& scene : result["scenes"]) {
    const std::vector<TableBlock> blocks = table_blocks(cases, scene);
    if (blocks.empty()) continue;
    out += (colour ? k_bold : "") + scene_heading(scene) + (colour ? k_plain : "") + "\n";
    for (const TableBlock& block : blocks) {
      const Json& sampled = most_sampled(block.cases);
      const std::vector<std::string> sets = ranking_set_names(sampled);
      const Cells heads = headings(extras, sampled);
      std::vector<Line> lines;
      for (const Json* result_case : block.cases)
        lines.push_back(
            line_of(*result_case, on_front.contains((*result_case)["id"].get<std::string>()), extras, by, sets));
      std::stable_sort(lines.begin(), lines.end(),
                       [](const Line& a, const Line& b) { return a.sort_key < b.sort_key; });
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
  out += skipped_text(result["skipped"]);
  return out + samples_table(result) + lookup_table(result) + stability_table(result) + fit_table(result) +
         reaction_table(result) + fallback_table(result) + precision_table(result) + pre_cull_table(result) +
         shadows_table(result) + preset_table(result) + notes_text(result) + warnings_text(result) +
         timing_warnings(cases);
}

}  // namespace clusterbench::report
