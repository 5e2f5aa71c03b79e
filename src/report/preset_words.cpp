#include "report/preset_words.h"

#include <algorithm>

#include "config/presets.h"
#include "core/text.h"
#include "measure/shading.h"
#include "report/columns.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string name(const RankedPreset& row) {
  return (*row.result_case)["preset"].get<std::string>();
}

const config::Preset* preset_of(const RankedPreset& row) {
  return config::find_preset(name(row));
}

std::string percent(double share) {
  return share < 1e-4 ? "less than 0.01 %" : text(share < 0.1 ? "%.2f %%" : "%.0f %%", 100.0 * share);
}

std::string bytes_text(double bytes) {
  if (bytes < 1e3) return text("%.0f B", bytes);
  return bytes < 1e6 ? text("%.3g kB", bytes / 1e3) : text("%.3g MB", bytes / 1e6);
}

std::string milliseconds(double ns) {
  return text(ns < 1e4 ? "%.4f ms" : "%.2f ms", ns / 1e6);
}

// What a full storage of the preset has too little of.
std::string shortage(const RankedPreset& row) {
  const config::Preset* preset = preset_of(row);
  if (preset == nullptr) return "";
  const auto parts = nlohmann::json::parse(preset->parts);
  if (parts.contains("storage") && parts["storage"].contains("cap"))
    return " (room for " + number_of(parts["storage"]["cap"].get<std::uint64_t>(), "light") + " per cell)";
  return " (its pool of entries is too small)";
}

// Lights and pairs that are not listed, for each cause; whether samples lack them is told beside.
std::vector<std::string> losses(const RankedPreset& row) {
  const Json& result_case = *row.result_case;
  std::vector<std::string> ways;
  for (const Json& warning : result_case.value("warnings", Json::array()))
    if (warning["kind"] == "too_many_lights") ways.push_back(warning["text"].get<std::string>());
  const Json& overflow = result_case["buffers"]["overflow"];
  if (overflow["dropped_pairs"] != 0)
    ways.push_back("drops " + number_of(overflow["lights"].size(), "light") + " in some cells of " +
                   number_of(overflow["frames"].get<std::uint64_t>(), "frame") + shortage(row));
  if (number_at(result_case, "/error/false_negatives").value_or(0.0) > 0.0)
    ways.push_back("its method does not find " +
                   number_of(result_case["error"]["false_negatives"].get<std::uint64_t>(), "pair") + " of " +
                   std::to_string(result_case["error"]["true_pairs"].get<std::uint64_t>()));
  const Json* samples = ranking_samples(result_case);
  if (samples != nullptr && number_at(*samples, "/missed_outside").value_or(0.0) > 0.0)
    ways.push_back(percent((*samples)["missed_outside"].get<double>() / (*samples)["needed"].get<double>()) +
                   " of the lights that samples need lie beyond its grid");
  return ways;
}

// What is lost, and whether it is seen.
std::string light_text(const RankedPreset& row) {
  const std::vector<std::string> ways = losses(row);
  const std::string causes = ways.empty() ? "" : ": " + joined(ways, "; ");
  if (!row.unlit) return "its samples need too few lights to tell what it loses" + causes;
  if (row.standing == PresetStanding::lacks_lights)
    return "samples lack " + percent(*row.unlit) + " of the lights that they need" + causes;
  if (*row.unlit > 0.0) return "samples lack " + percent(*row.unlit) + " of the lights that they need" + causes;
  return ways.empty() ? "loses nothing" : "loses nothing that a sample needs" + causes;
}

// Without what it costs beside others.
std::string load_text(const RankedPreset& row) {
  const Json& result_case = *row.result_case;
  std::string out;
  if (const auto lights = per_sample(result_case, "evaluated"))
    out = text("%.3g", *lights) + text(" lights per sample (%.3g needed)", *per_sample(result_case, "needed"));
  if (const auto bytes = per_sample(result_case, "read_bytes"); bytes && row.cost && row.cost->read_ns > 0.0)
    out += ", for which it reads " + bytes_text(*bytes);
  const config::Preset* preset = preset_of(row);
  if (preset != nullptr && preset->assigns_on == config::AssignsOn::gpu)
    return out + (out.empty() ? "" : "; ") + "nothing to upload, the GPU makes its lists";
  const auto upload = number_at(result_case, "/buffers/upload_bytes/mean");
  return out + (out.empty() || !upload ? "" : ", ") + (upload ? bytes_text(*upload) + " uploaded a frame" : "");
}

// How sure one can be that the engine does as much.
std::string evidence_text(const RankedPreset& row) {
  const config::Preset* preset = preset_of(row);
  if (preset == nullptr) return "of another version of this program";
  switch (preset->evidence) {
    case config::Evidence::ran:
      return "run beside the engine's code";
    case config::Evidence::read:
      return "read, not run";
    case config::Evidence::memory:
      break;
  }
  return "from memory";
}

std::string names_text(const std::vector<const RankedPreset*>& rows) {
  std::vector<std::string> names;
  for (const RankedPreset* row : rows) names.push_back(name(*row));
  return joined(names);
}

std::vector<const RankedPreset*> of_standing(const std::vector<RankedPreset>& rows, PresetStanding standing) {
  std::vector<const RankedPreset*> out;
  for (const RankedPreset& row : rows)
    if (row.standing == standing) out.push_back(&row);
  return out;
}

// Of presets with one standing, best first: what to take and by how much.
std::string choice_text(const std::vector<const RankedPreset*>& rows) {
  const RankedPreset& first = *rows.front();
  std::vector<const RankedPreset*> alike, others;
  for (const RankedPreset* row : rows) (row->place == 1 ? alike : others).push_back(row);
  std::string out = "take " + name(first);
  if (alike.size() > 1)
    out += " or another of " + names_text(alike) + ", between which there is no difference that this can show (" +
           milliseconds(first.cost->sum_ns()) + " to " + milliseconds(alike.back()->cost->sum_ns()) +
           " of the GPU a frame)";
  else
    out += ", which costs the GPU least: " + milliseconds(first.cost->sum_ns()) + " a frame";
  if (!others.empty())
    out += "; " + name(*others.front()) + ", the next, costs " +
           text("%.2f", others.front()->cost->sum_ns() / first.cost->sum_ns()) + " times as much";
  else if (alike.size() == 1)
    out += "; no other preset that was measured gives samples all lights";
  return out;
}

}  // namespace

const char* name_of(PresetStanding standing) {
  constexpr const char* k_names[] = {"lists", "searched", "lacks_lights", "unknown"};
  return k_names[static_cast<std::size_t>(standing)];
}

const Json* ranking_samples(const Json& result_case) {
  const Json* opaque = value_at(result_case, "/samples/opaque");
  return opaque != nullptr ? opaque : value_at(result_case, "/shading");
}

std::optional<double> per_sample(const Json& result_case, const char* what) {
  const Json* samples = ranking_samples(result_case);
  if (samples == nullptr || (*samples)["samples"] == 0) return std::nullopt;
  const std::optional<double> all = number_at(*samples, std::string("/") + what);
  if (!all) return std::nullopt;
  return *all / (*samples)["samples"].get<double>();
}

std::string preset_reason(const RankedPreset& row, const RankedPreset& first) {
  std::string out = light_text(row);
  if (!row.cost) return out + "; its cost is not known without samples";
  const bool lacks = row.standing == PresetStanding::lacks_lights || row.standing == PresetStanding::unknown;
  if (lacks)
    out += "; not compared by cost, which is that of less light";
  else if (&row == &first)
    out += row.standing == PresetStanding::searched ? "; costs least of those that samples search" : "; costs least";
  else if (row.place == first.place)
    out += "; no difference that this can show to " + name(first);
  else
    out += text("; %.2f times the cost of ", row.cost->sum_ns() / first.cost->sum_ns()) + name(first);
  return out + ": " + load_text(row) + " (" + evidence_text(row) + ")";
}

std::string preset_conclusion(const std::vector<RankedPreset>& rows) {
  const std::vector<const RankedPreset*> lists = of_standing(rows, PresetStanding::lists),
                                         searched = of_standing(rows, PresetStanding::searched),
                                         lacking = of_standing(rows, PresetStanding::lacks_lights);
  std::string out;
  if (!lists.empty())
    out = choice_text(lists);
  else if (!searched.empty())
    out = "of lists none gives samples all lights; of the structures that samples search " + choice_text(searched);
  else if (!lacking.empty())
    return "every preset that was measured leaves samples without lights; least " + name(*lacking.front()) + " (" +
           percent(*lacking.front()->unlit) + " of those that they need)";
  else
    return "which preset suits is not known: no sample needs lights here";
  const RankedPreset& first = lists.empty() ? *searched.front() : *lists.front();
  if (!lists.empty() && !searched.empty())
    out += "; apart, since no GPU has measured what samples search: " + names_text(searched) + ", from " +
           milliseconds(searched.front()->cost->sum_ns()) + " by the model";
  out += ". Sure by as much as the model of `cost` is; " + name(first) + " is " + evidence_text(first);
  if (first.cost->has_random_depths)
    out += "; depths are random, since there are no surfaces: --set samples.opaque.ground=lowest takes a floor";
  return out;
}

}  // namespace clusterbench::report
