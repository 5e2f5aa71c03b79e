// `clusterbench worst-case CONFIG|SCENE`: the frames in which a measure is largest.

#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/options/guarded_command.h"
#include "cli/options/run_inputs.h"
#include "cli/options/search_options.h"
#include "cli/output/duration.h"
#include "cli/output/output.h"
#include "cli/output/progress_line.h"
#include "core/libraries.h"
#include "core/text.h"
#include "os/stop_signals.h"
#include "report/searches/worst_case_report.h"
#include "scene/writers/write_gltf.h"
#include "search/replay_config.h"
#include "search/worst_case.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;

struct WorstCaseFlags {
  RunInputs inputs;
  GuardFlags guard;
  std::string output, path, filter, measure = "entries";
  SearchFlags search;
  bool quiet = false;
};

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const search::MeasureRow& row : search::measure_rows()) names.emplace_back(row.name);
  return names;
}

search::WorstCaseRequest request_of(const WorstCaseFlags& flags, const config::Config& config) {
  search::WorstCaseRequest request = search_request(flags.search, config);
  for (const search::MeasureRow& row : search::measure_rows())
    if (flags.measure == row.name) request.measure = row.measure;
  return request;
}

// The configuration file is next to the scene.
std::string config_path(const std::string& scene_path) {
  return scene_path.empty() ? "" : fs::path(scene_path).replace_extension(".json").string();
}

// Checks the path's files first, then the output that describes them.
LaterOutput checked_output(const WorstCaseFlags& flags, const config::Config& config) {
  if (!flags.path.empty() && fs::path(flags.path).extension() != ".gltf")
    throw Error(flags.path, "--path", "must end in .gltf");
  const std::vector<std::string> outputs{flags.output, flags.path, config_path(flags.path)};
  refuse_overwriting({outputs.begin(), outputs.begin() + (flags.path.empty() ? 1 : 3)}, files_of(flags.inputs, config));
  for (const std::string& output : {flags.path, config_path(flags.path)})
    if (!output.empty()) os::OutputFile(output).probe();
  return LaterOutput(flags.output, is_for_reading(flags.output));
}

// Printed before a long search.
void print_search_duration(const config::Config& config, const run::Plan& plan, const run::CasePlan& case_plan,
                           const search::WorstCaseRequest& request) {
  constexpr double k_soon_s = 5.0;
  const double seconds = search::estimated_search_s(config, plan, case_plan, request);
  if (seconds < k_soon_s) return;
  print_message("searches " + number_of(static_cast<std::uint64_t>(request.evaluations), "frame") + ", and " +
                number_of(static_cast<std::uint64_t>(request.random), "random one") + " to compare with: takes " +
                duration_text(seconds) + "; shorter: --evaluations 1000, --random 0, --seconds 60");
}

void write_path(const search::WorstCase& found, const report::WorstCaseFacts& facts) {
  write_text(facts.scene_file, scene::to_gltf(found.path_scene, "clusterbench worst-case"));
  write_text(
      facts.config_file,
      search::replay_config(facts.config, facts.case_plan, fs::path(facts.scene_file).filename().string()).dump(1) +
          "\n");
}

// Reads the path as `run` would, and measures it again.
void check_path(const search::WorstCase& found, const report::WorstCaseFacts& facts) {
  const config::Config config = config::load_config(facts.config_file);
  const run::Plan plan = run::make_plan(config, "");
  const run::CasePlan& replayed = search::replayed_case(plan, facts.case_plan);
  const run::PathFrames path = run::path_of(config, plan.scenes[0], 0, 0);
  const std::vector<double> values = search::values_along(config, replayed, facts.request.measure, path);
  bool is_same = values.size() == found.frames.size();
  for (std::size_t i = 0; is_same && i < values.size(); ++i) is_same = values[i] == found.frames[i].value;
  if (!is_same)
    throw Error(facts.scene_file, "replay", "does not give the values that the search has found", ExitCode::internal);
}

ExitCode worst_case(const WorstCaseFlags& flags) {
  need_library(Library::nlopt, "worst-case", "searches");
  config::Config config = config::with_presets_on_processor(read_inputs(flags.inputs));
  const search::WorstCaseRequest request = request_of(flags, config);
  const run::Plan plan = run::make_plan(config, flags.filter);
  const run::CasePlan& case_plan = search::case_to_search(config, plan);
  search::fix_grid(config, plan, case_plan);
  if (!flags.quiet) print_other_cameras(config, plan);
  LaterOutput output = checked_output(flags, config);
  if (!config.limits.fail_if.empty())
    print_message("warning: limits.fail_if is not looked at: `clusterbench run` and `size` do");
  if (!flags.quiet) print_search_duration(config, plan, case_plan, request);
  const std::atomic<bool>& stop = os::stop_on_signals();
  ProgressLine progress(os::terminal(os::StandardStream::error), flags.quiet);
  const search::WorstCase found =
      search::find_worst_case(config, plan, case_plan, request, search_listener(progress), stop);
  progress.clear();
  const bool has_frames = !found.frames.empty();
  const report::WorstCaseFacts facts{
      config, plan, case_plan, request, has_frames ? flags.path : "", has_frames ? config_path(flags.path) : ""};
  if (!facts.scene_file.empty()) write_path(found, facts);
  const bool for_reading = is_for_reading(flags.output);
  output.write(result::to_json(report::worst_case_document(found, facts)));
  const bool has_failed = found.ended == search::Ended::device;
  if (!facts.scene_file.empty() && !has_failed) check_path(found, facts);
  if (!flags.quiet)
    (for_reading ? std::cout : std::cerr) << printable_lines(report::worst_case_text(found, facts)) << std::flush;
  if (for_reading) warn_result_not_saved();
  if (!has_failed && !stop) return ExitCode::ok;
  print_message((has_failed ? found.device_failure : "interrupted") +
                "; all output is of the frames that were tried by then" +
                files_text({flags.output, facts.scene_file, facts.config_file}, "written"));
  if (has_failed) return ExitCode::usage;
  return os::stopped_exit_code();
}

}  // namespace

void add_worst_case(Command& program, Action& action) {
  auto flags = std::make_shared<WorstCaseFlags>();
  Command command = program.add_command(
      "worst-case", "Search for the camera and lights that make lists longest, and write them as a path for `run`");
  command.add_option("INPUT", flags->inputs.paths, "One configuration (.json), or a scene (.glb, .gltf)").required();
  command.add_option("-o,--output", flags->output,
                     "JSON file; -: standard output. Without it a terminal shows the text only, a pipe gets the JSON");
  command
      .add_option("--path", flags->path,
                  "Write the frames found as a scene with a camera path (.gltf), and beside it a configuration "
                  "(.json) that `clusterbench run` replays it with")
      .utf8();
  command.add_option("--measure", flags->measure, "What is to be as large as possible")
      .one_of(measure_names())
      .shows_standard();
  command.add_option(
      "--filter", flags->filter,
      "Of the cases whose name has this in it, or matches it as a regular expression, the first is searched");
  add_effort_options(command, flags->search);
  command.add_option("--random", flags->search.request.random, "Random frames to compare with; 0: none")
      .range(0, 10'000'000)
      .shows_standard();
  command.add_option("--best", flags->search.request.frames, "How many frames to find that are not nearly the same")
      .range(1, 1000)
      .shows_standard();
  add_space_options(command, flags->search);
  add_config_options(command, flags->inputs, {"--rounds", "--launches", "--fail-if", k_cost_from});
  add_guard_options(command, flags->guard);
  command.add_flag("-q,--quiet", flags->quiet, "No progress and no text");
  command.when_named([flags, &action] {
    action = [flags] { return guarded_if_needed(flags->inputs, flags->guard, [&] { return worst_case(*flags); }); };
  });
}

}  // namespace clusterbench::cli
