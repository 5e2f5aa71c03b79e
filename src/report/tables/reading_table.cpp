#include "report/tables/reading_table.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/device_frames.h"
#include "result/at.h"
#include "run/cases/case_names.h"

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
  // Loses no light and fails nothing: else short lists would count as an advantage.
  bool is_sound;
  bool is_part;  // of the pixels

  bool is_first() const {  // that of the figures
    return set->set == result_case->reading->set && walk->walk == result_case->reading->walk;
  }
  // Older results have sums that are of no frame.
  std::optional<double> frame_ns() const {
    return is_first() && !is_part && !is_converted_untimed(*result_case) ? result_case->reading->frame_ns
                                                                         : std::nullopt;
  }
  bool has_lists() const { return result_case->storage != run::k_own_structure; }
};

bool is_sound(const Case& result_case) {
  const bool culls_lights = result_case.pre_cull && !result_case.pre_cull->conservative;
  return result_case.failures.empty() && loses_nothing_seen(result_case) && !culls_lights &&
         result_case.buffers.overflow.dropped_pairs == 0;
}

// Whether the figures' lines have the time of a frame, but for those whose lists the host has converted, which have
// none.
bool have_frames(const std::vector<ReadingLine>& lines) {
  const auto has_frame = [](const ReadingLine& line) { return line.frame_ns().has_value(); };
  return std::ranges::any_of(lines, has_frame) && std::ranges::all_of(lines, [&](const ReadingLine& line) {
           return !line.is_first() || has_frame(line) || is_converted_untimed(*line.result_case);
         });
}

std::string us_text(double ns) {
  const double us = ns / 1e3;
  return text(us < 10.0 ? "%.2f" : us < 1000.0 ? "%.1f" : "%.0f", us);
}

std::string line_name(const ReadingLine& line) {
  return method_name(*line.result_case) + " / " + storage_name(*line.result_case);
}

std::vector<ReadingLine> lines_of(const std::vector<const Case*>& cases, const std::string& device,
                                  const result::Json& config) {
  std::vector<ReadingLine> lines;
  bool is_software = false;
  for (const Case* in_block : cases) {
    const Case& result_case = *in_block;
    if (!result_case.reading || result_case.reading->device != device) continue;
    is_software |= result_case.reading->software;
    const std::vector<SetReading>& sets = result_case.reading->sets;
    for (std::size_t set = 0; set < sets.size(); ++set)
      for (std::size_t walk = 0; walk < sets[set].walks.size(); ++walk)
        lines.push_back({&result_case, &sets[set], &sets[set].walks[walk], set, walk, is_sound(result_case),
                         reads_a_part(sets[set].set, config)});
  }
  const bool is_by_frame = have_frames(lines);
  const auto key = [&](const ReadingLine& line) {
    const bool has_frame = is_by_frame && line.frame_ns();
    const double ns = has_frame ? *line.frame_ns() : line.walk->read_ns.median;
    return std::tuple(line.set_order, line.walk_order, !is_software && !line.is_sound,
                      !is_software && is_by_frame && line.is_first() && !has_frame, is_software ? 0.0 : ns);
  };
  std::ranges::stable_sort(lines, {}, key);
  return lines;
}

Cells cells_of(const ReadingLine& line, bool has_frames) {
  const Reading& reading = *line.result_case->reading;
  const WalkReading& walk = *line.walk;
  Cells cells{line.is_sound ? "" : "!",
              line_name(line),
              line.set->set,
              walk.walk,
              us_text(walk.read_ns.median),
              interval_text(walk.read_ns),
              text_of(walk.exact_ratio, "%.2f"),
              text("%.2f", walk.nothing_ratio),
              us_text(walk.cold_ns.median),
              text("%.2f", line.set->lights),
              text("%.2f", line.set->reads),
              short_count(reading.structure_bytes)};
  if (has_frames) cells.push_back(line.frame_ns() ? us_text(*line.frame_ns()) : "-");
  return cells;
}

// What exact lists may save of the figures' reading, by the far end of its interval.
double most_saved_ns(const ReadingLine& line) {
  return line.walk->read_ns.median * (1.0 - 1.0 / result::Pair(*line.walk->exact_ci95)[1]);
}

// The most that exact lists save, with lights as cheap as the reading's. Only where nothing is lost or dropped: shorter
// lists that lack lights are read faster than exact ones.
std::string savings_text(const std::vector<ReadingLine>& lines) {
  const ReadingLine* most = nullptr;
  bool has_ratios = false;
  for (const ReadingLine& line : lines) {
    if (!line.is_first() || !line.is_sound || !line.has_lists() || !line.walk->exact_ratio) continue;
    has_ratios = true;
    const bool is_known = line.walk->exact_ci95 && std::isfinite(result::Pair(*line.walk->exact_ci95)[1]);
    if (is_known && (most == nullptr || most_saved_ns(line) > most_saved_ns(*most))) most = &line;
  }
  if (!has_ratios) return "";
  if (most == nullptr)
    return "   What exact lists would save is not known: an interval takes 6 rounds (reading.rounds).\n";
  if (most_saved_ns(*most) <= 0.0)
    return "   Exact lists in the same storage would be read no faster than any of these lists.\n";
  const auto [low, high] = result::Pair(*most->walk->exact_ci95);
  return "   Exact lists in the same storage would save a frame at most " + us_text(most_saved_ns(*most)) +
         " us of reading, those of " + line_name(*most) + text(" (x %.3g", low) + text(" to %.3g)", high) +
         ": with as cheap a light as here, a tighter method must not cost more than that.\n";
}

// The cheapest frame, and the next.
std::string cheapest_text(const std::vector<ReadingLine>& lines) {
  const bool has_next = lines.size() > 1 && lines[1].is_sound && lines[1].is_first() && lines[1].frame_ns();
  return "   Cheapest with its assignment and upload: " + line_name(lines[0]) + ", " + us_text(*lines[0].frame_ns()) +
         " us a frame" +
         (has_next ? "; " + line_name(lines[1]) +
                         text(" costs %.3g times as much", *lines[1].frame_ns() / *lines[0].frame_ns())
                   : "") +
         ".\n";
}

std::string fault_text(const std::vector<ReadingLine>& lines) {
  std::uint64_t differing = 0;
  for (const ReadingLine& line : lines)
    if (line.walk == line.set->walks.data()) differing += line.set->differing;  // once for each set of a case
  if (differing == 0) return "";
  return "   " + number_of(differing, "walk") +
         " met other lights than the structure has, or another cell: a fault; do not trust these times.\n";
}

std::string reading_block(const std::string& block, const std::vector<ReadingLine>& lines) {
  const bool has_frames =
      std::ranges::any_of(lines, [](const ReadingLine& line) { return line.frame_ns().has_value(); });
  Cells headings{"",        "structure", "samples", "walk",   "read us", "±",
                 "x exact", "x nothing", "cold us", "lights", "reads",   "bytes"};
  if (has_frames) headings.push_back("frame us");
  std::vector<Cells> rows{headings};
  for (const ReadingLine& line : lines) rows.push_back(cells_of(line, has_frames));
  std::string out = " " + block + "\n" + aligned_rows(rows);
  if (lines.front().result_case->reading->software) return out + fault_text(lines);
  out += savings_text(lines);
  const bool is_known = lines.front().is_sound && lines.front().is_first() && lines.front().frame_ns();
  if (is_known && have_frames(lines)) out += cheapest_text(lines);
  return out + fault_text(lines);
}

std::vector<std::string> devices_of_scene(const result::Result& result, const result::Scene& scene) {
  std::vector<std::string> devices;
  for (const Case& result_case : result.cases)
    if (result_case.reading && result_case.scene == scene.name &&
        std::ranges::find(devices, result_case.reading->device) == devices.end())
      devices.push_back(result_case.reading->device);
  return devices;
}

}  // namespace

std::string reading_table(const result::Result& result) {
  std::string out;
  bool has_frames = false, has_unsound = false, is_part = false, is_converted = false;
  for (const result::Scene& scene : result.scenes)
    for (const std::string& device : devices_of_scene(result, scene)) {
      std::string blocks;
      bool is_software = false;
      for (const CaseBlock& block : blocks_of(result.cases, scene)) {
        const std::vector<ReadingLine> lines = lines_of(block.cases, device, result.config);
        if (lines.empty()) continue;
        blocks += reading_block(block.name, lines);
        is_software = lines.front().result_case->reading->software;
        for (const ReadingLine& line : lines) {
          has_frames |= line.frame_ns().has_value();
          has_unsound |= !line.is_sound;
          is_part |= line.is_part;
          is_converted |= is_converted_untimed(*line.result_case);
        }
      }
      out += "reading on " + shown(device) + ": " + shown(scene.name) + "\n";
      if (is_software)
        out +=
            " A software device: these times are a processor's and no GPU's. They are not sorted, and rank nothing.\n";
      out += blocks + "\n";
    }
  if (out.empty()) return out;
  return "\n" + out +
         "read: a frame's samples look up their lists, walk them and add a small attenuation for each light, by the "
         "device's clock;\ncold: the same once after other memory. x exact: times the same with exact lists of all "
         "lights (beside structures without lists: in\npacked). x nothing: times looking up cells and reading no list. "
         "lights, reads: walked lights and fetched elements of a sample.\n" +
         (has_frames ? "frame: assignment, upload and this reading, less what runs beside other work (reading.async).\n"
                     : "") +
         (has_frames && is_converted ? "No frame where lists of the device are in another storage: making that is not "
                                       "timed.\n"
                                     : "") +
         (is_part ? "Samples of a part of the pixels (reading.divisor) have no frame.\n" : "") +
         (has_unsound ? "!: lacks lights that are needed (lost, dropped or culled), which makes lists short, fails, or "
                        "does not promise to have all\nlights: in no sentence, and last where lines are sorted.\n"
                      : "");
}

}  // namespace clusterbench::report
