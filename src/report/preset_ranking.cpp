#include "report/preset_ranking.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "config/presets.h"
#include "core/text.h"
#include "measure/shading.h"
#include "report/columns.h"
#include "report/json_values.h"
#include "report/preset_cost.h"
#include "report/preset_losses.h"
#include "report/preset_words.h"
#include "report/result_json.h"

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
  if (!row.losses.unlit || !row.cost) return PresetStanding::unknown;
  if (*row.losses.unlit > measure::k_most_unlit) return PresetStanding::lacks_lights;
  if (!row.losses.is_decided()) return PresetStanding::unknown;
  return row.cost->is_searched ? PresetStanding::searched : PresetStanding::lists;
}

bool is_better(const RankedPreset& a, const RankedPreset& b) {
  if (a.standing != b.standing) return a.standing < b.standing;
  if (a.standing == PresetStanding::unknown) return false;
  if (a.standing == PresetStanding::lacks_lights) return *a.losses.unlit < *b.losses.unlit;
  return a.cost->sum_ns() < b.cost->sum_ns();
}

// In the order of costs: a row that cannot be told apart from the first one of a place shares that place.
void give_places(std::vector<RankedPreset>& rows) {
  std::size_t part = 0, leader = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].standing != rows[part].standing) part = leader = i;
    const bool is_priced = rows[i].standing == PresetStanding::lists || rows[i].standing == PresetStanding::searched;
    if (!is_priced || !are_alike(*rows[leader].cost, *rows[i].cost)) leader = i;
    rows[i].place = static_cast<int>(leader - part) + 1;
  }
}

std::vector<RankedPreset> ranked(const std::vector<const Json*>& cases, const Json& config) {
  std::vector<RankedPreset> rows;
  for (const Json* result_case : cases) {
    RankedPreset row{result_case, {}, preset_cost(*result_case, config), preset_losses(*result_case), 0, &config};
    row.standing = standing_of(row);
    rows.push_back(row);
  }
  std::ranges::stable_sort(rows, is_better);
  give_places(rows);
  return rows;
}

Json line_json(const RankedPreset& row, const RankedPreset& first) {
  const auto part = [&](double PresetCost::*ns) { return row.cost ? number_or_null((*row.cost).*ns) : Json(); };
  return {{"id", (*row.result_case)["id"]},
          {"preset", (*row.result_case)["preset"]},
          {"standing", name_of(row.standing)},
          {"place", row.place},
          {"gpu_ns", row.cost ? number_or_null(row.cost->sum_ns()) : Json()},
          {"upload_ns", part(&PresetCost::upload_ns)},
          {"read_ns", part(&PresetCost::read_ns)},
          {"shade_ns", part(&PresetCost::shade_ns)},
          {"lights_per_sample", number_or_null(per_sample(*row.result_case, "evaluated").value_or(NAN))},
          {"why", preset_reason(row, first)}};
}

Json ranking_of(const View& view, const std::vector<RankedPreset>& rows) {
  Json list = Json::array(), alike = Json::array();
  const RankedPreset* first = &rows.front();
  for (const RankedPreset& row : rows) {
    if (row.standing != first->standing) first = &row;
    list.push_back(line_json(row, *first));
    if (row.standing == PresetStanding::lists && row.place == 1) alike.push_back((*row.result_case)["id"]);
  }
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

// Without pairs of lights beside the view, which the engine leaves out and nothing sees.
std::string missed_pairs_text(const Json& result_case) {
  const PresetLosses losses = preset_losses(result_case);
  return losses.is_compared ? short_count({{"missed", losses.missed()}}, "/missed") : "-";
}

std::string shown_line(const Json& line, const Json& cases, const Json& best, Cells& cells) {
  const auto found =
      std::ranges::find_if(cases, [&](const Json& result_case) { return result_case["id"] == line["id"]; });
  if (found == cases.end()) return "";
  const std::string set = value_at(*found, "/samples/opaque") != nullptr ? "/samples/opaque" : "/shading";
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
           missed_pairs_text(*found),
           line.value("standing", "") == name_of(PresetStanding::unknown)
               ? "-"
               : text_at(*found, (set + "/unlit").c_str(), "%.2f %%", 100.0),
           assign_text(*found)};
  return "  " + shown(line["preset"]) + " " + shown(line["why"]) + ".\n";
}

std::string heading(const Json& ranking) {
  std::string out = "\npresets: " + shown(ranking["scene"]) + "/" + shown(ranking["camera"]) + ", " +
                    ranking["viewport"][0].dump() + "x" + ranking["viewport"][1].dump();
  if (ranking.contains("frames")) out += ", " + number_of(ranking["frames"].get<std::uint64_t>(), "frame");
  if (ranking.contains("lights_in_view"))
    out += "; lights in view: " + text_at(ranking, "/lights_in_view/mean", "%.3g") + " on average, " +
           text_at(ranking, "/lights_in_view/max", "%.0f") + " at most";
  return out + "\n";
}

constexpr const char* k_legend =
    "* costs the GPU least of the lists that leave no sample without lights, by the key `cost`: upload, reading and "
    "shading.\nplace: the same where the model cannot tell: within 5 %, or the order turns as prices are half or "
    "twice those of `cost`;\ns: samples search the structure, ranked apart, since no GPU has measured what that "
    "costs;\n-: samples lack lights, or need fewer than 1000, too few to say that none of those that are lost is "
    "seen.\ngpu, upload, read: us of a frame by the model. Lists that a GPU makes are not "
    "uploaded. lights: looped over at a sample, on\naverage. dropped, missed: pairs that cells in view lack, seen or "
    "not; "
    "unlit: what samples lack decides. assign: us of one core here,\nof engines that assign on the CPU; gpu: a time "
    "here would not be the engine's.\n";

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
    out += heading(ranking);
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
