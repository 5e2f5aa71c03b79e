#include "report/sizing/size_words.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/text.h"
#include "measure/samples/shading.h"
#include "report/cases/columns.h"
#include "report/sizing/buffer_tail.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::number;

std::string rounding_text(const AllocationRules& rules) {
  const char* rounding = rules.rounding == Rounding::page           ? ", rounded up to whole pages of 4 KiB"
                         : rules.rounding == Rounding::power_of_two ? ", rounded up to a power of two bytes"
                                                                    : "";
  return text("%g", rules.margin) + rounding;
}

std::string growth_text(const SizedBuffer& buffer, std::uint64_t frames) {
  std::string out;
  for (const Growth& growth : buffer.growth)
    if (growth.every > 1)
      out += (out.empty() ? "; of every " : ", ") + std::to_string(growth.every) +
             (growth.every == 8   ? "th frame "
              : growth.every == 4 ? "th "
                                  : "nd ") +
             std::to_string(growth.high_water);
  // The growth that another doubling of frames may add.
  constexpr double k_still = 1.01;
  if (!buffer.growth.empty() &&
      static_cast<double>(buffer.high_water) > k_still * static_cast<double>(buffer.growth[2].high_water))
    out += ": STILL GROWING, count more frames (of the scene, not of its result)";
  else if (constexpr std::uint64_t k_few = 30; frames < k_few && buffer.depends_on_view && !buffer.is_all())
    out += ": too few to tell whether other frames need more";
  return out;
}

std::string seen_text(const SizedBuffer& buffer, const SizedStructure& structure) {
  const std::string of_group = buffer.groups.empty() ? "" : " of " + buffer.worst_camera;
  const std::string frames = number_of(structure.frames_of(buffer), "frame") + of_group;
  if (!buffer.why_sum.empty())
    return std::to_string(buffer.high_water) + " in " + frames + ", if each view needs its most at the same time (" +
           buffer.why_sum + ", so that frames cannot be paired)";
  std::string out =
      std::to_string(buffer.high_water) + " in " + frames + growth_text(buffer, structure.frames_of(buffer));
  if (buffer.apart > buffer.high_water)
    out += "; " + std::to_string(buffer.apart) + " if each view needed its most at the same time";
  if (!buffer.has_times) out += " (the result does not tell whether frames of one number are of one time)";
  return out;
}

std::string found_text(const SizedBuffer& buffer, const SizedStructure& structure) {
  if (structure.searches.empty()) return "not searched: --worst-case looks where no camera was recorded";
  if (!structure.is_searched()) return "not searched: " + structure.searches.front().refusal;
  if (!buffer.found) return "nothing for this buffer";
  const FoundFrame& found = structure.searches[buffer.found_by];
  const std::string tried = tried_text(found);
  const std::size_t cameras = structure.searched_cameras();
  const bool is_alike = std::ranges::all_of(
      structure.searches, [&](const FoundFrame& one) { return !one.refusal.empty() || tried_text(one) == tried; });
  const std::string of_cameras = cameras < 2 ? ""
                                 : is_alike  ? " for each of " + std::to_string(cameras) + " cameras"
                                             : ", by one of the searches of " + std::to_string(cameras) + " cameras";
  // A frame found for another measure is valid, but it is not the maximum for this buffer.
  std::string out = std::to_string(*buffer.found) +
                    (found.measure == structure.sought_measure()
                         ? " in " + tried + of_cameras
                         : " in the worst frame of a search with --measure " + found.measure + ", of " + tried);
  if (buffer.found_views > 1)
    out += ", " + std::to_string(buffer.found_views) + " views together, each in its own worst frame";
  if (buffer.high_water > 0)
    out +=
        text(", %.2f times the most seen", static_cast<double>(*buffer.found) / static_cast<double>(buffer.high_water));
  if (const std::string place = place_text(found); !place.empty())
    out += (buffer.found_views > 1 ? "; the worst: " : ", ") +
           (structure.cases.size() > 1 ? "camera " + structure.camera_of(found) + " " : std::string()) + place;
  if (*buffer.found > buffer.capacity) out += ": MORE THAN THE CAPACITY";
  if (!structure.is_sought())
    out += "; what this buffer needs was not searched for: --worst-case, or worst-case --measure " +
           structure.sought_measure();
  return out;
}

// One allocation for lists of all viewports, with tiles that differ between them.
bool has_viewports_of_pixel_tiles(const SizedStructure& structure) {
  std::set<result::Counts2> viewports;
  for (const Case* result_case : structure.cases) viewports.insert(result_case->viewport);
  const std::optional<result::Tiles>& tiles = structure.cases.front()->grid.tiles;
  return viewports.size() > 1 && tiles && tiles->pixels;
}

bool lacks_lights(const GuestSamples& guest) {
  return static_cast<double>(guest.missed) > measure::k_most_unlit * static_cast<double>(guest.needed);
}

std::string possible_text(const SizedBuffer& buffer) {
  if (!buffer.is_bounded)
    return "not known: other frames can have more lights or cells in these lists than those that were counted";
  return std::to_string(buffer.theoretical_max) + " elements, " +
         std::to_string(buffer.theoretical_max * buffer.element_bytes) +
         " bytes (every light in every cell): with these lights a buffer of this size needs no check";
}

// A search moves towards lights, lit or dark.
std::string dark_text(const FoundFrame& found) {
  const bool are_all = found.dark_in_view == found.lights_in_view;
  return ", where " + (are_all ? "all" : std::to_string(found.dark_in_view) + " of the") + " " +
         number_of(found.lights_in_view, "light") + " in view are dark";
}

}  // namespace

std::string tried_text(const FoundFrame& found) {
  return number_of(static_cast<std::uint64_t>(found.evaluations), "frame") + " tried (seed " +
         std::to_string(found.seed) + (found.space_flags.empty() ? "" : ", " + found.space_flags) + ")";
}

std::string place_text(const FoundFrame& found) {
  const auto vector = [](const std::vector<double>& v) {
    return text("(%.7g", v[0] + 0.0) + text(", %.7g", v[1] + 0.0) + text(", %.7g)", v[2] + 0.0);  // no "-0"
  };
  if (found.eye_m.size() != 3) return "";
  return "at " + vector(found.eye_m) + " m" +
         (found.direction.size() == 3 ? " along " + vector(found.direction) : std::string()) +
         (found.dark_in_view == 0 ? "" : dark_text(found));
}

std::string rule_text(const AllocationRules& rules, bool is_searched) {
  return (is_searched ? "the larger of high water and find x " : "high water x ") + rounding_text(rules);
}

std::string rule_text(const SizedBuffer& buffer, const AllocationRules& rules) {
  if (buffer.is_bounded && buffer.capacity == std::max(buffer.theoretical_max, buffer.mark()))
    return "all that there can be";
  return (buffer.mark() > buffer.high_water ? "found by the search x " : "high water x ") + rounding_text(rules);
}

std::vector<MarkLine> mark_lines(const SizedBuffer& buffer, const SizedStructure& structure) {
  if (buffer.is_all()) return {};
  const std::string name = buffer.name + ": ";
  std::vector<MarkLine> lines{{"most seen", name + seen_text(buffer, structure)},
                              {"most found by a search", name + found_text(buffer, structure)}};
  if (const std::string tail = tail_text(buffer); !tail.empty()) lines.push_back({"beyond the path", tail});
  lines.push_back({"can never overflow", name + possible_text(buffer)});
  return lines;
}

std::string worst_text(const SizedBuffer& buffer) {
  return "camera " + buffer.worst_camera + ", frame " + std::to_string(buffer.worst_frame) +
         (buffer.worst_cell ? ", cell " + result::Json(*buffer.worst_cell).dump() : "");
}

std::string share_text(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "-" : text("%.2f %%", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::vector<std::string> grid_notes(const SizedStructure& structure) {
  std::vector<std::pair<std::string, std::vector<std::string>>> notes;  // note, its cameras
  std::set<std::string> cameras;
  for (const Case* result_case : structure.cases) {
    const std::string& camera = result_case->camera;
    if (structure.is_guest(camera)) continue;
    cameras.insert(camera);
    if (!result_case->grid.note) continue;
    const std::string& note = *result_case->grid.note;
    auto known = std::ranges::find(notes, note, [](const auto& entry) { return entry.first; });
    if (known == notes.end()) known = notes.insert(known, {note, {}});
    if (std::ranges::find(known->second, camera) == known->second.end()) known->second.push_back(camera);
  }
  std::vector<std::string> out;
  for (const auto& [note, of] : notes)
    out.push_back(of.size() == cameras.size() ? note
                                              : (of.size() == 1 ? "camera " : "cameras ") + joined(of) + ": " + note);
  if (structure.jitters > 0)
    out.push_back("jittered: each frame has one of " + number_of(structure.jitters, "offset") +
                  " within a pixel, and with another one it can need a little more or less; the margin is for that");
  if (has_viewports_of_pixel_tiles(structure))
    out.push_back(
        "tiles of so many pixels: a picture of a size between these viewports, or below them, can need more, since its "
        "tiles lie elsewhere; name the sizes that occur, or keep a margin");
  return out;
}

std::vector<std::string> limit_notes(const SizedStructure& structure) {
  std::map<std::string, double> most_removed;  // by the step
  std::vector<std::string> notes;
  for (const Case* result_case : structure.cases) {
    if (result_case->pre_cull)
      for (const result::PreCullStep& step : result_case->pre_cull->steps) {
        const double removed = number<&result::PreCullStep::removed, &result::MeanMax::max>(step).value_or(0.0);
        if (step.label.starts_with("most(") && removed > 0.0)
          most_removed[step.label] = std::max(most_removed[step.label], removed);
      }
    const std::optional<result::Reaction>& react = result_case->react;
    if (react && react->fixed && react->fixed->index_entries > 0 && react->frames.reacted > 0)
      notes.push_back("tiles of camera " + result_case->camera +
                      " have grown for want of room; those that were asked for need up to " +
                      std::to_string(react->fixed->index_entries) + " entries");
  }
  for (const auto& [label, removed] : most_removed)
    notes.push_back(label + " took up to " + text("%.0f", removed) + " lights from a frame, and no list here has them");
  return notes;
}

std::vector<std::string> guest_lines(const SizedStructure& structure) {
  std::vector<std::string> lines;
  for (const GuestSamples& guest : structure.guest_samples)
    lines.push_back(std::string(lacks_lights(guest) ? "WARNING: " : "") + "samples of " + guest.camera +
                    " in this grid (points at random depths of its view, not on surfaces): " +
                    share_text(guest.outside, guest.samples) + " lie outside of it; " +
                    share_text(guest.missed, guest.needed) + " of the lights that they need are missing (" +
                    share_text(guest.missed_outside, guest.needed) + " outside), most in frame " +
                    std::to_string(guest.worst_frame));
  return lines;
}

bool lack_lights(const std::vector<GuestSamples>& guests) {
  return std::ranges::any_of(guests, lacks_lights);
}

std::string nothing_seen_text(const SizedStructure& structure) {
  const auto has_none = [&](std::optional<double> (*lights)(const Case&)) {
    return std::ranges::all_of(structure.cases,
                               [&](const Case* result_case) { return lights(*result_case).value_or(1.0) == 0.0; });
  };
  constexpr const char* k_says_nothing = "the frames that were counted say nothing of what frames with lights need";
  if (has_none(number<&Case::lights_in_view, &result::LightsInView::max>))
    return std::string("NO LIGHT was ever in view: ") + k_says_nothing;
  if (has_none(number<&Case::occupancy, &result::Occupancy::lights_per_cell, &result::LightsPerCell::max>))
    return std::string("NO LIST ever had a light: ") + k_says_nothing;
  return "";
}

bool is_sized_from_nothing(const SizedStructure& structure) {
  const auto found_some = [](const FoundFrame& found) { return found.refusal.empty() && found.value > 0; };
  return !nothing_seen_text(structure).empty() && std::ranges::none_of(structure.searches, found_some);
}

std::string dropped_text(const SizedStructure& structure) {
  std::uint64_t pairs = 0, cells = 0, frames = 0;
  for (const Case* result_case : structure.cases) {
    const result::Overflow& overflow = result_case->buffers.overflow;
    pairs += overflow.dropped_pairs;
    cells += overflow.cells;
    frames += overflow.frames;
  }
  if (pairs == 0) return "";
  return number_of(pairs, "pair") + " dropped in " + number_of(cells, "cell") + " of " + number_of(frames, "frame");
}

}  // namespace clusterbench::report
