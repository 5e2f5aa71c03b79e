// `clusterbench recommend SCENE|CONFIG`: which clustering to use, and why.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include "assign/contract/assigner.h"
#include "assign/contract/method_error.h"
#include "cli/command_line/commands.h"
#include "cli/options/guarded_command.h"
#include "cli/options/run_inputs.h"
#include "cli/output/duration.h"
#include "cli/output/output.h"
#include "cli/output/progress_line.h"
#include "cli/processes/launches.h"
#include "config/config.h"
#include "config/config_plugins.h"
#include "config/presets/preset_library.h"
#include "core/libraries.h"
#include "core/text.h"
#include "os/call_notes.h"
#include "os/stop_signals.h"
#include "report/choosing/recommend_report.h"
#include "report/choosing/recommended_config.h"
#include "result/figures/case_figure.h"
#include "run/cases/impossible_cases.h"
#include "run/cases/plan.h"
#include "run/findings/broken_cases.h"
#include "search/recommend.h"
#include "search/recommend_space.h"

namespace clusterbench::cli {
namespace {

// "--frame-us-max" for "frame_us.max".
std::string flag_of(const std::string& figure) {
  std::string flag = "--" + figure;
  std::ranges::replace(flag, '_', '-');
  std::ranges::replace(flag, '.', '-');
  return flag;
}

constexpr double k_no_limit = -1.0;

struct RecommendFlags {
  RunInputs inputs;
  GuardFlags guard;
  std::string output, written, objective, within = "5%", filter;
  std::vector<double> most = std::vector<double>(report::objective_figures().size(), k_no_limit);  // by figure
  int runners_up = 5, written_runners_up = 0;
  bool no_timing = false, quiet = false;
};

// A share: "5%", or "5" for the same.
double share_of(const std::string& text) {
  const std::string number = text.ends_with('%') ? text.substr(0, text.size() - 1) : text;
  std::size_t end = 0;
  double percent = -1.0;
  try {
    percent = std::stod(number, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  if (end == 0 || end != number.size() || !(percent >= 0.0 && percent <= 1000.0))
    throw Error("", "--within", "'" + text + "' is no share; takes percents from 0 to 1000, as in 5%");
  return percent / 100.0;
}

std::vector<config::LimitRule> rules_of(const RecommendFlags& flags, const config::Config& config) {
  std::vector<config::LimitRule> rules = config.limits.fail_if;
  for (const config::LimitRule& rule : rules)
    if (rule.side != config::LimitRule::Side::above || rule.is_relative || !rule.cases.empty())
      throw Error("", "limits.fail_if",
                  "'" + rule.text() + "': recommend takes budgets with > or >= and a number alone");
  for (const config::LimitRule& rule : rules)
    if (const result::Figure& figure = *result::figure_named(rule.figure);
        !figure.is_choosable && figure.better != result::Better::neither)
      throw Error("", "limits.fail_if",
                  "'" + rule.text() + "': recommend does not choose by " + rule.figure +
                      ", which `clusterbench run` holds; `clusterbench list figures` says what it chooses by");
  const std::vector<const result::Figure*> figures = report::objective_figures();
  for (std::size_t i = 0; i < figures.size(); ++i)
    if (flags.most[i] != k_no_limit) rules.push_back({std::string(figures[i]->name), false, flags.most[i]});
  return rules;
}

// Keys of the configuration that cannot change the choice.
std::string ignored_keys(const config::Config& config) {
  std::string keys;
  const auto add = [&](bool is_present, const char* key) {
    if (is_present) keys += (keys.empty() ? "" : ", ") + std::string(key);
  };
  add(config.details.has_value(), "details");
  add(config.stability.has_value(), "stability");
  add(config.reading.has_value(), "reading");
  add(!config.device.empty(), "device");
  add(!config.shadow_culls.empty(), "shadow_cull");
  add(config.shared_frusta.has_value(), "shadow_frusta");
  return keys;
}

// Methods that run on a device; presets take such where one is named.
void refuse_devices(const config::Config& config) {
  for (std::size_t i = 0; i < config.assigners.size(); ++i) {
    const std::string& name = config.assigners[i].name;
    if (!assign::find_assigner(name)->on_device) continue;
    const bool is_of_preset = i >= config.own_assigners;
    throw Error(config.file.string(), is_of_preset ? "device" : "assigners",
                (is_of_preset ? "with a device presets take methods that run on it (" + name + "), whose"
                              : name + " runs on a device, whose") +
                    " times do not compare with those of the processor; " +
                    (is_of_preset ? "leave the device out, or take `clusterbench run`"
                                  : "`clusterbench run` measures it beside others"));
  }
}

// `ignored`: receives the keys that are left out.
config::Config read_input(const RecommendFlags& flags, std::string& ignored) {
  config::load_plugins(flag_values(flags.inputs));  // their methods are candidates, too
  nlohmann::json defaults = search::recommend_space();
  defaults["samples"] = {{"opaque", {{"divisor", 16}}}};
  config::Config config = read_inputs(flags.inputs, {}, defaults);
  ignored = ignored_keys(config);
  refuse_devices(config);
  return config::changed(config, {{"details", nullptr},
                                  {"stability", nullptr},
                                  {"reading", nullptr},
                                  {"device", nullptr},
                                  {"shadow_cull", nullptr},
                                  {"shadow_frusta", nullptr}});
}

// A preset whose engine makes its lists on a GPU, so that times measured here are not the engine's; "" without any.
std::string preset_on_gpu(const config::Config& config) {
  for (const config::PresetChoice& choice : config.presets)
    if (config::find_preset(choice.preset)->assigns_on_gpu()) return choice.preset;
  return "";
}

// The default objective: the modelled cost of a frame; without times, or if not all candidates have them, the GPU's
// part alone.
const result::Figure* objective_of(const RecommendFlags& flags, const config::Config& config) {
  const bool has_times = !flags.no_timing && preset_on_gpu(config).empty();
  const std::string default_figure = has_times ? "frame_cost_us" : "gpu_cost_us";
  return result::find_figure(flags.objective.empty() ? default_figure : flags.objective);
}

// Costs need samples with a weight. A scene without triangles has no surfaces to shade: then each pixel is shaded once
// at a random depth of its view. Returns whether that is the case.
bool weight_volume_samples(config::Config& config, const run::Plan& plan) {
  const nlohmann::json& weights = config.resolved["cost"]["weights"];
  const auto has_cost = [&](const config::SampleSetRequest& set) {
    return weights[measure::name_of(set.set)] != 0.0 &&
           std::ranges::all_of(plan.scenes, [&](const auto& data) { return run::set_obstacle(set, data).empty(); });
  };
  if (std::ranges::any_of(config.sample_sets, has_cost)) return false;
  if (std::ranges::find(config.sample_sets, measure::SampleSet::volume, &config::SampleSetRequest::set) ==
      config.sample_sets.end())
    throw Error("", "--by", "a cost is that of samples, and there are none; take another figure, or shading.samples");
  config = config::changed(config, {{"cost", {{"weights", {{"volume", "pixels"}}}}}});
  return true;
}

// Returns whether times are measured.
bool check_timing(const RecommendFlags& flags, const report::Question& question, const config::Config& config) {
  if (!report::needs_times(*question.objective, question.constraints)) return false;
  if (flags.no_timing) throw Error("", "--no-timing", "leaves out the times that the objective or a constraint needs");
  if (const std::string preset = preset_on_gpu(config); !preset.empty())
    throw Error("", "presets",
                "'" + preset +
                    "' makes its lists on a GPU, and a time here would not be the engine's; take --by gpu_cost_us "
                    "and no constraint on times");
  return true;
}

// "next: clusterbench size choice.json": the command that sizes the buffers of the choice; for a level, over its whole
// paths. "" if nothing is chosen, or if one configuration cannot hold the choices.
std::string next_text(const RecommendFlags& flags, const result::Recommendation& recommendation) {
  if (recommendation.answers.size() != 1 || !recommendation.answers[0].choice) return "";
  const bool is_level = std::ranges::all_of(flags.inputs.paths, is_scene);
  const bool is_written = !flags.written.empty() && !is_stream(flags.written);
  std::vector<std::string> words{"clusterbench", "size", is_written ? flags.written : "choice.json"};
  if (is_level) words.insert(words.end(), {"--set", R"(scenes.*.frames={"rate": 30})"});
  return std::string("next: ") + (is_written ? "" : "the same with --write-config choice.json, then ") +
         shell_command(words) + "   sizes its buffers\n";
}

ExitCode write_and_show(const RecommendFlags& flags, const result::Recommendation& recommendation) {
  if (!flags.output.empty()) write_output(flags.output, result::to_json(recommendation));
  std::ostream& out = is_stream(flags.output) && !flags.output.empty() ? std::cerr : std::cout;
  out << printable_lines(report::recommendation_text(recommendation, next_text(flags, recommendation))) << std::flush;
  return report::all_satisfied(recommendation) ? ExitCode::ok : ExitCode::gate_failed;
}

// The limits of the search, printed before it begins: candidates on frames.
std::string budget_text(const run::Plan& plan, const search::View& view, const search::Request& request) {
  const search::Halving planned = search::planned_halving(view, request);
  std::string out = plan.scenes[view.scene].scene.name + ": " + number_of(view.candidates.size(), "candidate") + ", " +
                    number_of(view.frames, "frame") + " of " + number_of(view.cameras.size(), "camera");
  for (const search::Rung& rung : planned.rungs)
    out += (&rung == planned.rungs.data() ? "; measures at most " : ", ") + std::to_string(rung.candidates) + " on " +
           number_of(rung.frames, "frame");
  return out + ", " + std::to_string(planned.finalists.size()) + " and what may still be better on all frames";
}

// Prints the answers before the stop, and the state of the interrupted search.
ExitCode print_partial_answers(const RecommendFlags& flags, const config::Config& config,
                               const report::Question& question, const std::vector<result::Answer>& answers,
                               const search::View& view, const search::Found& found) {
  if (!answers.empty())
    std::cerr << printable_lines(report::recommendation_text(report::recommendation_of(config, question, answers)));
  std::cerr << printable_lines(report::unfinished_text(view, found, question)) << std::flush;
  print_message("interrupted" + files_text({flags.output, flags.written}, "not written"));
  return os::stopped_exit_code();
}

// The searches of a command with their estimated costs; without costs if they are not printed.
struct Searches {
  std::vector<search::View> views;
  std::vector<search::SearchCosts> costs;
};

void print_duration(const config::Config& config, run::Plan& plan, const search::Request& request, Searches& searches) {
  double all_s = 0.0, counting_s = 0.0;
  std::size_t candidates = 0;
  for (std::size_t i = 0; i < searches.views.size(); ++i) {
    const search::View& view = searches.views[i];
    const search::SearchCosts costs = searches.costs[i] = search::estimated_costs(config, plan, view, request);
    candidates += view.candidates.size();
    all_s += search::estimated_s(costs, view, request);
    counting_s += search::estimated_s({costs.grid_ns, costs.candidate_ns}, view, request);
  }
  std::vector<std::string> shorter;
  if (all_s - counting_s > 0.2 * all_s) shorter.push_back("--no-timing (" + duration_text(counting_s) + ")");
  shorter.insert(shorter.end(), {"--tiles 64,128", "--slices 16", "--grid frustum", "--assigner exact-fast,aabb-fast",
                                 "--filter TEXT"});
  print_message(wait_text(number_of(candidates, "candidate"), all_s, shorter));
}

// Printed after the duration: ignored keys and warnings.
void print_notes(const config::Config& config, const run::Plan& plan, const std::string& ignored) {
  if (!ignored.empty()) print_message("recommend compares costs and leaves out " + ignored + "; run reports them");
  print_other_cameras(config, plan);
}

void warn_of_random_depths() {
  const std::string unseen = missing_library(Library::embree);
  print_message(
      "warning: " + (unseen.empty() ? "the scene has no triangles" : unseen) +
      ": each pixel is shaded at a random depth, where no surface is, and surfaces can make another clustering "
      "the best; " +
      (unseen.empty() ? "export the level's meshes with its lights, or take a floor: --set "
                        "samples.opaque.ground=lowest, or =Y for one at that height"
                      : "take a build with it"));
}

bool needs_cost(const report::Question& question) {
  return question.objective->is_modelled_cost ||
         std::ranges::any_of(question.constraints, [](const report::Constraint& constraint) {
           return result::figure_named(constraint.rule.figure)->is_modelled_cost;
         });
}

// Runs all searches; fills `answers`. Returns the exit code if stopped.
std::optional<ExitCode> search_all(const RecommendFlags& flags, const config::Config& config, run::Plan& plan,
                                   const report::Question& question, const search::Request& request, Searches& searches,
                                   std::vector<result::Answer>& answers) {
  const std::atomic<bool>& stop = os::stop_on_signals();
  const run::Launcher launcher =
      request.is_timed && config.timing.launches > 1 ? make_launcher(config, plan, nullptr, stop) : run::Launcher{};
  ProgressLine progress(os::terminal(os::StandardStream::error), flags.quiet);
  const search::Watch watch{[&](const run::Progress& now) { progress.show(now); }, stop,
                            [&](const std::string& stage) { progress.stage(stage); }};
  for (std::size_t i = 0; i < searches.views.size(); ++i) {
    search::View& view = searches.views[i];
    if (!flags.quiet) print_message(budget_text(plan, view, request));
    const search::Found found = search::search_view(config, plan, view, request, launcher, watch, searches.costs[i]);
    progress.clear();
    if (stop) return print_partial_answers(flags, config, question, answers, view, found);
    answers.push_back(report::answer_of(config, plan, view, found, question));
  }
  return std::nullopt;
}

// A search compares the costs of all its candidates.
constexpr const char* k_without_it =
    "; recommend ends where a method fails: name the others by --assigner; `clusterbench run` goes on without it";

ExitCode recommend(const RecommendFlags& flags) {
  refuse_overwriting({flags.output, flags.written}, flags.inputs.paths);
  std::string ignored;
  config::Config config = read_input(flags, ignored);
  report::Question question{objective_of(flags, config), {}, share_of(flags.within), flags.runners_up};
  if (config.own_pre_culls > 1)
    throw Error(config.file.string(), "pre_cull",
                "recommend looks for a clustering of lights that are culled in one way; found " +
                    std::to_string(config.own_pre_culls) + " pre-culls, allowed: 1");
  question.constraints = report::constraints_of(rules_of(flags, config));
  const bool is_timed = check_timing(flags, question, config);
  config = config::changed(config, {{"timing", {{"measure", is_timed}}}});
  run::Plan plan = run::make_plan(config, flags.filter);
  refuse_overwriting({flags.output, flags.written}, files_of(flags.inputs, config));
  for (const std::string& output : {flags.output, flags.written})
    if (!output.empty() && !is_stream(output)) os::OutputFile(output).probe();
  const bool has_random_depths = needs_cost(question) && weight_volume_samples(config, plan);
  Searches searches{search::views_of(config, plan), {}};
  searches.costs.resize(searches.views.size());
  if (!flags.written.empty() && searches.views.size() != 1)
    throw Error(flags.written, "--write-config",
                "takes one scene in one viewport; these are " + std::to_string(searches.views.size()));
  const search::Request request{report::judge_of(question, config.resolved), is_timed, question.objective->only_grows,
                                question.within};
  if (!flags.quiet) print_duration(config, plan, request, searches);
  print_notes(config, plan, ignored);
  if (has_random_depths) warn_of_random_depths();
  std::vector<result::Answer> answers;
  if (const auto stopped = search_all(flags, config, plan, question, request, searches, answers)) return *stopped;
  const result::Recommendation recommendation = report::recommendation_of(config, question, answers);
  const ExitCode code = write_and_show(flags, recommendation);
  if (!flags.written.empty() && code == ExitCode::ok)
    write_output(flags.written, report::recommended_config(config, searches.views.front(), answers[0], question,
                                                           flags.written_runners_up, flags.written));
  return code;
}

ExitCode advised_recommend(const RecommendFlags& flags) {
  try {
    return recommend(flags);
  } catch (const assign::MethodError& error) {
    const std::string frame = run::frame_text(os::last_call().frame);
    throw Error(error.file(), error.where(), error.message() + (frame.empty() ? "" : " (" + frame + ")") + k_without_it,
                error.code());
  }
}

}  // namespace

void add_recommend(Command& program, Action& action) {
  auto flags = std::make_shared<RecommendFlags>();
  Command command = program.add_command(
      "recommend", "Which grid, method and light structure to take for a scene, by an objective and under constraints");
  command
      .add_option(
          "INPUT", flags->inputs.paths,
          "A scene (.glb, .gltf) with a space of candidates of its own, or a configuration (.json), whose grids, "
          "assigners and storages are the candidates")
      .required();
  const std::vector<const result::Figure*> figures = report::objective_figures();
  std::vector<std::string> objectives;
  for (const result::Figure* figure : figures) objectives.emplace_back(figure->name);
  command
      .add_option("--by", flags->objective,
                  "What is to be least; frame_cost_us if nothing is said, gpu_cost_us without timing")
      .one_of(objectives);
  for (std::size_t i = 0; i < figures.size(); ++i)
    command
        .add_option(flag_of(std::string(figures[i]->name)), flags->most[i],
                    "At most: " + std::string(figures[i]->meaning))
        .non_negative();
  command.add_option("--within", flags->within, "How much worse than the best a coarser grid may be").shows_standard();
  command.add_option("--runners-up", flags->runners_up, "How many are told behind the choice")
      .range(0, 100)
      .shows_standard();
  command.add_option("-o,--output", flags->output, "Write the answer as JSON to this file; -: standard output");
  command.add_option("--write-config", flags->written, "Write a configuration of the choice alone, for `run`");
  command
      .add_option("--write-runners-up", flags->written_runners_up,
                  "How many of those behind it are in that configuration, too")
      .range(0, 100)
      .shows_standard();
  command.add_option("--filter", flags->filter,
                     "Only candidates whose cases' names have this in them, or match it as a regular expression");
  add_config_options(command, flags->inputs);
  add_guard_options(command, flags->guard);
  command.add_flag("--no-timing", flags->no_timing, "Nothing is timed; the answer is then the same on every machine");
  command.add_flag("-q,--quiet", flags->quiet, "No progress; warnings stay");
  command.when_named([flags, &action] {
    action = [flags] {
      return guarded_if_needed(
          flags->inputs, flags->guard, [&] { return advised_recommend(*flags); }, k_without_it);
    };
  });
}

}  // namespace clusterbench::cli
