// `clusterbench list`: everything that a configuration can name, with its parameters.

#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "assign/contract/assigner.h"
#include "assign/contract/storage.h"
#include "cli/command_line/commands.h"
#include "cli/options/guarded_command.h"
#include "cli/options/plugin_option.h"
#include "cli/output/output.h"
#include "config/presets/preset_library.h"
#include "core/libraries.h"
#include "cull/pre_cull_spec.h"
#include "gpu/device/device_facts.h"
#include "gpu/user_shaders/shader_method.h"
#include "os/stop_signals.h"
#include "plugin/plugins.h"
#include "report/history/history.h"
#include "result/figures/figure_table.h"
#include "run/records/records.h"
#include "scene/generators/generate.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const assign::ParamValue& value) {
  return std::visit([](const auto& number) { return Json(number); }, value);
}

Json to_json(const std::vector<assign::ParamSpec>& params) {
  Json list = Json::array();
  for (const assign::ParamSpec& param : params) {
    Json entry{{"name", param.name}, {"summary", param.summary}, {"default", to_json(param.default_value)}};
    if (!param.unit.empty()) entry["unit"] = param.unit;
    if (std::isfinite(param.conservative_from)) entry["conservative_from"] = param.conservative_from;
    if (param.is_thread_count) entry["threads"] = true;
    if (std::holds_alternative<double>(param.default_value)) entry["range"] = {param.min, param.max};
    if (!param.choices.empty()) entry["choices"] = param.choices;
    list.push_back(entry);
  }
  return list;
}

Json to_json(const assign::AssignerDescriptor& assigner) {
  Json kinds = Json::array();
  for (const grid::Kind kind : assigner.kinds) kinds.push_back(grid::kind_name(kind));
  Json lights = Json::array();
  if (assigner.points) lights.push_back("point");
  if (assigner.spots) lights.push_back("spot");
  if (assigner.boxes) lights.push_back("box");
  Json needs = Json::array(), answers = Json::array();
  if (assigner.needs.depth) needs.push_back("depth");
  if (assigner.answers(assign::Answer::lists)) answers.push_back("lists");
  if (assigner.answers(assign::Answer::structure)) answers.push_back("structure");
  Json out{{"name", assigner.name},
           {"summary", assigner.summary},
           {"source", assigner.source},
           {"grids", kinds},
           {"lights", lights},
           {"needs", needs},
           {"answers", answers},
           {"conservative", assigner.conservative},
           {"exact", assigner.exact},
           {"naive", assigner.naive},
           {"on_device", assigner.on_device},
           {"orthographic", assigner.orthographic},
           {"params", to_json(assigner.params)}};
  if (!assigner.plugin.empty()) out["plugin"] = assigner.plugin;
  return out;
}

void warn_of_path(const std::string& fault) {
  print_message(std::string("warning: ") + plugin::k_path_variable + ": " + fault);
}

// Those in the folders of the path variable that can be loaded, each tried in a process of its own: one that crashes or
// hangs hides no other one.
std::vector<std::filesystem::path> sound_plugins_on_path() {
  std::vector<std::filesystem::path> sound;
  for (const std::filesystem::path& file : plugin::files_on_path()) {
    const std::string fault = loading_fault(file);
    if (os::stop_signal() != 0) break;
    if (fault.empty())
      sound.push_back(file);
    else
      warn_of_path(fault);
  }
  return sound;
}

void load_all_plugins(const std::vector<std::string>& given, const std::vector<std::filesystem::path>& on_path) {
  load_plugins(given);
  for (const std::filesystem::path& file : on_path) {
    try {
      plugin::load_plugin(file);
    } catch (const Error& error) {
      warn_of_path(error.what());
    }
  }
}

// Tiles that depend on the viewport are those of 1920 x 1080 pixels.
Json to_json(const config::Preset& preset) {
  const auto parts = config::preset_parts(preset, {1920, 1080});
  Json out{{"name", preset.name},
           {"engine", preset.engine},
           {"version", preset.version},
           {"evidence", preset.evidence},
           {"summary", preset.summary},
           {"source", preset.source},
           {"approximated", preset.approximated},
           {"unverified", preset.unverified},
           {"assigns_on", preset.assigns_on},
           {"grid", parts["grid"]},
           {"assigner", parts["assigner"]}};
  if (parts.contains("storage")) out["storage"] = parts["storage"];
  if (parts.contains("pre_cull")) out["pre_cull"] = parts["pre_cull"];
  if (const std::string limit = config::limit_text(preset); !limit.empty()) out["limit"] = limit;
  if (const std::uint64_t most = config::most_lights(preset); most > 0) out["most_lights"] = most;
  if (preset.on_device) out["on_device"] = result::to_json(*preset.on_device);
  if (preset.not_on_device) out["not_on_device"] = *preset.not_on_device;
  if (preset.has_mistakes()) {
    out["mistakes"] = *preset.mistakes;
    out["as_shipped"] = result::to_json(*preset.as_shipped);
  }
  return out;
}

// Where a figure can be used.
Json uses_of(const result::Figure& figure) {
  Json uses{{"budget", true}, {"budget_of_one_sample_set", figure.is_at_samples()}, {"recommend", figure.is_choosable}};
  if (figure.is_exported())
    uses["export"] = {{"name", figure.exported_as()}, {"unit", figure.unit}, {"headline", figure.is_headline}};
  // Budgets are of the sets that rank, exports of one.
  if (figure.is_exported() && figure.is_at_samples())
    uses["export"]["of"] =
        figure.name == "needed" ? "all random points in the view together" : "random points in the view";
  uses["history"] = report::is_kept(figure);
  return uses;
}

Json to_json(const result::Figure& figure) {
  return {{"name", figure.name},
          {"unit", figure.named_unit()},
          {"meaning", figure.meaning},
          {"better", result::name_of(figure.better)},
          {"rests_on", result::name_of(figure.basis)},
          {"uses", uses_of(figure)}};
}

Json to_json(const OptionalLibrary& row) {
  return {{"name", row.name}, {"serves", row.serves}, {"without", row.without}, {"built_in", row.is_built_in}};
}

Json everything() {
  Json all{{"assigners", Json::array()}, {"storages", Json::array()}, {"grids", Json::array()}};
  for (const assign::AssignerDescriptor* assigner : assign::assigner_descriptors())
    all["assigners"].push_back(to_json(*assigner));
  for (const assign::StorageDescriptor* row : assign::storage_descriptors())
    all["storages"].push_back(
        {{"name", row->name}, {"summary", row->summary}, {"source", row->source}, {"params", to_json(row->params)}});
  for (int kind = 0; kind < grid::k_kind_count; ++kind)
    all["grids"].push_back(grid::kind_name(static_cast<grid::Kind>(kind)));
  for (const config::Preset& preset : config::presets()) all["presets"].push_back(to_json(preset));
  for (const cull::StepSummary& row : cull::step_summaries())
    all["pre_culls"].push_back({{"name", row.name}, {"summary", row.summary}, {"source", row.source}});
  for (const scene::GeneratorRow& row : scene::generators())
    all["scenes"].push_back(
        {{"name", row.name}, {"summary", row.summary}, {"source", row.source}, {"default_lights", row.default_lights}});
  for (const result::Figure& figure : result::figures()) all["figures"].push_back(to_json(figure));
  for (const OptionalLibrary& row : optional_libraries()) all["libraries"].push_back(to_json(row));
  return all;
}

Json to_json(const gpu::DeviceFacts& device) {
  Json out = result::to_json(run::record_of(device));
  if (!device.obstacle.empty()) out["obstacle"] = device.obstacle;
  return out;
}

// They are looked for only where somebody asks for them: that loads every driver.
Json devices() {
  const gpu::DeviceList found = gpu::list_devices();
  if (found.devices.empty()) throw Error("", "list devices", found.obstacle);
  Json list = Json::array();
  for (const gpu::DeviceFacts& device : found.devices) list.push_back(to_json(device));
  return list;
}

std::string word_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value.get<double>());
  return text;
}

std::string words(const Json& array) {
  std::string text;
  for (const Json& word : array) text += (text.empty() ? "" : ", ") + word_of(word);
  return text;
}

// Parameters that many methods share are explained at the first one. `explained`: explanation -> first method with it.
void print_params(const Json& row, std::map<std::string, std::string>& explained) {
  std::map<std::string, std::string> as_for;  // method -> parameters that it explains for this one
  for (const Json& param : row["params"]) {
    const std::string assignment = param["name"].get<std::string>() + " = " + word_of(param["default"]);
    const auto [earlier, is_new] = explained.emplace(param.dump(), row["name"]);
    if (!is_new) {
      std::string& shared = as_for[earlier->second];
      shared += (shared.empty() ? "" : ", ") + assignment;
      continue;
    }
    std::cout << "      " << assignment;
    if (param.contains("choices")) std::cout << "  (" << words(param["choices"]) << ")";
    if (param.contains("range"))
      std::cout << "  (" << word_of(param["range"][0]) << " to " << word_of(param["range"][1]) << ")";
    if (param.contains("unit")) std::cout << " " << param["unit"].get<std::string>();
    std::cout << ": " << param["summary"].get<std::string>() << "\n";
  }
  for (const auto& [method, shared] : as_for) std::cout << "      " << shared << ": as for " << method << "\n";
}

// The settings of a preset as in a configuration, in one line.
std::string parts_text(const Json& preset) {
  std::string text = preset["grid"].dump() + " " + preset["assigner"].dump();
  for (const char* part : {"storage", "pre_cull"})
    if (preset.contains(part)) text += " " + preset[part].dump();
  return text;
}

// What a device that is named changes. "" for engines that assign on the processor.
std::string device_text(const Json& preset) {
  if (preset.contains("not_on_device")) return "not with --device: " + preset["not_on_device"].get<std::string>();
  if (!preset.contains("on_device")) return "";
  const Json& on_device = preset["on_device"];
  const std::string approximated = on_device["approximated"].get<std::string>();
  return "with --device: " + on_device["assigner"].dump() +
         (approximated.empty() ? "" : "; approximated: " + approximated);
}

void print_preset(const Json& preset) {
  const auto text = [&](const char* key) { return preset.value(key, ""); };
  std::cout << "  " << text("name") << ": " << text("engine") << ", " << text("version") << " (" << text("evidence")
            << "): " << text("summary") << " [" << text("source") << "]\n";
  if (preset.contains("limit")) std::cout << "      limit: " << text("limit") << "\n";
  for (const char* key : {"approximated", "unverified"})
    if (!text(key).empty()) std::cout << "      " << key << ": " << text(key) << "\n";
  if (preset.contains("mistakes")) std::cout << "      with --as-shipped: " << text("mistakes") << "\n";
  std::cout << "      " << parts_text(preset) << "\n";
  if (const std::string on_device = device_text(preset); !on_device.empty()) std::cout << "      " << on_device << "\n";
}

void print_presets(const Json& presets) {
  std::cout
      << "presets (tiles that follow the viewport as for 1920 x 1080; ran: the engine's own code, or a transcription "
         "of it, was run\nand its lists compared; read: its code or publication was read; memory: neither; with "
         "--device: the "
         "method that is run\nand timed in place of the other where a device is named)\n";
  for (const Json& preset : presets) print_preset(preset);
}

void print_devices(const Json& devices) {
  std::cout << "devices (for --device: the number, the UUID or a part of the name)\n";
  std::size_t index = 0;
  for (const Json& device : devices) {
    std::cout << "  " << index++ << "  " << word_of(device["name"]) << " [" << word_of(device["type"]) << ", "
              << word_of(device["driver"]) << ", Vulkan " << word_of(device["vulkan"]) << "]\n      "
              << word_of(device["uuid"]) << "\n";
    if (device.contains("obstacle")) {
      std::cout << "      cannot be used: it " << word_of(device["obstacle"]) << "\n";
      continue;
    }
    std::cout << "      subgroups of " << word_of(device["subgroup_size"]) << ", groups of at most "
              << word_of(device["max_group_size"]) << " with " << word_of(device["shared_bytes"])
              << " bytes, buffers of at most " << device["max_buffer_bytes"].get<std::uint64_t>() << " bytes; "
              << (device["timestamp_bits"] == 0 ? std::string("no clock")
                                                : "clock ticks of " + word_of(device["timestamp_period_ns"]) + " ns")
              << (device["rounds_to_nearest"] ? "; rounds to nearest" : "; cannot be asked to round to nearest")
              << "\n";
  }
}

void print_figure(const Json& figure) {
  const Json& uses = figure["uses"];
  std::cout << "  " << word_of(figure["name"]) << " [" << word_of(figure["unit"]) << "]: " << word_of(figure["meaning"])
            << "\n      better: " << word_of(figure["better"]) << "; rests on: " << word_of(figure["rests_on"])
            << "; budget";
  if (uses["budget_of_one_sample_set"]) std::cout << ", also as SET." << word_of(figure["name"]);
  if (uses["recommend"]) std::cout << "; recommend";
  if (uses.contains("export"))
    std::cout << "; export " << word_of(uses["export"]["name"]) << " [" << word_of(uses["export"]["unit"]) << "]"
              << (uses["export"].contains("of") ? " of " + word_of(uses["export"]["of"]) : "")
              << (uses["export"]["headline"] ? "" : " with --all");
  std::cout << (uses["history"] ? "; history" : "") << "\n";
}

void print_figures(const Json& figures) {
  std::cout << "figures of a case (budget: --fail-if and limits.fail_if; recommend: --by and limits such as --longest; "
               "SET: volume, opaque,\ntransparent, fog, mirror, anywhere)\n";
  for (const Json& figure : figures) print_figure(figure);
}

void print_libraries(const Json& libraries) {
  std::cout << "libraries (optional ones of this build)\n";
  for (const Json& library : libraries)
    std::cout << "  " << word_of(library["name"]) << ": "
              << (library["built_in"] ? "built in, for " + word_of(library["serves"])
                                      : "not built in; " + word_of(library["without"]))
              << "\n";
}

void print_section(const Json& all, const char* section) {
  if (std::string_view(section) == "presets") {
    print_presets(all[section]);
    return;
  }
  if (std::string_view(section) == "devices") {
    print_devices(all[section]);
    return;
  }
  if (std::string_view(section) == "figures") {
    print_figures(all[section]);
    return;
  }
  if (std::string_view(section) == "libraries") {
    print_libraries(all[section]);
    return;
  }
  std::cout << section << "\n";
  std::map<std::string, std::string> explained;
  for (const Json& row : all[section]) {
    if (row.is_string()) {
      std::cout << "  " << row.get<std::string>() << "\n";
      continue;
    }
    std::cout << "  " << row["name"].get<std::string>() << ": " << row["summary"].get<std::string>() << " ["
              << row["source"].get<std::string>() << "]\n";
    if (row.contains("grids"))
      std::cout << "      grids: " << words(row["grids"]) << "; lights: " << words(row["lights"])
                << (row["needs"].empty() ? "" : "; needs: " + words(row["needs"]))
                << "; output: " << words(row["answers"])
                << (row["exact"]          ? "; exact"
                    : row["conservative"] ? "; conservative"
                                          : "; NOT conservative")
                << "\n";
    if (row.contains("params")) print_params(row, explained);
  }
}

constexpr const char* k_devices = "devices";  // only by name
constexpr const char* k_sections[] = {"assigners", "storages", "grids",     "pre_culls", "scenes",
                                      "presets",   "figures",  "libraries", k_devices};

// `wanted`: "" for all sections.
void print_text(const Json& all, const std::string& wanted) {
  for (const char* section : k_sections)
    if (wanted.empty() ? section != k_devices : wanted == section) print_section(all, section);
  if (!wanted.empty()) return;
  std::cout << "Devices of this machine, for methods that run on one: clusterbench list devices\n";
  std::cout << "All keys of a configuration: docs/configuration.md, or `clusterbench schema config`\n";
}

void print_all(const std::string& section, bool as_json) {
  Json all = everything();
  if (section == k_devices) all[k_devices] = devices();
  if (as_json)
    std::cout << (section.empty() ? all : all[section]).dump(2) << "\n";
  else
    print_text(all, section);
}

}  // namespace

void add_list(Command& program, Action& action) {
  Command command = program.add_command("list",
                                        "Assigners, storages, grids, pre-culls, scenes and presets that exist, with "
                                        "their parameters, figures of cases, optional libraries, and devices");
  auto as_json = std::make_shared<bool>(false);
  auto section = std::make_shared<std::string>();
  command
      .add_option("SECTION", *section,
                  "Only these: assigners, storages, grids, pre_culls, scenes, presets, figures, libraries or devices")
      .one_of({std::begin(k_sections), std::end(k_sections)});
  command.add_flag("--json", *as_json, "As JSON");
  auto plugins = std::make_shared<std::vector<std::string>>();
  add_plugin_option(command, *plugins);
  auto shaders = std::make_shared<std::vector<std::string>>();
  command.add_option("--shader", *shaders, "FILE, repeatable: also your own compute shaders as a method");
  command.when_named([as_json, section, plugins, shaders, &action] {
    action = [as_json, section, plugins, shaders] {
      const std::vector<std::filesystem::path> on_path = sound_plugins_on_path();
      if (os::stop_signal() != 0) return os::stopped_exit_code();
      const auto list = [&] {
        load_all_plugins(*plugins, on_path);
        for (const std::string& shader : *shaders) gpu::add_shader_method(shader);
        print_all(*section, *as_json);
        return ExitCode::ok;
      };
      return plugins->empty() && on_path.empty() ? list() : run_guarded_once(loading_limits(), ExitCode::usage, list);
    };
  });
}

}  // namespace clusterbench::cli
