#include "report/history/history_lines.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/json_document.h"
#include "core/text.h"
#include "report/cases/json_values.h"
#include "report/cases/scene_lights.h"
#include "report/documents/machine_name.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using result::Basis;
using result::Figure;

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

Json line_of(const result::Result& result, const std::string& commit) {
  Json line{{"history_version", k_history_version},
            {"commit", commit},
            {"name", result.name},
            {"cpu", machine_name(result.machine)},
            {"simd_target", result.tool.simd_target}};
  if (const std::string counter = counter_of(result); !counter.empty()) line["counter"] = counter;
  if (has_cold_times(result)) {
    line["caches"] = "cold";
    if (const Json mib = setting_of_parts(result.config, "/timing/sweep_mib"); !mib.is_null())
      line["swept"] = mib.dump() + " MiB";
  }
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

HistoryEntry parsed(std::string_view line) {
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
  std::set<std::string> ids;
  for (const Json& stored : list_in(json, "", "cases")) {
    const std::string at = "/cases/" + std::to_string(number++);
    entry.cases.push_back(parsed_case(stored, at));
    if (const std::string id = text_or_none(stored, at, "id"); !id.empty() && !ids.insert(id).second)
      refuse_value(at + "/id", "'" + id + "' twice", "each case once");
  }
  number = 0;
  if (json.contains("scenes"))
    for (const Json& stored : list_in(json, "", "scenes"))
      entry.scenes.push_back(parsed_scene(stored, "/scenes/" + std::to_string(number++)));
  entry.device = text_or_none(json, "", "device");
  entry.swept = text_or_none(json, "", "swept");
  return entry;
}

HistoryEntry parsed_at(const std::string& path, std::string_view line, std::size_t number) {
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

// All but its cases, of a line as `written_line` writes it; empty for any other line. Quotes within a text are escaped,
// so a key is nothing else.
std::string head_of(std::string_view line) {
  constexpr std::string_view k_begin = R"({"history_version":1,"commit":")", k_cases = R"(,"cases":[)";
  const std::size_t cases = line.find(k_cases);
  if (!line.starts_with(k_begin) || !line.ends_with("]}") || cases == std::string_view::npos) return {};
  return std::string(line.substr(0, cases)) + k_cases.data() + "]}";
}

// A result is a document of many lines; its first keys tell it.
bool is_result(std::string_view text) {
  return text.substr(0, 400).find("\"schema_version\"") != std::string_view::npos && text.starts_with("{\n");
}

}  // namespace

bool is_kept(const Figure& figure) {
  return figure.is_exported() && figure.basis != Basis::derived && (figure.is_headline || figure.is_kept);
}

bool is_history(std::string_view text) {
  return text.starts_with(R"({"history_version")");
}

std::string written_line(const result::Result& result, const std::string& commit) {
  return line_of(result, commit).dump();
}

HistoryEntry HistoryLine::head(const std::string& path) const {
  const std::string head = head_of(text);
  return head.empty() ? whole(path) : parsed_at(path, head, number);
}

HistoryEntry HistoryLine::whole(const std::string& path) const {
  return parsed_at(path, text, number);
}

std::vector<HistoryLine> history_lines(const std::string& path, std::string_view text) {
  if (is_result(text))
    throw Error(path, "", "is a result, not a history; `clusterbench history add RESULT HISTORY` adds it to one");
  std::vector<HistoryLine> lines;
  for (std::size_t begin = 0, number = 1; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos)
      throw Error(path, "line " + std::to_string(number),
                  "has no end: if it is whole, add a line break behind it, otherwise remove it");
    const std::string_view line = text.substr(begin, end - begin);
    if (!is_blank_line(line)) lines.push_back({line, number, end + 1});
    begin = end + 1;
  }
  return lines;
}

}  // namespace clusterbench::report
