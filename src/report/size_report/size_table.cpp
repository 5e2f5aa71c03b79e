#include "report/size_report/size_table.h"

#include <algorithm>
#include <set>

#include "core/text.h"
#include "report/cases/columns.h"
#include "report/sizing/size_words.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

// A column: its heading, and its text for a buffer.
struct BufferColumn {
  const char* heading;
  std::string (*cell)(const SizedBuffer& buffer);
};

std::string spread_text(const SizedBuffer& buffer, std::uint64_t FrameSpread::*value) {
  return buffer.spread ? std::to_string((*buffer.spread).*value) : "-";
}

constexpr BufferColumn k_buffer_columns[] = {
    {"buffer", [](const SizedBuffer& buffer) { return shown(buffer.name); }},
    {"min", [](const SizedBuffer& buffer) { return spread_text(buffer, &FrameSpread::min); }},
    {"median", [](const SizedBuffer& buffer) { return spread_text(buffer, &FrameSpread::p50); }},
    {"p90", [](const SizedBuffer& buffer) { return spread_text(buffer, &FrameSpread::p90); }},
    {"p99", [](const SizedBuffer& buffer) { return spread_text(buffer, &FrameSpread::p99); }},
    {"high water", [](const SizedBuffer& buffer) { return std::to_string(buffer.high_water); }},
    {"of possible", [](const SizedBuffer& buffer) { return share_text(buffer.high_water, buffer.theoretical_max); }},
    {"capacity", [](const SizedBuffer& buffer) { return std::to_string(buffer.capacity); }},
    {"warn above", [](const SizedBuffer& buffer) { return buffer.is_all() ? "-" : std::to_string(buffer.warn_above); }},
    {"x bytes", [](const SizedBuffer& buffer) { return std::to_string(buffer.element_bytes); }},
    {"= bytes", [](const SizedBuffer& buffer) { return std::to_string(buffer.bytes); }},
    {"double", [](const SizedBuffer& buffer) { return std::to_string(buffer.double_buffered_bytes()); }},
};

std::vector<Cells> table_rows(const SizedStructure& structure) {
  std::vector<Cells> rows{{""}};
  for (const BufferColumn& column : k_buffer_columns) rows.front().emplace_back(column.heading);
  for (const SizedBuffer& buffer : structure.buffers) {
    rows.push_back({""});
    for (const BufferColumn& column : k_buffer_columns) rows.back().push_back(column.cell(buffer));
  }
  return rows;
}

// True if the need is equal in all frames of every group; groups may differ in a buffer that is always full, such as
// headers, whose number depends only on the grid.
bool is_same_in_all_frames(const SizedBuffer& buffer) {
  const auto is_constant = [](const std::optional<FrameSpread>& spread) {
    return spread && spread->min == spread->max;
  };
  if (buffer.groups.empty()) return is_constant(buffer.spread);
  const bool is_full = buffer.high_water == buffer.theoretical_max;
  return std::ranges::all_of(buffer.groups, [&](const FrameGroup& group) {
    return is_constant(group.spread) && (is_full || group.high_water == buffer.groups.front().high_water);
  });
}

// A row per buffer that differs between frames, for the cameras that share it in one frame, and for each camera that
// uses it alone.
std::vector<Cells> group_rows(const SizedStructure& structure) {
  std::vector<Cells> rows{
      {"", "cameras in one frame", "buffer", "frames", "min", "median", "p90", "p99", "high water"}};
  for (const SizedBuffer& buffer : structure.buffers) {
    if (is_same_in_all_frames(buffer)) continue;
    for (const FrameGroup& group : buffer.groups) {
      rows.push_back({"", shown(joined(group.cameras, " + ")), shown(buffer.name), std::to_string(group.frames)});
      for (const auto value : {&FrameSpread::min, &FrameSpread::p50, &FrameSpread::p90, &FrameSpread::p99})
        rows.back().push_back(group.spread ? std::to_string((*group.spread).*value) : "-");
      rows.back().push_back(std::to_string(group.high_water));
    }
  }
  return rows;
}

// The frames with the marks: usually the same for all buffers that differ between frames.
std::string worst_lines(const SizedStructure& structure) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_frame;
  for (const SizedBuffer& buffer : structure.buffers) {
    if (!buffer.spread || is_same_in_all_frames(buffer)) continue;
    const std::string worst = worst_text(buffer);
    const auto known = std::ranges::find_if(by_frame, [&](const auto& entry) { return entry.first == worst; });
    (known == by_frame.end() ? by_frame.insert(known, {worst, {}}) : known)->second.push_back(buffer.name);
  }
  std::string out;
  for (const auto& [worst, buffers] : by_frame)
    out += "  most " + shown(joined(buffers)) + " in " + shown(worst) + "\n";
  return out;
}

// Over all cameras; "" for a structure without lists.
std::string longest_line(const SizedStructure& structure) {
  double longest = 0.0;
  bool is_cut = false;  // by the method itself
  for (const result::Case* one : structure.cases) {
    if (!one->occupancy || structure.is_guest(one->camera)) continue;
    longest = std::max(longest, one->occupancy->lights_per_cell.max);
    is_cut = is_cut || (one->storage == run::k_own_structure && one->buffers.overflow.dropped_pairs > 0);
  }
  if (longest == 0.0) return "";
  return "  longest list: " + number_of(static_cast<std::uint64_t>(longest), "light") +
         (is_cut ? ", after the method itself dropped some: a cell needs more" : "") + "\n";
}

std::string marks_text(const SizedStructure& structure, const AllocationRules& rules) {
  std::string out;
  for (const SizedBuffer& buffer : structure.buffers) {
    for (const MarkLine& line : mark_lines(buffer, structure))
      out += "  " + line.label + ": " + shown(line.text) + "\n";
    // If the need is equal in all frames, a search can find no larger one.
    const bool is_constant = buffer.spread && buffer.spread->min == buffer.spread->max;
    if (buffer.found && !buffer.is_all() && !(is_constant && *buffer.found == buffer.high_water))
      out += "  capacity: " + shown(buffer.name) + ": " + std::to_string(buffer.capacity) + " = " +
             rule_text(buffer, rules) + "\n";
  }
  return out;
}

std::string note_lines(const SizedStructure& structure) {
  std::string out;
  for (const std::string& note : grid_notes(structure)) out += "  grid: " + shown(note) + "\n";
  for (const std::string& note : limit_notes(structure)) out += "  LIMIT: " + shown(note) + "\n";
  return out;
}

// "2 cameras, 602 frames", and the cameras drawn in one frame.
std::string counted_text(const SizedStructure& structure) {
  std::set<std::string> cameras;
  std::set<result::Counts2> viewports;
  for (const result::Case* result_case : structure.cases) {
    cameras.insert(result_case->camera);
    viewports.insert(result_case->viewport);
  }
  for (const std::string& guest : structure.guests) cameras.erase(guest);
  std::string out = number_of(cameras.size(), "camera") + ", " + number_of(structure.frames(), "frame");
  if (viewports.size() > 1) out += ", " + number_of(viewports.size(), "viewport");
  for (const std::vector<std::string>& view : structure.views)
    out += "; in one buffer in one frame: " + shown(joined(view, " + "));
  if (!structure.guests.empty()) out += "; in its grid, without lists of their own: " + shown(joined(structure.guests));
  if (!structure.left_out.empty())
    out += "; not counted, since they have no part in it: " + shown(joined(structure.left_out));
  return out;
}

std::string structure_text(const SizedStructure& structure, const AllocationRules& rules) {
  std::string out = shown(structure.name) + "  (" + counted_text(structure) + ")\n";
  if (!structure.choice.empty()) out += "  " + shown(structure.choice) + "\n";
  if (structure.buffers.empty()) return out + "  has no buffers\n";
  out += aligned_rows(table_rows(structure));
  if (structure.buffers.front().groups.size() > 1) out += aligned_rows(group_rows(structure));
  if (const std::string unseen = nothing_seen_text(structure); !unseen.empty()) out += "  " + unseen + "\n";
  out += worst_lines(structure) + longest_line(structure);
  out += note_lines(structure);
  out += marks_text(structure, rules);
  for (const std::string& line : guest_lines(structure)) out += "  " + shown(line) + "\n";
  if (const std::string dropped = dropped_text(structure); !dropped.empty())
    out += "  OVERFLOW: " + dropped + "; the capacities have room for them\n";
  return out;
}

bool is_bounded(const std::vector<NamedStructure>& structures) {
  for (const NamedStructure& named : structures)
    for (const SizedBuffer& buffer : named.structure.buffers)
      if (buffer.spread && !buffer.spread->is_exact) return true;
  return false;
}

}  // namespace

std::string size_table(const std::vector<NamedStructure>& structures, const std::string& remark,
                       const AllocationRules& rules) {
  if (structures.empty()) return "The result has no cases.\n";
  std::string out;
  for (const NamedStructure& named : structures) out += structure_text(named.structure, rules) + "\n";
  const bool has_views =
      std::ranges::any_of(structures, [](const NamedStructure& named) { return !named.structure.views.empty(); });
  const bool has_finds =
      std::ranges::any_of(structures, [](const NamedStructure& named) { return named.structure.is_searched(); });
  out += std::string(has_views ? "Elements over the frames of the cameras that made the high water; one allocation "
                                 "serves all. Capacity: "
                               : "Elements over all frames of all cameras. Capacity: ") +
         rule_text(rules, has_finds) + ", at most what is possible. Warn above " +
         text("%g %%", 100.0 * rules.warn_at) + " of it; \"-\": nothing can overflow. Double: double-buffered.\n";
  if (is_bounded(structures)) out += "Of long paths several frames are one number, and percentiles upper bounds.\n";
  if (!remark.empty()) out += remark + "\n";
  const bool is_searched =
      std::ranges::any_of(structures, [](const NamedStructure& named) { return named.structure.is_sought(); });
  const bool is_of_nothing = std::ranges::any_of(
      structures, [](const NamedStructure& named) { return is_sized_from_nothing(named.structure); });
  const bool is_too_narrow = std::ranges::any_of(
      structures, [](const NamedStructure& named) { return lack_lights(named.structure.guest_samples); });
  if (is_too_narrow)
    out +=
        "Next: one grid that holds all views, of a camera a little behind them: `clusterbench scene views LEVEL --add "
        "both=0,0,BACK`, for eyes BACK = half their distance over the tangent of half the horizontal field of view, "
        "and then --views both,... --grid-of both; or lists for each view, without --grid-of.\n";
  if (is_of_nothing) return out + "Do not allocate these: give cameras that see lights, or --worst-case.\n";
  return out + (is_searched
                    ? "Allocate these capacities; --format cpp, hlsl or glsl has them as code.\n"
                    : "Next: `clusterbench size LEVEL --worst-case` (of the scene, not of a result) searches for "
                      "frames that need more; --format cpp, hlsl or glsl prints the capacities as code.\n");
}

}  // namespace clusterbench::report
