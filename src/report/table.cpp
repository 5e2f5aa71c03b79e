#include "report/table.h"

#include <algorithm>
#include <set>
#include <vector>

#include "core/text.h"
#include "report/columns.h"
#include "report/lookup_table.h"
#include "report/precision_table.h"
#include "report/stability_table.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_red = "\033[31m";
constexpr const char* k_bold = "\033[1m";
constexpr const char* k_plain = "\033[0m";

constexpr const char* k_instructions = "/count/instructions_per_frame/assign";

// The place of the instructions' column, where there is one.
constexpr std::ptrdiff_t k_instructions_column = 3;

const Cells k_headings{"",       "assigner", "assign us", "ns/pair", "floor",  "pairs",
                       "excess", "missed",   "p99",       "bytes",   "entries"};

struct Line {
  Cells cells;
  bool has_failed = false;
  double sort_key = 0.0;
};

std::string time_text(const Json& one) {
  const Json::json_pointer place("/timing/assign_ns/median");
  if (!one.contains(place) || !one[place].is_number()) return "-";
  const double us = one[place].get<double>() / 1e3;
  return text(us < 10.0 ? "%.2f" : us < 1000.0 ? "%.1f" : "%.0f", us);
}

double sort_key(const Json& one) {
  for (const char* pointer : {"/timing/assign_ns/median", k_instructions, "/error/excess_ratio"}) {
    const Json::json_pointer place(pointer);
    if (one.contains(place) && one[place].is_number()) return one[place].get<double>();
  }
  return 0.0;
}

bool has_failed(const Json& one) {
  if (!one.contains("error")) return false;
  const Json &error = one["error"], &assigner = one["assigner"];
  const bool is_exact = assigner["exact"] == true;
  return (error["false_negatives"] != 0 && (is_exact || assigner["conservative"] == true)) ||
         (error["false_positives"] != 0 && is_exact);
}

// What the table has beside the usual.
struct Extras {
  bool storages = false, instructions = false;
};

Cells headings(const Extras& extras) {
  Cells cells = k_headings;
  if (extras.instructions) cells.insert(cells.begin() + k_instructions_column, "instr");
  return cells;
}

Line line_of(const Json& one, bool is_on_front, const Extras& extras) {
  Line line;
  std::string label = method_name(one);
  if (extras.storages) label += " / " + one["storage"].get<std::string>();
  line.cells = {is_on_front ? "*" : "",
                label,
                time_text(one),
                number_text(one, "/timing/ns_per_pair", "%.2f"),
                number_text(one, "/timing/floor_ratio", "%.1f"),
                short_count(one, "/occupancy/pairs/mean"),
                number_text(one, "/error/excess_ratio", "%.1f %%", 100.0),
                number_text(one, "/error/false_negatives", "%.0f"),
                number_text(one, "/occupancy/lights_per_cluster/p99", "%.0f"),
                short_count(one, "/buffers/bytes/high_water"),
                short_count(one, "/buffers/index_entries/recommended")};
  if (extras.instructions)
    line.cells.insert(line.cells.begin() + k_instructions_column, short_count(one, k_instructions));
  line.has_failed = has_failed(one);
  line.sort_key = sort_key(one);
  return line;
}

std::set<std::string> ids_on_front(const Json& result) {
  std::set<std::string> ids;
  for (const Json& front : result["front"])
    for (const Json& id : front["ids"]) ids.insert(id.get<std::string>());
  return ids;
}

bool has_several_storages(const Json& cases) {
  std::set<std::string> storages;
  for (const Json& one : cases) storages.insert(one["storage"].get<std::string>());
  return storages.size() > 1;
}

// Who counted, on which instruction sets: "callgrind (AVX2)". "" where nobody did.
std::string counters(const Json& cases) {
  std::set<std::string> names;
  for (const Json& one : cases)
    if (one.contains("count"))
      names.insert(one["count"]["source"].get<std::string>() + " (" + one["count"]["simd_target"].get<std::string>() +
                   ")");
  return joined(std::vector<std::string>(names.begin(), names.end()));
}

std::string scene_heading(const Json& scene) {
  const Json& lights = scene["lights"];
  return shown(scene["name"]) + "  (" + number_of(lights["point"].get<std::uint64_t>(), "point") + ", " +
         number_of(lights["spot"].get<std::uint64_t>(), "spot") + ", " +
         number_of(scene["frames"].get<std::uint64_t>(), "frame") + ")";
}

std::string scene_warnings(const Json& result) {
  std::string out;
  for (const Json& scene : result["scenes"]) {
    const Json& rule = scene["range_rule"];
    const auto made = rule["from_intensity"].get<std::uint64_t>() + rule["clamped"].get<std::uint64_t>();
    if (made > 0)
      out +=
          "warning: " + shown(scene["name"]) + ": " + number_of(made, "light") +
          (made == 1 ? " has no range; it ends where it falls to " : " have no range; they end where they fall to ") +
          text("%g", rule["cutoff_lux"].get<double>()) + " lux, at most " +
          text("%g", rule["max_range"].get<double>()) + " m (range_rule)\n";
    for (const Json& warning : scene["warnings"])
      out += "warning: " + shown(scene["name"]) + ": " + shown(warning) + "\n";
  }
  return out;
}

std::string overflow_text(const Json& overflow) {
  const auto number = [&](const char* key, const char* word) {
    return number_of(overflow[key].get<std::uint64_t>(), word);
  };
  return number("dropped_pairs", "pair") + " dropped in " + number("cells", "cell") + " of " +
         number("frames", "frame");
}

std::string case_warnings(const Json& cases) {
  std::string out;
  for (const Json& one : cases) {
    const Json& overflow = one["buffers"]["overflow"];
    if (overflow["dropped_pairs"] != 0) out += "warning: " + shown(one["name"]) + ": " + overflow_text(overflow) + "\n";
    for (const char* part : {"error", "stability"})
      if (one.contains(part) && one[part]["undecided"] != 0)
        out += "warning: " + shown(one["name"]) + ": " + part + ": " +
               number_of(one[part]["undecided"].get<std::uint64_t>(), "undecided pair") + " counted as true\n";
  }
  return out;
}

// Of the marks and columns that have something in them.
std::string legend(const Json& cases, bool has_front) {
  const auto is_timed = [](const Json& one) { return time_text(one) != "-"; };
  const bool any_timed = std::any_of(cases.begin(), cases.end(), is_timed);
  std::string out;
  if (has_front)
    out += std::string("* no other case of its scene, camera and viewport is better in ") +
           (any_timed ? "time, bytes and overshade.\n" : "bytes and overshade.\n");
  if (any_timed) out += "floor: assign time / time to copy the lists.\n";
  if (!std::all_of(cases.begin(), cases.end(), is_timed)) out += "-: not measured.\n";
  return out +
         "excess: false positives in % of true pairs. missed: true pairs that are not listed. p99: lights per cell.\n"
         "entries: allocation with margin.\n";
}

}  // namespace

std::string render_table(const Json& result, bool colour) {
  const Json& cases = result["cases"];
  const std::set<std::string> on_front = ids_on_front(result);
  const std::string counted_by = counters(cases);
  const Extras extras{has_several_storages(cases), !counted_by.empty()};
  const Cells heads = headings(extras);
  std::string out;
  for (const Json& scene : result["scenes"]) {
    const std::vector<std::string> blocks = blocks_of(cases, scene);
    if (blocks.empty()) continue;
    out += (colour ? k_bold : "") + scene_heading(scene) + (colour ? k_plain : "") + "\n";
    for (const std::string& block : blocks) {
      std::vector<Line> lines;
      for (const Json& one : cases)
        if (one["scene"] == scene["name"] && block_of(one) == block)
          lines.push_back(line_of(one, on_front.contains(one["id"].get<std::string>()), extras));
      std::stable_sort(lines.begin(), lines.end(),
                       [](const Line& a, const Line& b) { return a.sort_key < b.sort_key; });
      std::vector<Cells> rows{heads};
      for (const Line& line : lines) rows.push_back(line.cells);
      const std::vector<std::size_t> widths = widths_of(rows);
      out += " " + block + "\n" + aligned(heads, widths);
      for (const Line& line : lines)
        out += line.has_failed && colour ? k_red + aligned(line.cells, widths) + k_plain : aligned(line.cells, widths);
    }
    out += "\n";
  }
  out += legend(cases, !on_front.empty());
  if (!counted_by.empty()) out += "instr: instructions of one frame's assignment, counted by " + counted_by + ".\n";
  if (!result["skipped"].empty())
    out += number_of(result["skipped"].size(), "combination") + " skipped; the result says why.\n";
  return out + lookup_table(result) + stability_table(result) + precision_table(result) + scene_warnings(result) +
         case_warnings(cases);
}

}  // namespace clusterbench::report
