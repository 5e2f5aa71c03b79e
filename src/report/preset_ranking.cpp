#include "report/preset_ranking.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "config/presets.h"
#include "core/text.h"
#include "measure/shading.h"
#include "report/columns.h"
#include "report/contender.h"
#include "report/frame_cost.h"
#include "report/json_values.h"
#include "report/nothing_seen.h"
#include "report/preset_losses.h"
#include "report/preset_words.h"
#include "report/result_json.h"
#include "report/sample_sets.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// Cases that see the same.
struct View {
  std::string scene, camera;
  Json viewport;

  friend bool operator==(const View&, const View&) = default;
};

View view_of(const Json& result_case) {
  return {result_case["scene"].get<std::string>(), result_case["camera"].get<std::string>(), result_case["viewport"]};
}

// One threshold for whatever lights are lost by: samples that lack more are not the same picture. Samples that need few
// lights can show that some are lacking, and not that none is.
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

// Behind those of its part that are known to be better.
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

std::vector<RankedPreset> ranked(const std::vector<const Json*>& cases, const Json& config) {
  const std::string unseen = why_nothing_is_seen(cases, RankedBy::samples);
  std::vector<RankedPreset> rows;
  for (const Json* result_case : cases) {
    RankedPreset row{result_case, {},    whole_frame(*result_case, config), preset_losses(*result_case), 0,
                     &config,     unseen};
    row.standing = standing_of(row);
    rows.push_back(row);
  }
  std::ranges::stable_sort(rows, is_better);
  give_places(rows);
  return rows;
}

Json line_json(const RankedPreset& row, const RankedPreset& first) {
  const auto part = [&](double measure::FrameCost::*ns) {
    return row.frame ? number_or_null(row.frame->cost.*ns) : Json();
  };
  return {{"id", (*row.result_case)["id"]},
          {"preset", (*row.result_case)["preset"]},
          {"standing", name_of(row.standing)},
          {"place", row.standing == PresetStanding::unknown ? Json() : Json(row.place)},
          {"gpu_ns", row.frame ? number_or_null(row.gpu_ns()) : Json()},
          {"upload_ns", part(&measure::FrameCost::upload_ns)},
          {"read_ns", part(&measure::FrameCost::read_ns)},
          {"shade_ns", part(&measure::FrameCost::shade_ns)},
          {"lights_per_sample", number_or_null(mean_at_samples(*row.result_case, "evaluated").value_or(NAN))},
          {"unlit", number_or_null(row.losses.unlit.value_or(NAN))},
          {"missed_in_view", row.losses.is_compared ? Json(row.losses.missed()) : Json()},
          {"why", preset_reason(row, first)}};
}

Json ranking_of(const View& view, const std::vector<RankedPreset>& rows) {
  Json list = Json::array(), alike = Json::array();
  const RankedPreset* first = &rows.front();
  for (const RankedPreset& row : rows) {
    if (row.standing != first->standing) first = &row;
    list.push_back(line_json(row, *first));
  }
  for (const RankedPreset* row : taken_presets(rows)) alike.push_back((*row->result_case)["id"]);
  Json out{{"scene", view.scene},
           {"camera", view.camera},
           {"viewport", view.viewport},
           {"frames", (*rows.front().result_case)["frames"]},
           {"best", alike.empty() ? Json() : alike.front()},
           {"alike", alike},
           {"cases", list},
           {"text", preset_conclusion(rows)}};
  if (const Json* lights = value_at(*rows.front().result_case, "/lights_in_view"))
    out["lights_in_view"] = {{"mean", (*lights)["mean"]}, {"max", (*lights)["max"]}};
  return out;
}

// Of older results: none had places.
std::string place_text(const Json& line) {
  if (!line.contains("place")) return "";
  const std::string standing = line["standing"].get<std::string>();
  if (standing == name_of(PresetStanding::lists)) return std::to_string(line["place"].get<int>());
  return standing == name_of(PresetStanding::searched) ? "s" + std::to_string(line["place"].get<int>()) : "-";
}

// Of an engine that assigns on a GPU the time here is none of its own; older results have it.
std::string assign_text(const Json& result_case) {
  const config::Preset* preset = config::find_preset(result_case["preset"].get<std::string>());
  if (preset != nullptr && preset->assigns_on == config::AssignsOn::gpu) return "gpu";
  return text_at(result_case, "/timing/assign_ns/median", "%.1f", 1e-3);
}

std::string shown_line(const Json& line, const Json& cases, const Json& best, Cells& cells) {
  const auto found =
      std::ranges::find_if(cases, [&](const Json& result_case) { return result_case["id"] == line["id"]; });
  if (found == cases.end()) return "";
  cells = {line["id"] == best ? "*" : "",
           line["preset"].get<std::string>(),
           place_text(line),
           text_at(line, "/gpu_ns", "%.0f", 1e-3),
           text_at(line, "/upload_ns", "%.1f", 1e-3),
           text_at(line, "/read_ns", "%.1f", 1e-3),
           text_at(line, "/lights_per_sample", "%.2f"),
           text_at(*found, "/occupancy/lights_per_cell/max", "%.0f"),
           short_count(*found, "/buffers/bytes/high_water"),
           short_count(*found, "/buffers/overflow/dropped_pairs"),
           short_count(line, "/missed_in_view"),
           line.value("standing", "") == name_of(PresetStanding::unknown) ? "-" : unlit_text(number_at(line, "/unlit")),
           assign_text(*found)};
  return "  " + shown(line["preset"]) + " " + shown(line["why"]) + ".\n";
}

std::string heading(const Json& ranking, const Json& cases) {
  std::string out =
      "\npresets: " + shown(ranking["scene"]) + "/" + shown(ranking["camera"]) + ", " + viewport_text(ranking);
  if (ranking.contains("frames")) out += ", " + number_of(ranking["frames"].get<std::uint64_t>(), "frame");
  if (ranking.contains("lights_in_view"))
    out += "; lights in view: " + text_at(ranking, "/lights_in_view/mean", "%.3g") + " on average, " +
           text_at(ranking, "/lights_in_view/max", "%.0f") + " at most";
  const Json& first = ranking["cases"].front()["id"];
  const auto found = std::ranges::find_if(cases, [&](const Json& result_case) { return result_case["id"] == first; });
  const std::vector<std::string> sets = found == cases.end() ? std::vector<std::string>{} : ranking_set_names(*found);
  return out + (sets.empty() ? "" : "; samples: " + words_of_sets(sets)) + "\n";
}

constexpr const char* k_legend =
    "* costs the GPU least, by the key `cost`, of the lists whose samples lack at most 0.1 % of the lights that they "
    "need; presets\nfrom memory alone do not count. place: 1 + the number of presets "
    "that "
    "are clearly cheaper (by\nover 5 %, also with each price halved or doubled), so that one that costs more can have "
    "the "
    "better place. s: samples search the\nstructure, ranked apart, since no GPU has measured what that costs. -: "
    "samples "
    "lack more lights, or need fewer than 1000, too few\nto say so. gpu, upload, read: us of a frame by the model; "
    "lists "
    "that a GPU makes are not uploaded, and what it pays to make them\nis not counted. lights: that a sample is given, "
    "on "
    "average. dropped, missed: pairs that cells in view lack, seen or not; unlit:\nwhat samples lack decides. assign: "
    "us "
    "of one core here, of engines that assign on the CPU; gpu: a time here would not be the\nengine's.\n";

}  // namespace

Json preset_facts(const Json& cases, const Json& skipped) {
  Json facts = Json::array();
  for (const config::Preset& preset : config::presets()) {
    const auto is_of = [&](const Json& entry) { return entry.value("preset", "") == preset.name; };
    if (std::ranges::none_of(cases, is_of) && std::ranges::none_of(skipped, is_of)) continue;
    facts.push_back({{"name", preset.name},
                     {"engine", preset.engine},
                     {"version", preset.version},
                     {"evidence", config::name_of(preset.evidence)},
                     {"summary", preset.summary},
                     {"source", preset.source},
                     {"approximated", preset.approximated},
                     {"unverified", preset.unverified},
                     {"assigns_on", config::name_of(preset.assigns_on)}});
    if (const std::uint64_t most = config::most_lights(preset); most > 0) facts.back()["most_lights"] = most;
    if (preset.has_mistakes()) facts.back()["mistakes"] = preset.mistakes;
  }
  return facts;
}

Json preset_rankings(const Json& scenes, const Json& cases, const Json& origin) {
  std::vector<std::pair<View, std::vector<const Json*>>> views;
  for (const Json& result_case : cases) {
    if (!result_case.contains("preset")) continue;
    const View view = view_of(result_case);
    auto found = std::ranges::find_if(views, [&](const auto& other) { return other.first == view; });
    if (found == views.end()) found = views.insert(views.end(), {view, {}});
    found->second.push_back(&result_case);
  }
  Json rankings = Json::array();
  for (const auto& [view, members] : views)
    for (const Json& scene : scenes)
      if (scene["name"] == view.scene) rankings.push_back(ranking_of(view, ranked(members, origin.at("config"))));
  return rankings;
}

std::string preset_table(const Json& result) {
  if (!result.contains("preset_rankings")) return "";
  std::string out;
  for (const Json& ranking : result["preset_rankings"]) {
    std::vector<Cells> rows{{"", "preset", "place", "gpu us", "upload", "read", "lights", "longest", "bytes", "dropped",
                             "missed", "unlit", "assign"}};
    std::string reasons;
    for (const Json& line : ranking["cases"]) {
      Cells cells;
      const std::string reason = shown_line(line, result["cases"], ranking["best"], cells);
      if (reason.empty()) continue;
      rows.push_back(cells);
      reasons += reason;
    }
    const std::vector<std::size_t> widths = widths_of(rows);
    out += heading(ranking, result["cases"]);
    for (const Cells& row : rows) out += aligned(row, widths);
    out += reasons;
  }
  for (const Json& skipped : result["skipped"])
    if (skipped.contains("preset"))
      out += "  " + shown(skipped["preset"]) + " is not measured: " + shown(skipped["reason"]) + ".\n";
  return out + k_legend;
}

std::string preset_conclusions(const Json& result) {
  std::string out;
  for (const Json& ranking : result.value("preset_rankings", Json::array()))
    if (ranking.contains("text"))
      out += "conclusion: presets for " + shown(ranking["scene"]) + "/" + shown(ranking["camera"]) + ": " +
             shown(ranking["text"]) + ".\n";
  return out;
}

}  // namespace clusterbench::report
