// `clusterbench size INPUT...`: buffer sizes to allocate, and code that monitors them. From a result, or from the input
// of a run.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <utility>

#include "cli/command_line/commands.h"
#include "cli/options/gates.h"
#include "cli/options/guarded_command.h"
#include "cli/options/run_inputs.h"
#include "cli/options/search_options.h"
#include "cli/output/output.h"
#include "cli/sizing/engine_grid.h"
#include "cli/sizing/size_counting.h"
#include "cli/sizing/size_search.h"
#include "config/schema/documents.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "os/stop_signals.h"
#include "report/cases/nothing_seen.h"
#include "report/documents/result_file.h"
#include "report/size_report/engine_settings.h"
#include "report/size_report/size_report.h"
#include "report/sizing/found_frames.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SizeFlags {
  RunInputs inputs;
  GuardFlags guard;
  report::SizeRequest request;
  double margin = 0.0, warn_at = 0.0;  // 0: from the configuration
  bool worst_case = false;
  SearchFlags search;
  std::vector<std::string> found;  // files of `worst-case`
  std::string engine;              // "": sizes of buffers are printed
  bool allows_no_lights = false;
  bool quiet = false;
};

// A configuration may have comments and syntax errors; its own reader reports those.
bool is_config(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::exists(path, none) || std::filesystem::is_directory(path, none)) return false;
  const Json value = json_or_discarded<Json>(file_text(path), JsonComments::allowed);
  return value.is_object() && !value.empty() && config::document_of(value) == config::Document::config &&
         !value.contains("schema_version") && !value.contains("header");
}

bool is_result(const RunInputs& inputs) {
  return inputs.paths.size() == 1 && !is_scene(inputs.paths.front()) && !is_config(inputs.paths.front());
}

// Measures the engine's own clustering, in another grid if flags name one that the engine can be set to.
void choose_engine(SizeFlags& flags) {
  report::check_engine(flags.engine);
  if (flags.request.format != "table" && flags.request.format != "json")
    throw Error("", "--engine", "prints settings, as a table or JSON, not " + flags.request.format);
  if (!flags.request.scope.views.empty())
    throw Error(
        "", "--views",
        "adds what cameras need of one buffer, and an engine's limits hold for each camera by itself; leave one "
        "of --views and --engine out");
  flags.request.engine = flags.engine;
  flags.request.all = true;
  if (is_result(flags.inputs)) return;
  flags.request.has_changed_grid = choose_engine_clustering(flags.engine, flags.inputs);
}

// A result is already measured: flags cannot change it, and it has no scene for a search.
void check_for_result(const SizeFlags& flags) {
  if (flags.worst_case)
    throw Error("", "--worst-case",
                "searches in the scene, and a result does not hold it; give the scene or the configuration, or what "
                "`clusterbench worst-case -o FILE` wrote with --found FILE");
  if (!flags.request.scope.grid_of.empty())
    throw Error("", "--grid-of", "asks the scene's cameras, and a result does not hold them; give the scene");
  const std::vector<config::FlagValue> given = flag_values(flags.inputs);
  if (given.empty()) return;
  if (given.front().name == "--fail-if")
    throw Error("", "--fail-if",
                "is held against what is counted, and a result has been; give `clusterbench run` the flag");
  throw Error("", given.front().name,
              "changes what is measured, and a result has been; give a configuration or scenes");
}

// Checks budgets against frames of the paths, and against frames that searches found.
std::vector<report::LimitFindings> findings_with_searches(const Gates& gates, const result::Result& result,
                                                          const std::vector<report::FoundFrame>& found) {
  std::vector<report::LimitFindings> findings = gates.findings(result);
  const bool is_searched = std::ranges::any_of(found, [](const auto& frame) { return frame.refusal.empty(); });
  if (findings.empty() || !is_searched) return findings;
  report::LimitFindings combined = gates.findings(report::with_finds(result, found)).back();
  const report::LimitFindings& recorded = findings.back();
  const auto mark = [](std::vector<std::string>& lines, const std::vector<std::string>& recorded_lines) {
    for (std::string& line : lines)
      if (std::ranges::find(recorded_lines, line) == recorded_lines.end()) line += "; found by a search";
  };
  mark(combined.broken, recorded.broken);
  mark(combined.near, recorded.near);
  findings.back() = combined;
  return findings;
}

// Prints which budgets were checked against recorded frames only.
void print_searched_budgets(const config::Config& config, const result::Result& result,
                            const std::vector<report::FoundFrame>& found) {
  std::vector<std::string> searched, measures;
  for (const report::FoundFrame& frame : found) {
    if (!frame.refusal.empty()) continue;
    for (auto [list, name] : {std::pair(&searched, &frame.case_name), std::pair(&measures, &frame.measure)})
      if (std::ranges::find(*list, *name) == list->end()) list->push_back(*name);
  }
  if (config.limits.fail_if.empty() || searched.empty()) return;
  print_message("budgets also hold what a search for " + joined(measures) + " found, in " +
                std::to_string(searched.size()) + " of " + number_of(result.cases.size(), "case") +
                "; all else of recorded frames alone");
}

// Checks that sizes are not computed from empty lists, and the configuration's budgets on the counts.
ExitCode check_sizes(const SizeFlags& flags, const SizeCounts* counts, const result::Result& result,
                     const report::SizeRequest& request) {
  const bool allows_no_lights = flags.allows_no_lights || (counts != nullptr && counts->config.limits.allows_no_lights);
  ExitCode code = ExitCode::ok;
  if (counts != nullptr) {
    config::Config config = counts->config;
    config.limits.allows_no_lights = allows_no_lights;
    keep_counted_budgets(config, "size");
    print_searched_budgets(config, result, request.scope.found);
    code = report_findings(findings_with_searches(Gates(config.limits, request.filter), result, request.scope.found));
  }
  const std::vector<result::BrokenCase> broken_cases = result.broken.value_or(std::vector<result::BrokenCase>());
  if (result.cases.empty() || !broken_cases.empty()) code = ExitCode::gate_failed;
  for (const result::BrokenCase& broken : broken_cases)
    print_message("FAILED " + broken.name + ": " + broken.reason + "; it is not sized");
  for (const std::string& name : report::sized_from_nothing(result, request)) {
    if (!allows_no_lights) code = ExitCode::gate_failed;
    print_message((allows_no_lights ? "warning: " : "FAILED ") + name +
                  (allows_no_lights ? "" : " (--allow-no-lights, limits.allow_no_lights, if that is meant)"));
  }
  return code;
}

std::string shard_warning(const std::string& file, const result::Shard& shard, bool is_empty) {
  return "warning: " + file + " is shard " + std::to_string(shard.index) + " of " + std::to_string(shard.count) +
         " of a run" + (is_empty ? " and has no cases" : "") +
         "; other shards can need more: size the result that `clusterbench merge` makes of all";
}

ExitCode interrupted() {
  print_message("interrupted; no sizes, since some frames were not counted or tried");
  return os::stopped_exit_code();
}

ExitCode size(SizeFlags flags) {
  if (!flags.engine.empty()) choose_engine(flags);
  report::SizeRequest request = flags.request;
  if (flags.margin > 0.0) request.margin = flags.margin;
  if (flags.warn_at > 0.0) request.warn_at = flags.warn_at;
  std::optional<SizeCounts> counts;
  result::Result result;
  if (!is_result(flags.inputs)) {
    std::optional<SizePlan> plan = plan_for_size(flags.inputs, request.filter, request.all, flags.engine);
    if (!plan) return interrupted();
    if (!flags.quiet)
      print_planned_counting(*plan,
                             flags.worst_case ? planned_search_text(*plan, request, flags.search) : std::string());
    counts = counted_for_size(std::move(*plan), flags.quiet);
    if (!counts) return interrupted();
    result = counts->result;
    request.scope.grown = counts->grown;
  } else {
    check_for_result(flags);
    result = report::read_result(flags.inputs.paths.front());
    if (result.machines && !request.all)
      print_message("note: " + flags.inputs.paths.front() +
                    " has times of several machines, which are not compared: of each grid the smallest structure "
                    "that loses no light, and no conclusion; --all has all");
    if (result.shard && result.shard->count > 1)
      print_message(shard_warning(flags.inputs.paths.front(), *result.shard, result.cases.empty()));
    result = report::without_times_of_machines(std::move(result));
  }
  for (const std::string& file : flags.found) {
    request.scope.found.push_back(report::read_found(file, result));
    const std::string& unknown = request.scope.found.back().not_compared;
    if (!unknown.empty()) print_message("warning: " + file + ": " + unknown);
  }
  if (flags.worst_case) {
    const auto found = search_sized(*counts, report::sized_cases(result, request), flags.search, flags.quiet);
    if (!found) return interrupted();
    request.scope.found.insert(request.scope.found.end(), found->begin(), found->end());
  }
  if (!request.scope.grid_of.empty()) {
    const auto guests = samples_of_guests(*counts, report::sized_cases(result, request), flags.quiet);
    if (!guests) return interrupted();
    request.scope.guests = *guests;
  }
  for (const std::string& view : report::views_of_dark_lights(result))
    print_message("warning: " + view +
                  "; lists have them all the same, so these are sizes for when they are switched on");
  const std::string text = report::size_report(result, request);
  std::cout << (request.format == "json" ? text : printable_lines(text)) << std::flush;
  return check_sizes(flags, counts ? &*counts : nullptr, result, request);
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
  command.add_option("--filter", flags->request.filter,
                     "Only cases whose name has this in it, or matches it as a regular expression");
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
  command.add_option("--name", flags->request.name,
                     "What names in code begin with, in place of scene and grid: light_lists_indices ...; where one "
                     "structure is printed");
  command.add_option(
      "--engine", flags->engine,
      "NAME: in the settings of this engine, of the preset of that name: " + joined(report::engines_with_settings()));
  command.add_flag("--all", flags->request.all, "Every structure, not the best one of each scene and grid");
  command
      .add_option("--views", flags->request.scope.views,
                  "NAME,NAME, repeatable: cameras that are drawn in the same frame into one buffer, whose needs are "
                  "added frame by frame; * stands for any letters")
      .once_a_name();
  command.add_option(
      "--grid-of", flags->request.scope.grid_of,
      "NAME: of the cameras of --views only this one has a grid, in which the others' samples are looked "
      "up; says what these lack");
  command.add_flag("--one-for-viewports", flags->request.scope.over_viewports,
                   "One allocation for all viewports, as for dynamic resolution; not one for each");
  const Option worst_case =
      command.add_flag("--worst-case", flags->worst_case,
                       "First search for frames that need more than those of the paths, and size by the larger one");
  command
      .add_option("--found", flags->found,
                  "FILE, repeatable: what `clusterbench worst-case -o FILE` found for the same scene and case")
      .once_a_name();
  add_effort_options(command, flags->search, &worst_case);
  add_space_options(command, flags->search, &worst_case);
  add_config_options(command, flags->inputs, {"--rounds", "--launches", k_cost_from});
  add_guard_options(command, flags->guard);
  command.add_flag("--allow-no-lights", flags->allows_no_lights, "Does not fail where no light is ever in view");
  command.add_flag("-q,--quiet", flags->quiet, "No progress; warnings stay");
  command.when_named([flags, &action] {
    action = [flags] { return guarded_if_needed(flags->inputs, flags->guard, [&] { return size(*flags); }); };
  });
}

}  // namespace clusterbench::cli
