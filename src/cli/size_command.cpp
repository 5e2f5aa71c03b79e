// `clusterbench size INPUT...`: what to allocate, and the code that watches it. From a result, or from what makes one.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/output.h"
#include "cli/run_inputs.h"
#include "cli/stop.h"
#include "cli/terminal.h"
#include "config/documents.h"
#include "core/text.h"
#include "report/result_file.h"
#include "report/result_json.h"
#include "report/size.h"
#include "run/runner.h"
#include "run/sweep.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SizeFlags {
  RunInputs inputs;
  report::SizeRequest request;
  double margin = 0.0, warn_at = 0.0;  // 0: as the configuration says
  bool quiet = false;
};

// A configuration may have comments, and need not be JSON to be told apart: what is wrong with it, its own reader says.
bool is_config(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return false;
  std::ifstream in(path, std::ios::binary);
  const Json value = Json::parse(in, nullptr, false, true);
  return value.is_object() && !value.empty() && config::document_of(value) == config::Document::config &&
         !value.contains("schema_version") && !value.contains("header");
}

bool is_result(const RunInputs& inputs) {
  return inputs.paths.size() == 1 && !is_scene(inputs.paths.front()) && !is_config(inputs.paths.front());
}

// One allocation serves all cameras; where a scene names none, all are meant.
config::Config config_of_all_cameras(const RunInputs& inputs) {
  const config::Config given = read_inputs(inputs);
  std::vector<config::FlagValue> first;
  const nlohmann::json& scenes = given.resolved["scenes"];
  for (std::size_t i = 0; i < scenes.size(); ++i)
    if (scenes[i].is_object() && scenes[i].value("camera", "").empty())
      first.push_back({"--set", "scenes." + std::to_string(i) + ".camera=*"});
  return first.empty() ? given : read_inputs(inputs, first);
}

// Nothing that only times or pictures need; lists are not compared with the truth.
config::Config counting_only(config::Config config) {
  config.timing.measure = false;
  config.check_accuracy = false;
  config.stability.reset();
  config.lookup.reset();
  config.details.reset();
  config.resolved["timing"]["measure"] = false;
  config.resolved["accuracy"]["check"] = false;
  for (const char* key : {"stability", "lookup", "details"}) config.resolved[key] = nullptr;
  config.shadow_culls.clear();
  config.shared_frusta.reset();
  for (const char* key : {"shadow_cull", "shadow_frusta"}) config.resolved.erase(key);
  return config;
}

// Nothing once it is to stop.
std::optional<Json> counted(const SizeFlags& flags) {
  const config::Config config = counting_only(config_of_all_cameras(flags.inputs));
  const run::Plan plan = run::make_plan(config, flags.request.filter);
  const std::atomic<bool>& stop = stop_on_signals();
  ProgressLine progress(terminal(STDERR_FILENO), flags.quiet);
  run::Listener listener;
  listener.on_progress = [&](const run::Progress& now) { progress.show(now); };
  const run::Result result = run::run_plan(config, plan, {}, listener, stop);
  progress.clear();
  if (stop) return {};
  for (const run::SceneResult& scene : result.scenes)
    for (const std::string& warning : scene.warnings) tell("warning: " + scene.name + ": " + warning);
  if (result.cases.empty())
    for (const run::Skipped& skipped : result.skipped) tell("skipped " + skipped.name + ": " + skipped.reason);
  return report::result_to_json(result, {});
}

ExitCode size(const SizeFlags& flags) {
  report::SizeRequest request = flags.request;
  if (flags.margin > 0.0) request.margin = flags.margin;
  if (flags.warn_at > 0.0) request.warn_at = flags.warn_at;
  std::optional<Json> result;
  if (!is_result(flags.inputs)) {
    result = counted(flags);
  } else if (const std::vector<config::FlagValue> given = flag_values(flags.inputs); given.empty()) {
    result = report::read_result(flags.inputs.paths.front());
  } else {
    throw Error("", given.front().name,
                "changes what is measured, and a result has been; give a configuration or scenes");
  }
  if (!result) return stopped_exit_code();
  const std::string text = report::size_report(*result, request);
  std::cout << (request.format == "json" ? text : printable_lines(text));
  return ExitCode::ok;
}

}  // namespace

void add_size(Command& program, Action& action) {
  Command command = program.add_command("size",
                                        "Size each buffer of the light lists, from a result or straight from scenes: "
                                        "high-water marks, capacities, constants for C++ or a shader");
  auto flags = std::make_shared<SizeFlags>();
  command
      .add_option("INPUT", flags->inputs.paths,
                  "A result file of `clusterbench run`; or one configuration (.json), or scenes (.glb, .gltf), whose "
                  "frames are counted, of all cameras, without timing")
      .required();
  command.add_option("--filter", flags->request.filter, "Only cases whose name matches this regular expression");
  command.add_option("--format", flags->request.format, "What is printed: a table, code, or JSON")
      .one_of(report::size_formats())
      .shows_standard();
  command.add_option("--margin", flags->margin, "Capacity / high water, in place of allocation.margin")
      .range(1.0, 1000.0);
  command.add_option("--warn-at", flags->warn_at, "Share of the capacity, in place of allocation.warn_at")
      .range(0.01, 1.0);
  command.add_option("--round", flags->request.rounding, "Bytes of a buffer: to whole pages of 4 KiB, a power of two")
      .one_of(report::size_roundings())
      .shows_standard();
  command
      .add_option("--name", flags->request.name,
                  "What names in code begin with, in place of scene and grid: light_lists_indices ...; where one "
                  "structure is printed")
      .not_empty();
  command.add_flag("--all", flags->request.all, "Every structure, not the best one of each scene and grid");
  add_config_options(command, flags->inputs);
  command.add_flag("-q,--quiet", flags->quiet, "No progress; warnings stay");
  command.when_named([flags, &action] { action = [flags] { return size(*flags); }; });
}

}  // namespace clusterbench::cli
