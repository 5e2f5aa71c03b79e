// `clusterbench run CONFIG|SCENE...`: plan, measure, show, write.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/command_line/commands.h"
#include "cli/options/export_files.h"
#include "cli/options/gates.h"
#include "cli/options/picture_files.h"
#include "cli/options/run_inputs.h"
#include "cli/output/duration.h"
#include "cli/output/output.h"
#include "cli/output/progress_line.h"
#include "cli/processes/baseline_run.h"
#include "cli/processes/count_instructions.h"
#include "cli/processes/handover.h"
#include "cli/processes/launches.h"
#include "cli/processes/rounds_protocol.h"
#include "config/config.h"
#include "core/file_text.h"
#include "core/text.h"
#include "os/process.h"
#include "os/stop_signals.h"
#include "report/cases/failures.h"
#include "report/cases/timing_warnings.h"
#include "report/choosing/conclusion.h"
#include "report/comparing/compare.h"
#include "report/documents/journal.h"
#include "report/presets/preset_ranking.h"
#include "report/results/result_record.h"
#include "report/tables/table.h"
#include "report/tables/warnings.h"
#include "result/result.h"
#include "run/cases/plan.h"
#include "run/estimate.h"
#include "run/records/records.h"
#include "run/runner.h"
#include "run/scene_facts.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct RunFlags {
  RunInputs inputs;
  std::string output, filter, count;
  std::vector<std::string> exports;
  bool resume = false, dry_run = false, no_timing = false, quiet = false;

  BaselineRequest baseline;
  GateFlags gates;
  ImageFlags images;

  // Set only if this program is measured beside another one.
  int rounds_server = 0;

  // Set only in a child process of a run: a launch, or a count under callgrind. Its input comes on standard input.
  bool serves_launch = false;
  std::string count_dumps;
};

config::Config read_config(const RunFlags& flags) {
  std::error_code none;
  for (const char* way : {"perf", "callgrind", "auto"})
    if (!flags.count.empty() && flags.inputs.paths.back() == way && !fs::exists(way, none))
      throw Error("", "--count", std::string("takes its value with an equals sign: --count=") + way);
  return read_inputs(flags.inputs);
}

config::Config overridden(config::Config config, const RunFlags& flags) {
  if (flags.no_timing) config = config::changed(config, {{"timing", {{"measure", false}}}});
  set_gates(config, flags.gates);
  return config;
}

std::size_t case_count(const run::Plan& plan) {
  std::size_t count = 0;
  for (const run::GroupPlan& group : plan.groups) count += group.cases.size();
  return count;
}

// Methods on unsupported kinds of grids are many and expected: one line for all. Others get a line per reason.
void print_skipped(const std::vector<run::Skipped>& skipped) {
  struct Line {
    std::string reason, first;
    std::uint64_t others = 0;
  };
  std::vector<Line> lines;
  std::uint64_t other_kinds = 0;
  for (const run::Skipped& skipped_case : skipped) {
    if (skipped_case.is_other_kind) {
      ++other_kinds;
      continue;
    }
    const auto line = std::ranges::find(lines, skipped_case.reason, &Line::reason);
    if (line != lines.end())
      ++line->others;
    else
      lines.push_back({skipped_case.reason, skipped_case.name});
  }
  for (const Line& line : lines)
    std::cout << "skipped  " << printable(line.first)
              << (line.others > 0 ? " and " + std::to_string(line.others) + " more" : "") << ": "
              << printable(line.reason) << "\n";
  if (other_kinds > 0)
    std::cout << "skipped  " << number_of(other_kinds, "combination")
              << " of a method with a kind of grid that it does not take (`clusterbench list` tells which it takes)\n";
}

void print_duration(const config::Config& config, const run::Plan& plan, std::span<const run::GroupCost> costs) {
  constexpr double k_soon_s = 5.0;
  const double all_s = run::sum_s(costs), timing_s = run::sum_of_timing_s(costs);
  if (all_s < k_soon_s) return;
  std::vector<std::string> shorter;
  if (timing_s > 0.2 * all_s) {
    shorter.push_back("--no-timing (" + duration_text(all_s - timing_s) + ")");
    if (config.timing.rounds > 5) shorter.emplace_back("--rounds 5");
  }
  shorter.insert(shorter.end(), {"--filter TEXT", "--set 'scenes.*.frames=10'"});
  if (config.accuracy.check && !config.accuracy.most_pairs) shorter.emplace_back("--set accuracy.most_pairs=1000000");
  print_message(wait_text(number_of(case_count(plan), "case"), all_s, shorter));
}

// The configuration without the keys that do not change results.
Json measured_config(const config::Config& config) {
  Json out = config.resolved;
  out.erase("threads");
  for (const char* gate : {"fail_if", "baseline", "allow_no_lights", "allow_changed_lights"}) out["limits"].erase(gate);
  return out;
}

// The facts that must be the same in an interrupted run and the run that continues it.
Json journal_header(const config::Config& config, const run::Plan& plan, const RunFlags& flags) {
  const run::ToolFacts tool = run::tool_facts();
  Json scenes = Json::array();
  for (const run::SceneData& data : plan.scenes) scenes.push_back(data.contents_sha256());
  Json header{{"version", tool.version}, {"git_sha", tool.git_sha}, {"flags", tool.flags},
              {"scenes", scenes},        {"filter", flags.filter},  {"config", measured_config(config)}};
  if (!flags.count.empty()) header["count"] = flags.count;
  return header;
}

[[noreturn]] void throw_no_file_to_resume() {
  throw Error("", "--resume", "needs the result file of the interrupted run: add -o FILE");
}

// The plan without the cases that an interrupted run has finished.
run::Plan plan_left(run::Plan plan, const std::vector<std::string>& done) {
  for (run::GroupPlan& group : plan.groups)
    std::erase_if(group.cases, [&](const run::CasePlan& one) { return std::ranges::find(done, one.id) != done.end(); });
  std::erase_if(plan.groups, [](const run::GroupPlan& group) { return group.cases.empty(); });
  return plan;
}

ExitCode print_plan(const RunFlags& flags, const config::Config& config, run::Plan all) {
  if (flags.resume && is_stream(flags.output)) throw_no_file_to_resume();
  const std::vector<std::string> done = flags.resume
                                            ? report::finished_ids(flags.output, journal_header(config, all, flags))
                                            : std::vector<std::string>{};
  const std::size_t total = case_count(all);
  const run::Plan plan = plan_left(std::move(all), done);
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& case_plan : group.cases)
      std::cout << case_plan.id << "  " << printable(case_plan.name) << "\n";
  print_skipped(plan.skipped);
  const std::size_t left = case_count(plan);
  std::cerr << number_of(left, "case")
            << (flags.resume ? " left of " + std::to_string(total) + ", " + std::to_string(total - left) + " done"
                             : std::string())
            << ", " << plan.skipped.size() << " skipped; takes " << duration_text(run::estimated_s(config, plan))
            << "\n";
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    const run::SceneResult scene = run::scene_result(plan.scenes[i], config.scenes[i], config.viewports);
    for (const std::string& warning : scene.warnings) print_message("warning: " + scene.name + ": " + warning);
  }
  return ExitCode::ok;
}

// A file gets a journal; a device or a pipe gets the result at the end.
std::unique_ptr<report::Journal> open_journal(const RunFlags& flags, const config::Config& config,
                                              const run::Plan& plan) {
  constexpr std::uint64_t k_bytes_per_case = 24 << 10;
  if (is_stream(flags.output)) {
    if (flags.resume) throw_no_file_to_resume();
    return nullptr;
  }
  const std::uint64_t per_case = k_bytes_per_case + (config.details ? config.details->max_bytes : 0);
  auto journal = std::make_unique<report::Journal>(flags.output, journal_header(config, plan, flags), flags.resume,
                                                   per_case * case_count(plan));
  if (flags.resume && journal->is_empty())
    print_message("--resume begins anew: nothing that an interrupted run has measured is in " +
                  journal->partial_path().string());
  if (!journal->set_aside().empty())
    print_message(journal->partial_path().string() + ", left by a run that did not end, is now " +
                  journal->set_aside().string() + " (--resume goes on with such a file)");
  return journal;
}

// For messages about a run that ends early: the place of its finished cases.
std::string saved_cases_text(const report::Journal* journal) {
  if (journal == nullptr || journal->is_empty()) return "";
  return "; what was measured is in " + journal->partial_path().string() + ", --resume goes on";
}

Error with_saved_cases(const Error& error, const report::Journal* journal) {
  return Error(error.file(), error.where(), error.message() + saved_cases_text(journal), error.code());
}

ExitCode interrupted(const report::Journal* journal) {
  if (journal == nullptr)
    print_message(
        "interrupted; nothing is kept without a file: -o FILE keeps each case as it is finished, and then --resume "
        "goes on");
  else if (journal->is_empty())
    print_message(
        "interrupted before a case was finished, so nothing is kept: the same command begins anew; once some are, "
        "--resume goes on");
  else
    print_message("interrupted" + saved_cases_text(journal));
  return os::stopped_exit_code();
}

ExitCode report_gates(const result::Result& result) {
  const std::vector<std::string> failures = report::gate_failures(result);
  for (const std::string& failure : failures) print_message("FAILED " + failure);
  return failures.empty() ? ExitCode::ok : ExitCode::gate_failed;
}

// Arguments for the same plan in another program, which can be older and know neither budgets nor launches.
std::vector<std::string> plan_arguments(const RunFlags& flags) {
  std::vector<std::string> arguments;
  if (!flags.filter.empty()) arguments.push_back("--filter=" + flags.filter);
  for (const config::FlagValue& setting : flag_values(flags.inputs))
    if (setting.name != "--fail-if" && setting.name != "--launches") arguments.push_back(setting.text());
  arguments.emplace_back("--");
  arguments.insert(arguments.end(), flags.inputs.paths.begin(), flags.inputs.paths.end());
  return arguments;
}

// False if stopped.
bool add_baseline(const RunFlags& flags, const config::Config& config, const run::Plan& plan, ProgressLine& progress,
                  const report::Journal* journal, const std::atomic<bool>& stop, result::Result& result) {
  run::Progress now;
  now.cost_total = 1.0;
  const auto on_round = [&](const run::PairedRound& round) {
    now.doing = "beside " + flags.baseline.binary + ", launch " + std::to_string(round.launch + 1);
    progress.show(now);
    now.cost_done += round.share;
  };
  try {
    measure_beside(flags.baseline, plan_arguments(flags), config, plan, on_round, stop, result);
  } catch (const Error& error) {
    progress.clear();
    if (!stop) throw with_saved_cases(error, journal);
  }
  progress.clear();
  return !stop;
}

// The checks of a finished run.
struct Verdicts {
  std::optional<result::Comparison> comparison;  // with the program beside it; its gates include those of the run
  std::string changes;                           // since the baseline
  std::vector<report::LimitFindings> findings;
};

// Also writes the failures into the result.
Verdicts verdicts_of(const RunFlags& flags, const Gates& gates, result::Result& result) {
  Verdicts verdicts;
  if (!flags.baseline.binary.empty())
    verdicts.comparison = report::compare_results(result, result, flags.baseline.threshold_percent / 100.0);
  verdicts.changes = gates.changes(result);
  verdicts.findings = gates.findings(result);
  const std::vector<std::string> of_cases = report::gate_failures(result);
  std::vector<std::string> failures;
  if (verdicts.comparison)
    for (const std::string& failure : verdicts.comparison->failures)
      if (std::ranges::find(of_cases, failure) == of_cases.end()) failures.push_back(failure);
  for (const report::LimitFindings& some : verdicts.findings)
    failures.insert(failures.end(), some.broken.begin(), some.broken.end());
  report::conclude_failures(result, failures);
  return verdicts;
}

ExitCode report_verdicts(const Verdicts& verdicts, const result::Result& result) {
  ExitCode code = ExitCode::ok;
  if (verdicts.comparison) {
    std::cerr << printable_lines(report::comparison_text(*verdicts.comparison));
    code = report::outcome(*verdicts.comparison, false);
  } else {
    code = report_gates(result);
  }
  std::cerr << printable_lines(verdicts.changes) << std::flush;
  const ExitCode limits = report_findings(verdicts.findings);
  return code == ExitCode::ok ? limits : code;
}

run::Listener make_listener(ProgressLine& progress, report::Journal* journal, std::size_t earlier, std::size_t total) {
  run::Listener listener;
  listener.on_progress = [&progress](const run::Progress& now) { progress.show(now); };
  listener.on_case = [&progress, journal, number = earlier, total](const run::CaseResult& done) mutable {
    if (journal != nullptr) journal->add_case(run::record_of(done));
    progress.case_done(done, ++number, total);
  };
  return listener;
}

// The ids of the plan's cases without those that an interrupted run has finished.
std::vector<std::string> ids_left(const run::Plan& plan, const std::vector<std::string>& done) {
  std::vector<std::string> ids;
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& case_plan : group.cases)
      if (std::find(done.begin(), done.end(), case_plan.id) == done.end()) ids.push_back(case_plan.id);
  return ids;
}

// Counting comes first: errors are reported at once, and no timed work runs at the same time.
run::Counts count_instructions(CountWay way, const CountTask& task, ProgressLine& progress,
                               const std::atomic<bool>& stop) {
  run::Progress now;
  now.cases_total = task.ids.size();
  now.cost_total = static_cast<double>(task.ids.size());
  now.doing = std::string("instructions by ") + name_of(way);
  progress.show(now);
  run::Counts counts = count_cases(
      way, task,
      [&](const std::string&) {
        now.cost_done = static_cast<double>(++now.cases_done);
        progress.show(now);
      },
      stop);
  progress.clear();
  return counts;
}

// Warnings are printed even without a table.
void show_table(const RunFlags& flags, const result::Result& result) {
  if (flags.quiet) {
    std::cerr << report::warnings_text(result) << report::timing_warnings(result.cases);
    return;
  }
  const bool for_reading = is_for_reading(flags.output);
  std::ostream& out = for_reading ? std::cout : std::cerr;
  out << report::render_table(result,
                              os::terminal(for_reading ? os::StandardStream::output : os::StandardStream::error).colour)
      << std::flush;
  if (for_reading) warn_result_not_saved();
}

// "next: clusterbench size level.glb --filter '...'": the command that sizes the buffers of the recommended cases, from
// the same scenes with more frames, or from the result if the scenes came through a pipe. "" if no case is recommended.
std::string next_text(const RunFlags& flags, const result::Result& result) {
  const std::vector<std::string> recommended = report::taken_names(result);
  if (recommended.empty()) return "";
  std::vector<std::string> words{"clusterbench", "size"};
  const bool is_of_result = !is_stream(flags.output) && std::ranges::any_of(flags.inputs.paths, is_stream);
  if (is_of_result)
    words.push_back(flags.output);
  else
    words.insert(words.end(), flags.inputs.paths.begin(), flags.inputs.paths.end());
  for (const config::FlagValue& setting : flag_values(flags.inputs))
    if (!is_of_result && setting.name != "--fail-if" && setting.name != "--launches" && setting.name != "--rounds")
      words.push_back(setting.text());
  if (!is_of_result || recommended.size() == 1) words.insert(words.end(), {"--filter", recommended.front()});
  return "next: " + shell_command(words) + "   sizes its buffers\n";
}

// Printed last, after the warnings. A run that failed recommends nothing.
void show_conclusion(const RunFlags& flags, const result::Result& result) {
  std::ostream& out = is_for_reading(flags.output) ? std::cout : std::cerr;
  if (!report::run_failures(result).empty())
    out << "conclusion: " << report::failed_conclusion(result) << ".\n" << std::flush;
  else
    out << printable_lines(next_text(flags, result)) << report::conclusions_text(result)
        << report::preset_conclusions(result) << std::flush;
}

std::string command_line() {
  std::vector<std::string> words = os::own_command_line();
  if (!words.empty()) words.front() = "clusterbench";  // without the program's path
  return printable(shell_command(words));
}

// Checked before minutes of measuring.
void refuse_losses(const RunFlags& flags, const std::vector<std::string>& inputs) {
  const bool is_printed = flags.output.empty() && !is_for_reading(flags.output);
  std::vector<std::string> outputs{is_printed ? "-" : flags.output};
  if (!is_stream(flags.output)) outputs.push_back(report::partial_of(flags.output).string());
  std::error_code none;
  if (fs::is_directory(flags.images.folder, none)) outputs.push_back(PictureFiles::index_path(flags.images.folder));
  for (const std::string& text : flags.exports) outputs.push_back(text.substr(text.find('=') + 1));
  refuse_overwriting(outputs, inputs);
}

ExitCode measure(const RunFlags& flags, const config::Config& config, const run::Plan& plan, CountWay way,
                 const std::vector<ExportTarget>& exports) {
  const Gates own_gates(config, flags.filter);
  const std::vector<std::string> inputs = files_of(flags.inputs, config);
  refuse_losses(flags, inputs);
  // If the output is a file, the journal probes it.
  LaterOutput output(flags.output, !is_stream(flags.output) || is_for_reading(flags.output));
  const ExportFiles export_files(exports, config.timing.measure);
  std::optional<PictureFiles> images;
  if (!flags.images.folder.empty()) images.emplace(flags.images, config, plan, inputs);
  const std::atomic<bool>& stop = os::stop_on_signals();  // before there is anything to save
  const std::unique_ptr<report::Journal> journal = open_journal(flags, config, plan);
  const std::vector<result::Case> earlier = journal ? journal->earlier_cases() : std::vector<result::Case>{};
  const std::vector<std::string> earlier_ids = journal ? journal->earlier_ids() : std::vector<std::string>{};

  const os::Terminal screen = os::terminal(os::StandardStream::error);
  run::Counts counts;
  if (way != CountWay::none) {
    ProgressLine progress(screen, flags.quiet);
    counts = count_instructions(way, {config, plan, ids_left(plan, earlier_ids)}, progress, stop);
    if (stop) return interrupted(journal.get());
  }
  ProgressLine progress(screen, flags.quiet);
  const run::Launcher launcher =
      config.timing.launches > 1 ? make_launcher(config, plan, journal.get(), stop) : run::Launcher{};
  const run::Listener listener = make_listener(progress, journal.get(), earlier.size(), case_count(plan));
  std::vector<run::GroupCost> costs;
  if (!flags.quiet) {
    costs = run::estimated_costs(config, plan);
    print_duration(config, plan, costs);
  }
  run::Result fresh;
  try {
    fresh = run::run_plan(config, plan, earlier_ids, listener, stop, counts, launcher, costs);
  } catch (const Error& error) {
    progress.clear();
    throw with_saved_cases(error, journal.get());
  }
  progress.clear();
  if (stop) return interrupted(journal.get());
  if (!fresh.date.empty()) fresh.command = command_line();

  result::Result result = report::record_of(fresh, earlier);
  if (!flags.baseline.binary.empty() && !add_baseline(flags, config, plan, progress, journal.get(), stop, result))
    return interrupted(journal.get());
  const Verdicts verdicts = verdicts_of(flags, own_gates, result);
  if (journal)
    journal->finish(result);
  else
    output.write(result::to_json(result));
  export_files.write(result);
  show_table(flags, result);
  if (images && !images->write(result, screen, flags.quiet, stop)) {
    print_message("interrupted; the result is complete, its pictures are not");
    return os::stopped_exit_code();
  }
  const ExitCode code = report_verdicts(verdicts, result);
  if (!flags.quiet) show_conclusion(flags, result);
  return code;
}

void check_baseline(const RunFlags& flags) {
  std::error_code none;
  for (const std::string& input : flags.inputs.paths)
    if (is_stream_name(input) || !fs::is_regular_file(input, none))
      throw Error(input, "--baseline-binary", "is no file that the other program could read, too; save it to one");
  if (flags.no_timing)
    throw Error("", "--baseline-binary", "measures times, which --no-timing leaves out; take one of the two");
  probe_baseline(flags.baseline, plan_arguments(flags), os::stop_on_signals());
}

ExitCode serve(const RunFlags& flags, const config::Config& config, const run::Plan& plan) {
  if (flags.rounds_server != k_rounds_protocol)
    throw Error("", "--rounds-server",
                "version " + std::to_string(flags.rounds_server) + " is asked for, and this program speaks " +
                    std::to_string(k_rounds_protocol));
  serve_rounds(config, plan);
  return ExitCode::ok;
}

// The child process of a run.
ExitCode serve_run(const RunFlags& flags) {
  std::string line;
  if (!std::getline(std::cin, line)) return ExitCode::ok;  // the run has ended
  const ReceivedRun received = received_run(line, flags.inputs.paths.front());
  if (flags.serves_launch)
    serve_launch(received.config, received.plan);
  else
    print_callgrind_counts(received.config, received.plan, flags.count_dumps);
  return ExitCode::ok;
}

ExitCode run(const RunFlags& flags) {
  if (flags.serves_launch || !flags.count_dumps.empty()) return serve_run(flags);
  const config::Config config = overridden(read_config(flags), flags);
  const CountWay way = count_way(flags.count);
  run::Plan plan = run::make_plan(config, flags.filter);
  if (flags.rounds_server != 0) return serve(flags, config, plan);
  const std::vector<ExportTarget> exports = export_targets(flags.exports);
  if (flags.dry_run) return print_plan(flags, config, std::move(plan));
  if (!flags.baseline.binary.empty()) check_baseline(flags);
  return measure(flags, config, plan, way, exports);
}

}  // namespace

void add_run(Command& program, Action& action) {
  auto flags = std::make_shared<RunFlags>();
  Command command = program.add_command("run", "Measure a configuration, or scenes with the default sweep");
  command.add_option("INPUT", flags->inputs.paths, "One configuration (.json), or scenes (.glb, .gltf)").required();
  command.add_option(
      "-o,--output", flags->output,
      "Result file; -: standard output. Without it a terminal shows the table only, a pipe gets the result");
  command.add_option("--export", flags->exports, "FORMAT=FILE, repeatable: also write another tool's format")
      .once_a_name();
  add_image_options(command, flags->images);
  command
      .add_option("--filter", flags->filter,
                  "Only cases whose name has this in it, or matches it as a regular expression")
      .may_be_empty();
  add_config_options(command, flags->inputs);
  command.add_flag("--count{auto}", flags->count,
                   "Count instructions, too: --count=perf (hardware), =callgrind (valgrind), or what works");
  command.add_option("--count-dumps", flags->count_dumps, "").hidden();
  command.add_option("--baseline-binary", flags->baseline.binary,
                     "Another clusterbench: both are measured side by side, and compared");
  command.add_option("--baseline-launches", flags->baseline.launches, "How often both are started, at least")
      .range(2, 1000)
      .shows_standard();
  command
      .add_option("--baseline-most-launches", flags->baseline.most_launches,
                  "How often at most, where intervals are wider than half the threshold on either side")
      .range(2, 1000)
      .shows_standard();
  command.add_option("--baseline-timeout", flags->baseline.timeout_s, "Longest wait for one answer, in seconds")
      .range(0.1, 1e6)
      .shows_standard();
  command
      .add_option("--threshold", flags->baseline.threshold_percent,
                  "Smallest change against the baseline that matters, in percent")
      .range(0.01, 1000.0)
      .shows_standard();
  add_gate_options(command, flags->gates);
  command.add_option("--rounds-server", flags->rounds_server, "").hidden();
  command.add_flag(k_serve_launch, flags->serves_launch, "").hidden();
  command.add_flag("--resume", flags->resume, "Continue the interrupted run of the same -o FILE");
  command.add_flag("--dry-run", flags->dry_run,
                   "List the cases and what is skipped, and tell about how long the run takes; write nothing");
  command.add_flag("--no-timing", flags->no_timing, "Count only; the output is then the same on every machine");
  command.add_flag("-q,--quiet", flags->quiet, "No progress and no table; warnings stay");
  command.when_named([flags, &action] { action = [flags] { return run(*flags); }; });
}

}  // namespace clusterbench::cli
