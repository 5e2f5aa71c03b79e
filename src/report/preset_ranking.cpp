#include "report/preset_ranking.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "config/presets.h"
#include "core/text.h"
#include "report/columns.h"
#include "report/json_values.h"
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

// On visible surfaces if they are asked for, else at points of the whole view.
const Json* samples_of(const Json& result_case) {
  const Json* opaque = value_at(result_case, "/samples/opaque");
  return opaque != nullptr ? opaque : value_at(result_case, "/shading");
}

// Of one sample; `what`: "evaluated" or "needed".
std::optional<double> per_sample(const Json& result_case, const char* what) {
  const Json* samples = samples_of(result_case);
  if (samples == nullptr || (*samples)["samples"] == 0) return std::nullopt;
  return (*samples)[what].get<double>() / (*samples)["samples"].get<double>();
}

std::optional<double> gpu_ns(const Json& result_case, const Json& config) {
  if (const auto modelled = number_at(result_case, "/cost/gpu_ns")) return modelled;
  const std::optional<double> lights = per_sample(result_case, "evaluated");
  if (!lights || !config.contains("cost")) return std::nullopt;
  const double pixels = result_case["viewport"][0].get<double>() * result_case["viewport"][1].get<double>();
  return number_at(result_case, "/buffers/upload_bytes/mean").value_or(0.0) /
             config["cost"]["upload_gb_per_s"].get<double>() +
         pixels * *lights * config["cost"]["ns_per_light"].get<double>();
}

struct Row {
  const Json* result_case;
  bool loses;
  std::optional<double> gpu_ns;
};

// Nothing known comes last.
bool is_better(const Row& a, const Row& b) {
  if (a.loses != b.loses) return b.loses;
  if (a.gpu_ns.has_value() != b.gpu_ns.has_value()) return a.gpu_ns.has_value();
  return a.gpu_ns && *a.gpu_ns < *b.gpu_ns;
}

std::vector<Row> ranked(const std::vector<const Json*>& cases, const Json& config) {
  std::vector<Row> rows;
  for (const Json* result_case : cases)
    rows.push_back({result_case,
                    (*result_case)["loses_lights"].get<bool>() || !result_case->value("/cost/lit"_json_pointer, true),
                    gpu_ns(*result_case, config)});
  std::ranges::stable_sort(rows, is_better);
  return rows;
}

std::string percent(double share) {
  return share < 1e-4 ? "less than 0.01 %" : text(share < 0.1 ? "%.2f %%" : "%.0f %%", 100.0 * share);
}

std::string bytes_text(double bytes) {
  if (bytes < 1e3) return text("%.0f B", bytes);
  return bytes < 1e6 ? text("%.3g kB", bytes / 1e3) : text("%.3g MB", bytes / 1e6);
}

// What a full storage of the preset has too little of.
std::string shortage(const Json& result_case) {
  const config::Preset* preset = config::find_preset(result_case["preset"].get<std::string>());
  if (preset == nullptr) return "";
  const auto parts = nlohmann::json::parse(preset->parts);
  if (parts.contains("storage") && parts["storage"].contains("cap"))
    return ": room for " + number_of(parts["storage"]["cap"].get<std::uint64_t>(), "light") +
           " per cell is too little here";
  return ": its pool of entries is too small here";
}

// The ways in which a case loses lights.
std::string lost_text(const Json& result_case) {
  std::vector<std::string> ways;
  for (const Json& warning : result_case.value("warnings", Json::array()))
    if (warning["kind"] == "too_many_lights") ways.push_back(warning["text"].get<std::string>());
  const Json& overflow = result_case["buffers"]["overflow"];
  if (overflow["dropped_pairs"] != 0)
    ways.push_back("drops " + number_of(overflow["lights"].size(), "light") + " in " +
                   number_of(overflow["frames"].get<std::uint64_t>(), "frame") + shortage(result_case));
  // What was removed before the method got it is no fault of the method's.
  const double not_found = number_at(result_case, "/error/false_negatives").value_or(0.0) -
                           number_at(result_case, "/pre_cull/lost_pairs").value_or(0.0);
  if (not_found > 0.0)
    ways.push_back("loses " + number_of(static_cast<std::uint64_t>(not_found), "pair") + " of " +
                   std::to_string(result_case["error"]["true_pairs"].get<std::uint64_t>()) +
                   ", which its method does not find");
  const Json* samples = samples_of(result_case);
  if (samples != nullptr && (*samples)["missed_outside"] != 0)
    ways.push_back(percent((*samples)["missed_outside"].get<double>() / (*samples)["needed"].get<double>()) +
                   " of the lights that samples need lie beyond its grid");
  return ways.empty() ? "loses lights at samples" : joined(ways, "; ");
}

// Without what it costs beside others.
std::string load_text(const Json& result_case) {
  std::string out;
  if (const auto lights = per_sample(result_case, "evaluated"))
    out = text("%.3g", *lights) + text(" lights per sample (%.3g needed)", *per_sample(result_case, "needed"));
  const auto upload = number_at(result_case, "/buffers/upload_bytes/mean");
  return out + (out.empty() || !upload ? "" : ", ") + (upload ? bytes_text(*upload) + " a frame" : "");
}

// What is too little to be a loss is told.
std::string kept_text(const Json& result_case) {
  const Json* samples = samples_of(result_case);
  if (samples == nullptr || (*samples)["missed"] == 0) return "loses nothing";
  return "loses " + percent((*samples)["missed"].get<double>() / (*samples)["needed"].get<double>()) +
         " of the lights that samples need";
}

std::string why(const Row& row, const Row& best) {
  const Json& result_case = *row.result_case;
  std::string out = row.loses ? lost_text(result_case) : kept_text(result_case);
  if (!row.gpu_ns)
    out += "; its cost is not known without samples of surfaces";
  else if (&row == &best)
    out += row.loses ? "; no preset that was measured does without losses here"
                     : " and costs least: " + load_text(result_case);
  else if (!row.loses && best.gpu_ns && *best.gpu_ns > 0.0)
    out += text(", at %.2f times the cost of ", *row.gpu_ns / *best.gpu_ns) +
           (*best.result_case)["preset"].get<std::string>() + ": " + load_text(result_case);
  return out;
}

Json ranking_of(const View& view, const std::vector<Row>& rows) {
  const bool is_any_best = !rows.front().loses && rows.front().gpu_ns;
  Json list = Json::array();
  for (const Row& row : rows)
    list.push_back({{"id", (*row.result_case)["id"]},
                    {"preset", (*row.result_case)["preset"]},
                    {"gpu_ns", row.gpu_ns ? number_or_null(*row.gpu_ns) : Json()},
                    {"lights_per_sample", number_or_null(per_sample(*row.result_case, "evaluated").value_or(NAN))},
                    {"why", why(row, rows.front())}});
  return {{"scene", view.scene},
          {"camera", view.camera},
          {"viewport", view.viewport},
          {"best", is_any_best ? (*rows.front().result_case)["id"] : Json()},
          {"cases", list}};
}

std::string shown_line(const Json& line, const Json& cases, const Json& best, Cells& cells) {
  const auto found =
      std::ranges::find_if(cases, [&](const Json& result_case) { return result_case["id"] == line["id"]; });
  if (found == cases.end()) return "";
  const std::string set = value_at(*found, "/samples/opaque") != nullptr ? "/samples/opaque" : "/shading";
  cells = {line["id"] == best ? "*" : "",
           line["preset"].get<std::string>(),
           text_at(line, "/gpu_ns", "%.0f", 1e-3),
           text_at(line, "/lights_per_sample", "%.2f"),
           text_at(*found, "/occupancy/lights_per_cell/max", "%.0f"),
           short_count(*found, "/buffers/bytes/high_water"),
           short_count(*found, "/buffers/overflow/dropped_pairs"),
           short_count(*found, "/error/false_negatives"),
           text_at(*found, (set + "/unlit").c_str(), "%.2f %%", 100.0),
           text_at(*found, "/timing/assign_ns/median", "%.1f", 1e-3)};
  return "  " + shown(line["preset"]) + " " + shown(line["why"]) + ".\n";
}

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
    std::vector<Cells> rows{
        {"", "preset", "gpu us", "lights", "longest", "bytes", "dropped", "missed", "unlit", "assign"}};
    std::string reasons;
    for (const Json& line : ranking["cases"]) {
      Cells cells;
      const std::string reason = shown_line(line, result["cases"], ranking["best"], cells);
      if (reason.empty()) continue;
      rows.push_back(cells);
      reasons += reason;
    }
    const std::vector<std::size_t> widths = widths_of(rows);
    out += "\npresets: " + shown(ranking["scene"]) + "/" + shown(ranking["camera"]) + ", " +
           ranking["viewport"][0].dump() + "x" + ranking["viewport"][1].dump() + "\n";
    for (const Cells& row : rows) out += aligned(row, widths);
    out += reasons;
  }
  for (const Json& skipped : result["skipped"])
    if (skipped.contains("preset"))
      out += "  " + shown(skipped["preset"]) + " is not measured: " + shown(skipped["reason"]) + ".\n";
  return out +
         "* the preset that loses nothing and costs the GPU least, by the key `cost` (upload and shading); lights: "
         "given "
         "at a\nsample, on average. assign: us of one core here, whatever the engine runs it on.\n";
}

}  // namespace clusterbench::report
