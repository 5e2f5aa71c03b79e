#include "report/history/history.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <thread>
#include <tuple>

#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "os/locked_file.h"
#include "os/output_file.h"
#include "report/cases/scene_lights.h"
#include "report/documents/machine_name.h"
#include "report/gates/light_gate.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using result::Basis;
using result::Better;
using result::Figure;

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int k_history_version = 1;

// A run has one counter.
std::string counter_of(const result::Result& result) {
  for (const result::Case& result_case : result.cases)
    if (result_case.count) return result_case.count->source;
  return "";
}

bool has_cold_times(const result::Result& result) {
  return std::ranges::any_of(result.cases, [](const result::Case& result_case) {
    return (result_case.timing && result_case.timing->caches == "cold") ||
           (result_case.device && result_case.device->caches == "cold");
  });
}

// Of the device's times, with its driver. Several only in a merged result.
std::string devices_of(const result::Result& result) {
  std::set<std::string> names;
  for (const result::Case& result_case : result.cases)
    if (result_case.device) names.insert(result_case.device->device);
  return joined(std::vector<std::string>(names.begin(), names.end()));
}

Json history_line(const result::Result& result, const std::string& commit) {
  Json line{{"history_version", k_history_version},
            {"commit", commit},
            {"name", result.name},
            {"cpu", machine_name(result.machine)},
            {"simd_target", result.tool.simd_target}};
  if (const std::string counter = counter_of(result); !counter.empty()) line["counter"] = counter;
  if (has_cold_times(result)) line["caches"] = "cold";
  if (const std::string device = devices_of(result); !device.empty()) line["device"] = device;
  line["scenes"] = Json::array();
  for (const result::Scene& scene : result.scenes) {
    Json stored{{"name", scene.name}, {"lights", lights_text(scene)}};
    if (scene.light_digest) stored["light_digest"] = *scene.light_digest;
    line["scenes"].push_back(std::move(stored));
  }
  line["cases"] = Json::array();
  for (const result::Case& result_case : result.cases) {
    Json figures = Json::object();
    for (const Measured& figure : measured(result_case, true))
      if (is_kept(*figure.figure)) figures[std::string(figure.figure->exported_as())] = figure.value;
    line["cases"].push_back({{"id", result_case.id},
                             {"settings", result_case.settings.value_or("")},
                             {"name", result_case.name},
                             {"scene", result_case.scene},
                             {"figures", figures}});
    if (!result_case.camera_path) continue;
    line["cases"].back()["camera"] = result_case.camera;
    line["cases"].back()["camera_path"] = result::to_json(*result_case.camera_path);
  }
  return line;
}

[[noreturn]] void refuse_value(const std::string& pointer, const std::string& found, const std::string& allowed) {
  throw Error("", pointer, "found " + found + ", allowed: " + allowed);
}

const Json& checked(const Json& value, const std::string& pointer, bool is_allowed, const std::string& allowed) {
  if (is_allowed) return value;
  const bool is_short = value.is_primitive();
  refuse_value(pointer, is_short ? value.dump() : value.is_array() ? "a list" : "an object", allowed);
}

const Json& member(const Json& object, const std::string& pointer, const std::string& key) {
  if (const auto found = object.find(key); found != object.end()) return *found;
  refuse_value(pointer, "no key '" + key + "'", "a line that `clusterbench history add` wrote");
}

const Json& list_in(const Json& object, const std::string& pointer, const std::string& key) {
  const Json& list = member(object, pointer, key);
  return checked(list, pointer + "/" + key, list.is_array(), "a list");
}

std::string text_in(const Json& object, const std::string& pointer, const std::string& key) {
  const Json& text = member(object, pointer, key);
  return checked(text, pointer + "/" + key, text.is_string(), "a text").get<std::string>();
}

// Lines of older versions may not have the key.
std::string text_or_none(const Json& object, const std::string& pointer, const std::string& key) {
  return object.contains(key) ? text_in(object, pointer, key) : "";
}

HistoryEntry::Case parsed_case(const Json& stored, const std::string& at) {
  checked(stored, at, stored.is_object(), "an object");
  HistoryEntry::Case out{text_or_none(stored, at, "settings"),
                         run::current_name(text_in(stored, at, "name")),
                         {},
                         text_or_none(stored, at, "scene")};
  const Json& figures = member(stored, at, "figures");
  checked(figures, at + "/figures", figures.is_object(), "an object");
  for (const auto& [name, value] : figures.items())
    out.figures.emplace_back(name,
                             checked(value, at + "/figures/" + name, value.is_number(), "a number").get<double>());
  if (stored.contains("camera_path")) {
    const Json& path = stored["camera_path"];
    const std::string in_path = at + "/camera_path";
    checked(path, in_path, path.is_object(), "an object");
    const auto seconds = [&](const char* key) {
      const Json& value = member(path, in_path, key);
      return checked(value, in_path + "/" + key, value.is_number(), "a number").get<double>();
    };
    out.path = {text_in(stored, at, "camera"), text_or_none(path, in_path, "digest"), seconds("from_s"),
                seconds("to_s")};
  }
  return out;
}

HistoryLights parsed_scene(const Json& stored, const std::string& at) {
  checked(stored, at, stored.is_object(), "an object");
  return {text_in(stored, at, "name"), text_or_none(stored, at, "light_digest"), text_in(stored, at, "lights")};
}

HistoryEntry parsed(const std::string& line) {
  const Json json = read_json<Json>(line, "");
  checked(json, "", json.is_object(), "an object");
  const Json& version = member(json, "", "history_version");
  if (version != k_history_version)
    throw Error("", "", "history_version is " + version.dump() + "; this version reads 1");
  HistoryEntry entry{text_in(json, "", "commit"),
                     text_in(json, "", "cpu") + ", " + text_in(json, "", "simd_target"),
                     text_or_none(json, "", "counter"),
                     text_or_none(json, "", "caches"),
                     {}};
  std::size_t number = 0;
  for (const Json& stored : list_in(json, "", "cases"))
    entry.cases.push_back(parsed_case(stored, "/cases/" + std::to_string(number++)));
  number = 0;
  if (json.contains("scenes"))
    for (const Json& stored : list_in(json, "", "scenes"))
      entry.scenes.push_back(parsed_scene(stored, "/scenes/" + std::to_string(number++)));
  entry.device = text_or_none(json, "", "device");
  return entry;
}

HistoryEntry parsed_at(const std::string& path, const std::string& line, std::size_t number) {
  try {
    return parsed(line);
  } catch (const Error& error) {
    const std::string within = error.where().empty() ? "" : ": " + error.where();
    throw Error(path, "line " + std::to_string(number) + within, error.message());
  }
}

// Editors leave blank lines, most often the last one.
bool is_blank_line(std::string_view line) {
  return line.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

std::vector<HistoryEntry> parsed_file(const std::string& path, const std::string& text) {
  std::vector<HistoryEntry> history;
  for (std::size_t begin = 0, number = 1; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    if (end == std::string::npos)
      throw Error(path, "line " + std::to_string(number), "has no end; was its writing interrupted?");
    if (!is_blank_line(line)) history.push_back(parsed_at(path, line, number));
    begin = end + 1;
  }
  return history;
}

// Rejects a pipe or a device: later results could not be added to it.
fs::path history_path(const std::string& path) {
  const os::OutputTarget target = os::output_target(path);
  if (target.is_stream) throw Error(path, "", "is no regular file; a history is one");
  return target.path;
}

// Others hold it for a moment, or are stopped and hold it without end.
std::unique_ptr<os::LockedFile> locked_history(const std::string& path, const HistoryWait& wait) {
  constexpr std::chrono::milliseconds k_pause(20);
  const auto start = std::chrono::steady_clock::now();
  for (bool is_told = false;;) {
    try {
      return std::make_unique<os::LockedFile>(history_path(path));
    } catch (const os::FileHeld&) {
      if (std::chrono::steady_clock::now() - start >= wait.longest)
        throw Error(path, "",
                    "is held by another process, still after " +
                        number_of(static_cast<std::uint64_t>(wait.longest.count()), "second") +
                        "; end that process (`fuser FILE` shows it), then add the result again");
    }
    if (!is_told && wait.on_long && std::chrono::steady_clock::now() - start >= wait.until_long) {
      wait.on_long();
      is_told = true;
    }
    std::this_thread::sleep_for(k_pause);
  }
}

const Figure* exported_figure(const std::string& name) {
  for (const Figure* figure : export_figures())
    if (figure->exported_as() == name) return figure;
  return nullptr;
}

// Figures of one origin form a series: times need the same machine, instructions the same counter.
std::string origin(const HistoryEntry& entry, const Figure& figure) {
  switch (figure.basis) {
    case Basis::time:
      return (figure.is_of_device ? entry.device : entry.machine) +
             (entry.caches.empty() ? "" : ", " + entry.caches + " caches");
    case Basis::instructions:
      return entry.machine + (entry.counter.empty() ? "" : ", " + entry.counter);
    case Basis::count:
    case Basis::derived:
      break;
  }
  return "";
}

// Noise of counts: hardware counters include interrupts; even valgrind's counts depend slightly on addresses.
double counting_noise(const Series& series) {
  if (series.figure->basis != Basis::instructions) return 0.0;
  return series.machine.ends_with(", callgrind") ? 0.001 : 0.01;
}

std::vector<measure::ChangePoint> changes_of(const Series& series, const measure::ChangeRule& rule) {
  if (series.figure->basis == Basis::time) return measure::change_points(series.values, rule);
  return measure::counted_changes(series.values, std::max(rule.min_change, counting_noise(series)));
}

const HistoryLights* lights_of_scene(const HistoryEntry& entry, const std::string& scene) {
  const auto found = std::ranges::find(entry.scenes, scene, &HistoryLights::scene);
  return found == entry.scenes.end() ? nullptr : &*found;
}

bool are_other_lights(const HistoryLights& before, const HistoryLights& now) {
  return before.digest.empty() || now.digest.empty() ? before.counts != now.counts : before.digest != now.digest;
}

// "the lights of level have changed: 300 points, now 250 points"
std::string changed_lights_text(const HistoryLights& before, const HistoryLights& now) {
  return "the lights of " + now.scene + " have changed: " +
         (before.counts == now.counts ? "still " + now.counts + ", some of them moved or changed"
                                      : before.counts + ", now " + now.counts);
}

bool has_one_of(const HistoryEntry& entry, const std::vector<HistoryLights>& scenes) {
  return std::ranges::any_of(
      scenes, [&](const HistoryLights& scene) { return lights_of_scene(entry, scene.scene) != nullptr; });
}

// Scenes that a result of another commit has beside those of `entry`, and no result of this commit has: a missing scene
// cannot become worse. A job that adds one result per level has one scene in each, and misses none.
std::vector<std::string> missing_scenes(std::span<const HistoryEntry> before, std::span<const HistoryEntry> all,
                                        const HistoryEntry& entry) {
  const auto is_earlier = [&](const HistoryEntry& other) {
    return other.commit != entry.commit && has_one_of(other, entry.scenes);
  };
  const auto last = std::ranges::find_if(before.rbegin(), before.rend(), is_earlier);
  if (last == before.rend()) return {};
  std::vector<std::string> lines;
  for (const HistoryLights& then : last->scenes) {
    const auto has_it = [&](const HistoryEntry& other) {
      return other.commit == entry.commit && lights_of_scene(other, then.scene) != nullptr;
    };
    if (lights_of_scene(entry, then.scene) == nullptr && std::ranges::none_of(all, has_it))
      lines.push_back(then.scene + " is missing, which " + last->commit + " has (" + then.counts + ")");
  }
  return lines;
}

// Changes of lights by `entry`, compared with the last results of each of its scenes before it.
std::vector<std::string> changed_lights(std::span<const HistoryEntry> before, const HistoryEntry& entry) {
  std::vector<std::string> lines;
  for (const HistoryLights& now : entry.scenes)
    for (auto earlier = before.rbegin(); earlier != before.rend(); ++earlier) {
      const HistoryLights* then = lights_of_scene(*earlier, now.scene);
      if (then == nullptr) continue;
      if (are_other_lights(*then, now)) lines.push_back(changed_lights_text(*then, now));
      break;
    }
  return lines;
}

const HistoryPath* path_in(const HistoryEntry& entry, const std::string& scene, const std::string& camera) {
  const auto found = std::ranges::find_if(entry.cases, [&](const HistoryEntry::Case& other) {
    return other.scene == scene && other.path.camera == camera && !other.path.digest.empty();
  });
  return found == entry.cases.end() ? nullptr : &found->path;
}

// Changes of paths by `entry`, compared with the last results of each of its cameras before it.
std::vector<std::string> changed_paths(std::span<const HistoryEntry> before, const HistoryEntry& entry) {
  std::vector<std::string> lines;
  for (const HistoryEntry::Case& now : entry.cases) {
    if (now.path.digest.empty()) continue;
    const HistoryPath* then = nullptr;
    for (auto earlier = before.rbegin(); earlier != before.rend() && then == nullptr; ++earlier)
      then = path_in(*earlier, now.scene, now.path.camera);
    if (then == nullptr || then->digest == now.path.digest) continue;
    const std::string line =
        path_change_text(now.scene, now.path.camera, {then->from_s, then->to_s}, {now.path.from_s, now.path.to_s});
    if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
  }
  return lines;
}

// Whether the results around a change have the same lights or camera path, if known. For counts these are the two
// results beside it; for times, whose changes are detected from many results, all up to the neighbouring changes.
enum class Around { same, others, unknown };
Around digests_around(const Series& series, const std::vector<std::string>& all, const measure::ChangePoint& change) {
  const bool is_counted = change.p == 0.0;
  std::size_t begin = is_counted ? change.index - 1 : 0, end = is_counted ? change.index + 1 : all.size();
  for (const measure::ChangePoint& other : series.changes) {
    if (other.index < change.index) begin = std::max(begin, other.index);
    if (other.index > change.index) end = std::min(end, other.index);
  }
  const std::set<std::string> digests(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                      all.begin() + static_cast<std::ptrdiff_t>(end));
  if (digests.size() <= 1) return Around::same;  // or all are unknown: lines of an older version
  return digests.contains("") ? Around::unknown : Around::others;
}

// "all 140,258", "140,258 to 151,000"; for counts also the range of the values in between.
std::string values_text(const Series& series) {
  const std::vector<double>& values = series.values;
  const bool is_steady = std::ranges::all_of(values, [&](double value) { return value == values.front(); });
  if (is_steady) return (values.size() > 1 ? "all " : "") + figure_text(values.front());
  const auto [least, most] = std::ranges::minmax_element(values);
  const auto is_end = [&](double value) { return value == values.front() || value == values.back(); };
  return figure_text(values.front()) + " to " + figure_text(values.back()) +
         (series.figure->basis == Basis::time || (is_end(*least) && is_end(*most))
              ? ""
              : ", between " + figure_text(*least) + " and " + figure_text(*most));
}

std::string series_text(const Series& series) {
  std::string text =
      series.case_name + "  " + std::string(series.figure->exported_as()) + " (" + std::string(series.figure->unit) +
      ")" + (series.machine.empty() ? "" : "  on " + series.machine) + "\n" +
      (series.settings_since.empty()
           ? ""
           : "  other settings than before, from " + series.settings_since + " on: a series of its own\n") +
      "  " + number_of(series.values.size(), "value") + ", " + values_text(series) + "\n";
  for (const measure::ChangePoint& change : series.changes) {
    char p[48];
    std::snprintf(p, sizeof p, " (p %.1g)", change.p);
    const std::string way = direction_text(series, change);
    text += "  at " + series.commits[change.index] + ": " + figure_text(change.before) + " to " +
            figure_text(change.after) + ", " + change_text(change) + (way.empty() ? "" : ", " + way) +
            (change.p > 0.0 ? p : "") + "\n";
  }
  return text;
}

// " of 0.5 % or more"
std::string least_text(const measure::ChangeRule& rule) {
  char text[48];
  std::snprintf(text, sizeof text, " of %.3g %% or more", 100.0 * rule.min_change);
  return rule.min_change > 0.0 ? text : "";
}

}  // namespace

bool is_kept(const Figure& figure) {
  return figure.is_exported() && figure.basis != Basis::derived && (figure.is_headline || figure.is_kept);
}

std::vector<HistoryEntry> read_history(const std::string& path) {
  return parsed_file(path, file_text(history_path(path)));
}

Addition add_to_history(const std::string& path, const result::Result& result, const std::string& commit,
                        const HistoryWait& wait) {
  os::require_folder_of(path);
  const std::unique_ptr<os::LockedFile> locked = locked_history(path, wait);
  os::LockedFile& file = *locked;
  std::string text = file.text();
  const std::vector<HistoryEntry> history = parsed_file(path, text);
  const std::string line = history_line(result, commit).dump() + "\n";
  Addition addition;
  addition.other_names = file.other_names();
  std::size_t begin = 0, insert_at = text.size();
  const HistoryEntry fresh = parsed(line);
  std::vector<HistoryEntry> others;
  std::ranges::copy_if(history, std::back_inserter(others),
                       [&](const HistoryEntry& entry) { return entry.commit != commit; });
  addition.path_changes = changed_paths(others, fresh);
  addition.light_changes = missing_scenes(others, history, fresh);
  std::ranges::copy(changed_lights(others, fresh), std::back_inserter(addition.light_changes));
  for (const HistoryLights& scene : fresh.scenes)
    if (!others.empty() && std::ranges::none_of(others, [&](const HistoryEntry& entry) {
          return lights_of_scene(entry, scene.scene) != nullptr;
        }))
      addition.new_scenes.push_back(scene.scene);
  for (const HistoryEntry& entry : history) {  // one line each, between blank ones
    std::size_t end = text.find('\n', begin) + 1;
    while (is_blank_line(std::string_view(text).substr(begin, end - begin))) {
      begin = end;
      end = text.find('\n', begin) + 1;
    }
    if (entry.commit == commit) {
      ++addition.earlier;
      if (text.compare(begin, end - begin, line) == 0) addition.is_added = false;
      insert_at = end;
    }
    begin = end;
  }
  if (!addition.is_added) return addition;
  file.replace(text.insert(insert_at, line));
  return addition;
}

std::vector<Series> series_of(const std::vector<HistoryEntry>& history, const measure::ChangeRule& rule) {
  std::vector<Series> all;
  std::map<std::tuple<std::string, std::ptrdiff_t, const Figure*, std::string>, std::size_t> index_of;
  std::map<std::string, std::vector<std::string>> settings_of;  // by name, in the order of appearance
  for (const HistoryEntry& entry : history)
    for (const HistoryEntry::Case& history_case : entry.cases) {
      // Lines without settings are assumed to have those of their neighbours.
      std::vector<std::string>& known = settings_of[history_case.name];
      if (!known.empty() && known.back().empty())
        known.back() = history_case.settings;
      else if (known.empty() ||
               (!history_case.settings.empty() && std::ranges::find(known, history_case.settings) == known.end()))
        known.push_back(history_case.settings);
      const auto at = history_case.settings.empty() ? known.end() - 1 : std::ranges::find(known, history_case.settings);
      const auto version = at - known.begin();
      for (const auto& [name, value] : history_case.figures) {
        const Figure* figure = exported_figure(name);
        if (figure == nullptr || figure->basis == Basis::derived) continue;  // in lines of an older version
        const std::string from = origin(entry, *figure);
        const auto [found, is_new] = index_of.try_emplace({history_case.name, version, figure, from}, all.size());
        if (is_new)
          all.push_back({history_case.name,
                         *at,
                         version > 0 ? entry.commit : std::string(),
                         from,
                         figure,
                         {},
                         {},
                         {},
                         {},
                         false,
                         {}});
        const HistoryLights* lights = lights_of_scene(entry, history_case.scene);
        all[found->second].lights.push_back(lights == nullptr ? "" : lights->digest);
        all[found->second].paths.push_back(history_case.path.digest);
        all[found->second].commits.push_back(entry.commit);
        all[found->second].values.push_back(value);
      }
    }
  for (Series& series : all) {
    series.is_too_short =
        series.figure->basis == Basis::time && series.values.size() < measure::least_values(rule.max_p);
    series.changes = changes_of(series, rule);
  }
  return all;
}

std::vector<std::string> light_changes_in(const std::vector<HistoryEntry>& history) {
  std::vector<std::string> lines;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const std::span before = std::span(history).first(i);
    const std::string at = "at " + history[i].commit + ": ";
    for (const std::string& missing : missing_scenes(before, history, history[i])) lines.push_back(at + missing);
    for (const std::string& change : changed_lights(before, history[i]))
      lines.push_back(at + change + "; figures from there on are of other lights");
  }
  return lines;
}

std::vector<std::string> path_changes_in(const std::vector<HistoryEntry>& history) {
  std::vector<std::string> lines;
  for (std::size_t i = 1; i < history.size(); ++i)
    for (const std::string& change : changed_paths(std::span(history).first(i), history[i]))
      lines.push_back("at " + history[i].commit + ": " + change + "; figures from there on are of other views");
  return lines;
}

std::string direction(const Series& series, const measure::ChangePoint& change) {
  const Figure& figure = *series.figure;
  if (figure.better == Better::neither || digests_around(series, series.lights, change) != Around::same ||
      digests_around(series, series.paths, change) != Around::same)
    return "";
  return (change.after < change.before) == (figure.better == Better::smaller) ? "better" : "worse";
}

std::string direction_text(const Series& series, const measure::ChangePoint& change) {
  if (series.figure->better == Better::neither) return "";
  const Around lights = digests_around(series, series.lights, change),
               paths = digests_around(series, series.paths, change);
  if (lights == Around::others) return "of other lights";
  if (paths == Around::others) return "of another camera path";
  if (lights == Around::unknown) return "perhaps of other lights, which older lines do not tell";
  if (paths == Around::unknown) return "perhaps of another camera path, which older lines do not tell";
  return direction(series, change);
}

std::string change_text(const measure::ChangePoint& change) {
  if (change.before == 0.0) return "from 0";
  char text[48];
  std::snprintf(text, sizeof text, "%+.3g %%", 100.0 * (change.after / change.before - 1.0));
  return text;
}

std::string history_text(const std::vector<Series>& series, std::size_t entries, bool all,
                         const measure::ChangeRule& rule, const std::vector<std::string>& light_changes) {
  std::string text;
  for (const std::string& change : light_changes) text += change + "\n";
  std::size_t changes = 0, too_short = 0;
  for (const Series& case_series : series) {
    changes += case_series.changes.size();
    too_short += case_series.is_too_short ? 1 : 0;
    if (all || !case_series.changes.empty()) text += series_text(case_series);
  }
  std::set<std::pair<std::string, std::string>> renewed;
  for (const Series& case_series : series)
    if (!case_series.settings_since.empty())
      renewed.insert({case_series.settings, case_series.case_name + " from " + case_series.settings_since + " on"});
  for (const auto& [settings, what] : renewed)
    text += "warning: other settings (" + settings + "), not joined with what was before: " + what + "\n";
  text +=
      number_of(entries, "result") + ", " + std::to_string(series.size()) + " series, " + number_of(changes, "change") +
      least_text(rule) +
      (light_changes.empty() ? "" : ", " + number_of(light_changes.size(), "change") + " of levels or their lights") +
      "\n";
  return too_short == 0
             ? text
             : text + std::to_string(too_short) + " series of times are too short to tell changes from noise\n";
}

std::string figure_text(double value) {
  char text[48];
  std::snprintf(text, sizeof text, std::abs(value) < 1e5 ? "%.5g" : "%.0f", value);
  return text;
}

}  // namespace clusterbench::report
