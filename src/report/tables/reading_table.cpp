#include "report/tables/reading_table.h"

#include <algorithm>
#include <tuple>

#include "report/cases/columns.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Reading;
using result::SetReading;
using result::WalkReading;

struct ReadingLine {
  const Case* result_case;
  const SetReading* set;
  const WalkReading* walk;
  std::size_t set_order, walk_order;

  bool is_first() const { return set_order == 0 && walk_order == 0; }  // that of the figures
  std::optional<double> frame_ns() const { return is_first() ? result_case->reading->frame_ns : std::nullopt; }
};

bool have_frames(const std::vector<ReadingLine>& lines) {
  return std::ranges::all_of(lines, [](const ReadingLine& line) { return !line.is_first() || line.frame_ns(); });
}

std::string us_text(double ns) {
  const double us = ns / 1e3;
  return text(us < 10.0 ? "%.2f" : us < 1000.0 ? "%.1f" : "%.0f", us);
}

std::string half_interval_text(const result::Time& time) {
  const result::Pair& ends = time.ci95;
  if (!(ends[0] <= ends[1])) return k_unknown_interval;
  return text("%.1f %%", 50.0 * (ends[1] - ends[0]) / time.median);
}

std::string line_name(const ReadingLine& line) {
  return method_name(*line.result_case) + " / " + storage_name(*line.result_case);
}

std::vector<ReadingLine> lines_of(const std::vector<Case>& cases, const result::Scene& scene,
                                  const std::string& block) {
  std::vector<ReadingLine> lines;
  bool is_software = false;
  for (const Case& result_case : cases) {
    if (!result_case.reading || result_case.scene != scene.name || block_of(result_case) != block) continue;
    is_software |= result_case.reading->software;
    const std::vector<SetReading>& sets = result_case.reading->sets;
    for (std::size_t set = 0; set < sets.size(); ++set)
      for (std::size_t walk = 0; walk < sets[set].walks.size(); ++walk)
        lines.push_back({&result_case, &sets[set], &sets[set].walks[walk], set, walk});
  }
  const bool is_by_frame = have_frames(lines);
  const auto key = [&](const ReadingLine& line) {
    const double ns = is_by_frame && line.is_first() ? *line.frame_ns() : line.walk->read_ns.median;
    return std::tuple(line.set_order, line.walk_order, is_software ? 0.0 : ns);
  };
  std::ranges::stable_sort(lines, {}, key);
  return lines;
}

Cells cells_of(const ReadingLine& line, bool has_frames) {
  const Reading& reading = *line.result_case->reading;
  const WalkReading& walk = *line.walk;
  Cells cells{"",
              line_name(line),
              line.set->set,
              walk.walk,
              us_text(walk.read_ns.median),
              half_interval_text(walk.read_ns),
              text_of(walk.exact_ratio, "%.2f"),
              text("%.2f", walk.nothing_ratio),
              us_text(walk.cold_ns.median),
              text("%.2f", line.set->lights),
              text("%.2f", line.set->reads),
              short_count(reading.structure_bytes)};
  if (has_frames) cells.push_back(line.frame_ns() ? us_text(*line.frame_ns()) : "-");
  return cells;
}

// By how much exact lists would make the figures' reading faster, where that is most.
std::string savings_text(const std::vector<ReadingLine>& lines) {
  const ReadingLine* most = nullptr;
  const auto saved_ns = [](const ReadingLine& line) {
    return line.walk->exact_ns ? line.walk->read_ns.median - line.walk->exact_ns->median : 0.0;
  };
  for (const ReadingLine& line : lines)
    if (line.is_first() && line.walk->exact_ci95 && result::Pair(*line.walk->exact_ci95)[0] > 1.0 &&
        (most == nullptr || saved_ns(line) > saved_ns(*most)))
      most = &line;
  if (most == nullptr)
    return "   Exact lists are not known to be read faster than any of these: tighter ones save no reading.\n";
  return "   Exact lists in the same storage would save a frame at most " + us_text(saved_ns(*most)) +
         " us of reading, those of " + line_name(*most) + text(" (x %.2f)", *most->walk->exact_ratio) +
         ": what a tighter method may cost more.\n";
}

std::string fault_text(const std::vector<ReadingLine>& lines) {
  std::uint64_t differing = 0;
  for (const ReadingLine& line : lines) differing = std::max(differing, line.set->differing);
  if (differing == 0) return "";
  return "   At " + number_of(differing, "sample") +
         " the device walked other lights than the structure has: a fault; do not trust these times.\n";
}

std::string reading_block(const std::string& block, const std::vector<ReadingLine>& lines) {
  const auto has_frame = [](const ReadingLine& line) { return line.result_case->reading->frame_ns.has_value(); };
  const bool has_frames = std::ranges::any_of(lines, has_frame);
  Cells headings{"",        "structure", "samples", "walk",   "read us", "±",
                 "x exact", "x nothing", "cold us", "lights", "reads",   "bytes"};
  if (has_frames) headings.push_back("frame us");
  std::vector<Cells> rows{headings};
  for (const ReadingLine& line : lines) rows.push_back(cells_of(line, has_frames));
  std::string out = " " + block + "\n" + aligned_rows(rows);
  const bool has_exact =
      std::ranges::any_of(lines, [](const ReadingLine& line) { return line.is_first() && line.walk->exact_ratio; });
  if (lines.front().result_case->reading->software) return out + fault_text(lines);
  if (has_exact) out += savings_text(lines);
  if (have_frames(lines))
    out += "   Cheapest with its assignment and upload: " + line_name(lines.front()) + ", " +
           us_text(*lines.front().frame_ns()) + " us a frame.\n";
  return out + fault_text(lines);
}

}  // namespace

std::string reading_table(const result::Result& result) {
  std::string out;
  bool has_frames = false;
  for (const result::Scene& scene : result.scenes) {
    std::string blocks;
    const Reading* reading = nullptr;
    for (const std::string& block : blocks_of(result.cases, scene)) {
      const std::vector<ReadingLine> lines = lines_of(result.cases, scene, block);
      if (lines.empty()) continue;
      blocks += reading_block(block, lines);
      reading = &*lines.front().result_case->reading;
      for (const ReadingLine& line : lines) has_frames |= line.result_case->reading->frame_ns.has_value();
    }
    if (reading == nullptr) continue;
    out += "reading on " + shown(reading->device) + ": " + shown(scene.name) + "\n";
    if (reading->software)
      out += " A software device: these times are a processor's and no GPU's. They are not sorted, and rank nothing.\n";
    out += blocks + "\n";
  }
  if (out.empty()) return "";
  return "\n" + out +
         "read: a frame's samples look up their lists, walk them and add a small attenuation for each light, by the "
         "device's clock;\ncold: the same once after other memory. x exact: times the same with exact lists. x "
         "nothing: "
         "times looking up cells and\nreading no list. lights, reads: walked lights and fetched elements of a "
         "sample.\n" +
         (has_frames ? "frame: assignment, upload and this reading, less what runs beside other work (reading.async).\n"
                     : "");
}

}  // namespace clusterbench::report
