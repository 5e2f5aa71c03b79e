#include "report/presets/preset_ranking.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "config/presets/preset_library.h"
#include "core/text.h"
#include "measure/samples/shading.h"
#include "report/cases/case_costs.h"
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/nothing_seen.h"
#include "report/presets/preset_losses.h"
#include "report/presets/preset_words.h"
#include "result/at.h"
#include "result/rounding.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::number;

// Cases of one scene, camera and viewport.
struct View {
  std::string scene, camera;
  result::Counts2 viewport;

  friend bool operator==(const View&, const View&) = default;
};

View view_of(const Case& result_case) {
  return {result_case.scene, result_case.camera, result_case.viewport};
}

// One threshold for all causes of lost lights: above it, samples do not show the same picture. Samples that need few
// lights can prove a loss, but not the absence of one.
PresetStanding standing_of(const RankedPreset& row) {
  if (!row.unseen.empty() || !row.losses.unlit || !row.frame) return PresetStanding::unknown;
  if (*row.losses.unlit > measure::k_most_unlit) return PresetStanding::lacks_lights;
  if (!row.losses.is_decided()) return PresetStanding::unknown;
  return samples_search(*row.result_case) ? PresetStanding::searched : PresetStanding::lists;
}

bool is_better(const RankedPreset& a, const RankedPreset& b) {
  if (a.standing != b.standing) return a.standing < b.standing;
  if (a.standing == PresetStanding::unknown) return false;
  if (a.standing == PresetStanding::lacks_lights) return *a.losses.unlit < *b.losses.unlit;
  return a.gpu_ns() < b.gpu_ns();
}

// Places within each part: one more than the number of rows that are better for certain.
void give_places(std::vector<RankedPreset>& rows) {
  std::size_t part = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].standing != rows[part].standing) part = i;
    const bool is_priced = rows[i].standing == PresetStanding::lists || rows[i].standing == PresetStanding::searched;
    const auto is_known_better = [&](const RankedPreset& other) {
      return is_priced ? !are_alike(other.frame->cost, rows[i].frame->cost) : is_better(other, rows[i]);
    };
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(part);
    rows[i].place =
        1 + static_cast<int>(std::count_if(first, rows.begin() + static_cast<std::ptrdiff_t>(i), is_known_better));
  }
}

std::vector<RankedPreset> ranked(const std::vector<const Case*>& cases, const result::Json& config) {
  const std::string unseen = why_nothing_is_seen(cases, RankedBy::samples);
  std::vector<RankedPreset> rows;
  for (const Case* result_case : cases) {
    RankedPreset row{result_case, {},    whole_frame(*result_case, config), preset_losses(*result_case), 0,
                     &config,     unseen};
    row.standing = standing_of(row);
    rows.push_back(row);
  }
  std::ranges::stable_sort(rows, is_better);
  give_places(rows);
  return rows;
}

result::RankedPreset line_of(const RankedPreset& row, const RankedPreset& first) {
  const auto part = [&](double measure::FrameCost::*ns) {
    return row.frame ? result::counted(row.frame->cost.*ns) : result::k_none;
  };
  const std::optional<double> lights = mean_at_samples(*row.result_case, number<&result::SampleSet::evaluated>);
  result::RankedPreset line;
  line.id = row.result_case->id;
  line.preset = *row.result_case->preset;
  line.standing = name_of(row.standing);
  auto& place = line.place.emplace();
  if (row.standing != PresetStanding::unknown) place.emplace(static_cast<std::uint64_t>(row.place));
  line.gpu_ns = row.frame ? result::counted(row.gpu_ns()) : result::k_none;
  line.upload_ns = part(&measure::FrameCost::upload_ns);
  line.read_ns = part(&measure::FrameCost::read_ns);
  line.shade_ns = part(&measure::FrameCost::shade_ns);
  if (lights) line.lights_per_sample = result::counted(*lights);
  line.unlit = row.losses.unlit ? result::counted(*row.losses.unlit) : result::k_none;
  auto& missed = line.missed_in_view.emplace();
  if (row.losses.is_compared) missed.emplace(static_cast<std::int64_t>(row.losses.missed()));
  line.why = preset_reason(row, first);
  return line;
}

result::PresetRanking ranking_of(const View& view, const std::vector<RankedPreset>& rows) {
  const Case& any_case = *rows.front().result_case;
  result::PresetRanking out;
  out.scene = view.scene;
  out.camera = view.camera;
  out.viewport = {static_cast<std::int64_t>(view.viewport[0]), static_cast<std::int64_t>(view.viewport[1])};
  out.frames = any_case.frames;
  if (const auto& lights = any_case.lights_in_view)
    out.lights_in_view = result::RankedLights{lights->mean, static_cast<double>(lights->max)};
  std::vector<std::string>& alike = out.alike.emplace();
  for (const RankedPreset* row : recommended_presets(rows)) alike.push_back(row->result_case->id);
  if (!alike.empty()) out.best = alike.front();
  out.text = preset_conclusion(rows);
  const RankedPreset* first = &rows.front();
  for (const RankedPreset& row : rows) {
    if (row.standing != first->standing) first = &row;
    out.cases.push_back(line_of(row, *first));
  }
  return out;
}

// Older results have no places.
std::string place_text(const result::RankedPreset& line) {
  if (!line.place) return "";
  std::string place = line.place->has_value() ? std::to_string(**line.place) : "-";
  if (line.standing == name_of(PresetStanding::lists)) return place;
  return line.standing == name_of(PresetStanding::searched) ? "s" + place : "-";
}

// If an engine assigns on a GPU, the time of a processor is not its own; older results have one.
std::string assign_text(const Case& result_case) {
  if (runs_on_device(result_case)) return "device";
  const config::Preset* preset = config::find_preset(result_case.preset.value_or(""));
  if (preset != nullptr && preset->assigns_on_gpu()) return "gpu";
  return text_of(number<&Case::timing, &result::Timing::assign_ns, &result::Time::median>(result_case), "%.1f", 1e-3);
}

// Null if unknown.
const Case* case_of(const std::string& id, const std::vector<Case>& cases) {
  const auto found = std::ranges::find(cases, id, &Case::id);
  return found == cases.end() ? nullptr : &*found;
}

Cells cells_of(const result::RankedPreset& line, const Case& result_case, bool is_best) {
  using Line = result::RankedPreset;
  return {
      is_best ? "*" : "",
      line.preset,
      place_text(line),
      text_of(number<&Line::gpu_ns>(line), "%.0f", 1e-3),
      text_of(number<&Line::upload_ns>(line), "%.1f", 1e-3),
      text_of(number<&Line::read_ns>(line), "%.1f", 1e-3),
      text_of(number<&Line::lights_per_sample>(line), "%.2f"),
      text_of(number<&Case::occupancy, &result::Occupancy::lights_per_cell, &result::LightsPerCell::max>(result_case),
              "%.0f"),
      short_count(static_cast<double>(result_case.buffers.bytes.high_water)),
      short_count(static_cast<double>(result_case.buffers.overflow.dropped_pairs)),
      short_count(number<&Line::missed_in_view>(line)),
      line.standing == name_of(PresetStanding::unknown) ? "-" : unlit_text(number<&Line::unlit>(line)),
      assign_text(result_case)};
}

std::string heading(const result::PresetRanking& ranking, const std::vector<Case>& cases) {
  std::string out =
      "\npresets: " + shown(ranking.scene) + "/" + shown(ranking.camera) + ", " + viewport_text(ranking.viewport);
  if (ranking.frames) out += ", " + number_of(*ranking.frames, "frame");
  if (const auto& lights = ranking.lights_in_view)
    out += "; lights in view: " + text_of(number<&result::RankedLights::mean>(*lights), "%.3g") + " on average, " +
           text_of(number<&result::RankedLights::max>(*lights), "%.0f") + " at most";
  const Case* first = case_of(ranking.cases.front().id, cases);
  const std::vector<std::string> sets = first == nullptr ? std::vector<std::string>{} : ranking_set_names(*first);
  return out + (sets.empty() ? "" : "; samples: " + result::words_of_sets(sets)) + "\n";
}

constexpr const char* k_legend =
    "* costs the GPU least, by the key `cost`, of the lists whose samples lack at most 0.1 % of the lights that "
    "they need; presets from\n"
    "memory alone do not count. place: 1 + the number of presets that are clearly cheaper (by over 5 %, also "
    "with each price halved or\n"
    "doubled), so that one that costs more can have the better place. s: samples search the structure, ranked "
    "apart, since no GPU has\n"
    "measured what that costs. -: samples lack more lights, or need fewer than 1000, too few to say so. gpu, "
    "upload, read: us of a\n"
    "frame by the model; lists that a GPU makes are not uploaded, and what it pays to make them is not counted. "
    "lights: that a sample\n"
    "is given, on average. longest: the longest list, before a cap drops any (on a device: after). dropped, missed: "
    "pairs that cells\n"
    "in view lack, seen or "
    "not; unlit: what samples lack decides. assign: us of one core here, of engines that assign on the CPU; gpu: "
    "a time here would not\n"
    "be the engine's; device: it ran on the result's device, whose time is in the block of its grid.\n";

// Names presets whose cases could have run on a device; "" if there are none.
std::string device_hint(const result::Result& result) {
  const result::Json& config = result.config;
  if (config.is_object() && !config.value("device", "").empty()) return "";
  const bool is_as_shipped = config.is_object() && config.value("as_shipped", false);
  std::vector<std::string> names;
  for (const Case& result_case : result.cases) {
    const config::Preset* preset = config::find_preset(result_case.preset.value_or(""));
    if (preset == nullptr || !preset->on_device || runs_on_device(result_case)) continue;
    if (is_as_shipped && preset->has_mistakes()) continue;
    if (std::ranges::find(names, preset->name) == names.end()) names.push_back(preset->name);
  }
  if (names.empty()) return "";
  return "--device NAME (clusterbench list devices) runs and times shaders that work as the engines' do, as far as "
         "`list presets` says: " +
         joined(names) + ".\n";
}

// With what differs on a device, if one of its cases ran there.
std::string approximated_text(const config::Preset& preset, const std::vector<Case>& cases) {
  const bool is_on_device =
      std::ranges::any_of(cases, [&](const Case& one) { return one.preset == preset.name && runs_on_device(one); });
  if (!is_on_device || !preset.on_device || preset.on_device->approximated.empty()) return preset.approximated;
  return preset.approximated + (preset.approximated.empty() ? "" : "; ") +
         "on the device: " + preset.on_device->approximated;
}

}  // namespace

std::vector<result::Preset> preset_facts(const std::vector<Case>& cases, const std::vector<result::Skipped>& skipped) {
  const auto is_of_any = [](const auto& entry) { return entry.preset.has_value(); };
  if (std::ranges::none_of(cases, is_of_any) && std::ranges::none_of(skipped, is_of_any)) return {};
  std::vector<result::Preset> facts;
  for (const config::Preset& preset : config::presets()) {
    const auto is_of = [&](const auto& entry) { return entry.preset == preset.name; };
    if (std::ranges::none_of(cases, is_of) && std::ranges::none_of(skipped, is_of)) continue;
    result::Preset& fact = facts.emplace_back();
    fact.name = preset.name;
    fact.engine = preset.engine;
    fact.version = preset.version;
    fact.evidence = preset.evidence;
    fact.mistakes = preset.mistakes;
    fact.summary = preset.summary;
    fact.source = preset.source;
    fact.approximated = approximated_text(preset, cases);
    fact.unverified = preset.unverified;
    if (const std::uint64_t most = config::most_lights(preset); most > 0) fact.most_lights = most;
    fact.assigns_on = preset.assigns_on;
  }
  return facts;
}

std::vector<result::PresetRanking> preset_rankings(const std::vector<result::Scene>& scenes,
                                                   const std::vector<Case>& cases, const result::Result& origin) {
  std::vector<std::pair<View, std::vector<const Case*>>> views;
  for (const Case& result_case : cases) {
    if (!result_case.preset) continue;
    const View view = view_of(result_case);
    auto found = std::ranges::find_if(views, [&](const auto& other) { return other.first == view; });
    if (found == views.end()) found = views.insert(views.end(), {view, {}});
    found->second.push_back(&result_case);
  }
  std::vector<result::PresetRanking> rankings;
  for (const auto& [view, members] : views)
    for (const result::Scene& scene : scenes)
      if (scene.name == view.scene) rankings.push_back(ranking_of(view, ranked(members, origin.config)));
  return rankings;
}

std::string preset_table(const result::Result& result) {
  if (!result.preset_rankings) return "";
  std::string out;
  for (const result::PresetRanking& ranking : *result.preset_rankings) {
    std::vector<Cells> rows{{"", "preset", "place", "gpu us", "upload", "read", "lights", "longest", "bytes", "dropped",
                             "missed", "unlit", "assign"}};
    std::string reasons;
    for (const result::RankedPreset& line : ranking.cases) {
      const Case* result_case = case_of(line.id, result.cases);
      if (result_case == nullptr) continue;
      rows.push_back(cells_of(line, *result_case, ranking.best == line.id));
      reasons += "  " + shown(line.preset) + " " + shown(line.why) + ".\n";
    }
    const std::vector<std::size_t> widths = widths_of(rows);
    out += heading(ranking, result.cases);
    for (const Cells& row : rows) out += aligned(row, widths);
    out += reasons;
  }
  for (const result::Skipped& skipped : result.skipped)
    if (skipped.preset) out += "  " + shown(*skipped.preset) + " is not measured: " + shown(skipped.reason) + ".\n";
  return out + k_legend + device_hint(result);
}

std::string preset_conclusions(const result::Result& result) {
  if (!result.preset_rankings) return "";
  std::string out;
  for (const result::PresetRanking& ranking : *result.preset_rankings)
    if (ranking.text)
      out += "conclusion: presets for " + shown(ranking.scene) + "/" + shown(ranking.camera) + ": " +
             shown(*ranking.text) + ".\n";
  return out;
}

}  // namespace clusterbench::report
