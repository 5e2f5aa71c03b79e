// `clusterbench worst-case CONFIG|SCENE`: the frames in which a measure is largest.

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/output.h"
#include "cli/run_inputs.h"
#include "cli/stop.h"
#include "cli/terminal.h"
#include "core/text.h"
#include "geom/shapes/domain.h"
#include "report/worst_case_report.h"
#include "scene/write_gltf.h"
#include "search/replay_config.h"
#include "search/worst_case.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;

struct WorstCaseFlags {
  RunInputs inputs;
  std::string output, path, filter, measure = "entries", within;
  std::vector<std::string> added;
  search::WorstCaseRequest request;
  bool quiet = false;
};

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const search::MeasureRow& row : search::measure_rows()) names.emplace_back(row.name);
  return names;
}

// All of the text, or not a number.
double number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? std::nan("") : value;
}

// "4x10": four lights with a range of 10 m; "10": one.
void add_lights(const std::string& text, std::vector<double>& ranges_m) {
  constexpr double k_most = 64;
  const std::size_t cross = text.find('x');
  const double count = cross == std::string::npos ? 1.0 : number_in(text.substr(0, cross));
  const double range_m = number_in(cross == std::string::npos ? text : text.substr(cross + 1));
  if (!(count >= 1.0 && count <= k_most) || count != std::floor(count) ||
      !(range_m > 0.0 && range_m <= geom::k_farthest_m))
    throw Error("", "--add-lights",
                "'" + text + "' is not COUNTxRANGE, as in 4x10: 1 to 64 lights, and metres above 0 and up to 1e15");
  ranges_m.insert(ranges_m.end(), static_cast<std::size_t>(count), range_m);
  if (static_cast<double>(ranges_m.size()) > k_most) throw Error("", "--add-lights", "adds more than 64 lights");
}

std::optional<search::Box> box_in(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(number_in(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (numbers.size() != 6 || std::ranges::any_of(numbers, [](double number) { return !std::isfinite(number); }))
    throw Error("", "--within", "'" + text + "' is no box: takes six numbers in metres, X0,Y0,Z0,X1,Y1,Z1");
  return search::Box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

search::WorstCaseRequest request_of(const WorstCaseFlags& flags, const config::Config& config) {
  search::WorstCaseRequest request = flags.request;
  for (const search::MeasureRow& row : search::measure_rows())
    if (flags.measure == row.name) request.measure = row.measure;
  for (const std::string& text : flags.added) add_lights(text, request.extra_ranges_m);
  request.within = box_in(flags.within);
  request.threads = config.threads;
  return request;
}

// Beside the scene.
std::string config_path(const std::string& scene_path) {
  return scene_path.empty() ? "" : fs::path(scene_path).replace_extension(".json").string();
}

void check_outputs(const WorstCaseFlags& flags, const config::Config& config) {
  if (!flags.path.empty() && fs::path(flags.path).extension() != ".gltf")
    throw Error(flags.path, "--path", "must end in .gltf");
  std::vector<std::string> inputs = flags.inputs.paths;
  for (const config::SceneRequest& scene : config.scenes) inputs.push_back(scene.path.string());
  const std::vector<std::string> outputs{flags.output, flags.path, config_path(flags.path)};
  refuse_overwriting({outputs.begin(), outputs.begin() + (flags.path.empty() ? 1 : 3)}, inputs);
  for (const std::string& output : outputs)
    if (!is_for_reading(output)) probe_output(output);
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
  const run::PathFrames path(plan.scenes[0].scene, plan.scenes[0].paths[0], config.viewports[0]);
  const std::vector<double> values = search::values_along(config, replayed, facts.request.measure, path);
  bool is_same = values.size() == found.frames.size();
  for (std::size_t i = 0; is_same && i < values.size(); ++i) is_same = values[i] == found.frames[i].value;
  if (!is_same)
    throw Error(facts.scene_file, "replay", "does not give the values that the search has found", ExitCode::internal);
}

ExitCode worst_case(const WorstCaseFlags& flags) {
  config::Config config = read_inputs(flags.inputs);
  const search::WorstCaseRequest request = request_of(flags, config);
  const run::Plan plan = run::make_plan(config, flags.filter);
  const run::CasePlan& case_plan = search::case_to_search(config, plan);
  search::fix_grid(config, plan, case_plan);
  if (!flags.quiet) tell_of_cameras_left_out(config, plan);
  check_outputs(flags, config);
  const std::atomic<bool>& stop = stop_on_signals();
  ProgressLine progress(terminal(STDERR_FILENO), flags.quiet);
  search::WorstCaseListener listener;
  listener.on_progress = [&](const std::string& doing, int done, int whole) {
    progress.show({static_cast<std::size_t>(done), static_cast<std::size_t>(whole), static_cast<double>(done),
                   static_cast<double>(whole), doing});
  };
  const search::WorstCase found = search::find_worst_case(config, plan, case_plan, request, listener, stop);
  progress.clear();
  const bool has_frames = !found.frames.empty();
  const report::WorstCaseFacts facts{
      config, plan, case_plan, request, has_frames ? flags.path : "", has_frames ? config_path(flags.path) : ""};
  if (!facts.scene_file.empty()) write_path(found, facts);
  const bool for_reading = is_for_reading(flags.output);
  if (!for_reading) write_output(flags.output, report::worst_case_to_json(found, facts));
  if (!facts.scene_file.empty()) check_path(found, facts);
  if (!flags.quiet)
    (for_reading ? std::cout : std::cerr) << printable_lines(report::worst_case_text(found, facts)) << std::flush;
  if (for_reading) tell_of_keeping();
  if (!stop) return ExitCode::ok;
  tell("interrupted: the worst frames by then are told");
  return stopped_exit_code();
}

void add_space_options(Command& command, WorstCaseFlags& flags) {
  command.add_option("--within", flags.within,
                     "X0,Y0,Z0,X1,Y1,Z1: where the camera may stand, metres; without: the box of the scene's lights "
                     "and recorded eyes");
  command.add_flag("--walkable", flags.request.walkable,
                   "The camera stands above triangles of the scene that look upward (at most 45 degrees from it)");
  command.add_option("--eye-height", flags.request.eye_height_m, "With --walkable: so high above them, metres")
      .range(0.0, 1e6)
      .shows_standard();
  command
      .add_option("--add-lights", flags.added,
                  "COUNTxRANGE, repeatable: so many point lights of that range, in metres, stand where they are worst")
      .once_a_name();
  command
      .add_option("--move-lights", flags.request.move_m,
                  "Move each light of the scene by up to so many metres; 0: none")
      .range(0.0, 1e15)
      .shows_standard();
}

}  // namespace

void add_worst_case(Command& program, Action& action) {
  auto flags = std::make_shared<WorstCaseFlags>();
  Command command = program.add_command(
      "worst-case", "Search for the camera and lights that make lists longest, and write them as a path for `run`");
  command.add_option("INPUT", flags->inputs.paths, "One configuration (.json), or a scene (.glb, .gltf)").required();
  command.add_option("-o,--output", flags->output,
                     "JSON file; -: standard output. Without it a terminal shows the text only, a pipe gets the JSON");
  command.add_option("--path", flags->path,
                     "Write the frames found as a scene with a camera path (.gltf), and beside it a configuration "
                     "(.json) that `clusterbench run` replays it with");
  command.add_option("--measure", flags->measure, "What is to be as large as possible")
      .one_of(measure_names())
      .shows_standard();
  command.add_option("--filter", flags->filter,
                     "Of the cases whose name matches this regular expression the first is searched");
  command.add_option("--evaluations", flags->request.evaluations, "Frames that the search may measure")
      .range(1, 10'000'000)
      .shows_standard();
  command
      .add_option("--seconds", flags->request.seconds,
                  "End the search after so many, too; the result then depends on the machine; 0 = never")
      .non_negative()
      .shows_standard();
  command.add_option("--random", flags->request.random, "Random frames to compare with; 0: none")
      .range(0, 10'000'000)
      .shows_standard();
  command.add_option("--best", flags->request.frames, "How many frames to find that are not nearly the same")
      .range(1, 1000)
      .shows_standard();
  command.add_option("--seed", flags->request.seed, "Seed of everything random").shows_standard();
  add_space_options(command, *flags);
  add_config_options(command, flags->inputs, {"--rounds", "--launches", "--fail-if"});
  command.add_flag("-q,--quiet", flags->quiet, "No progress and no text");
  command.when_named([flags, &action] { action = [flags] { return worst_case(*flags); }; });
}

}  // namespace clusterbench::cli
