#include "cli/running/measured_run.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include "cli/output/duration.h"
#include "cli/output/output.h"
#include "cli/output/progress_line.h"
#include "cli/processes/launches.h"
#include "cli/running/broken_cases.h"
#include "cli/running/printed_result.h"
#include "cli/running/run_journal.h"
#include "cli/running/sharded_plan.h"
#include "cli/running/verdicts.h"
#include "core/text.h"
#include "os/process.h"
#include "os/stop_signals.h"
#include "report/results/result_record.h"
#include "run/estimate.h"
#include "run/records/records.h"
#include "run/runner.h"
#include "run/timing/cache_sweep.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;

void print_duration(const config::Config& config, const run::Plan& plan, std::span<const run::GroupCost> costs) {
  constexpr double k_soon_s = 5.0;
  const double all_s = run::sum_s(costs), timing_s = run::sum_of_timing_s(costs);
  if (all_s < k_soon_s) return;
  std::vector<std::string> shorter;
  if (timing_s > 0.2 * all_s) {
    shorter.push_back("--no-timing (" + duration_text(all_s - timing_s) + ")");
    if (config.timing.rounds > 5) shorter.emplace_back("--rounds 5");
    constexpr std::uint64_t k_long_sweep = 128 << 20;
    if (config.timing.cold && run::sweep_bytes(config.timing.sweep_mib) > k_long_sweep)
      shorter.emplace_back("--set timing.sweep_mib=64");
  }
  shorter.insert(shorter.end(), {"--filter TEXT", "--set 'scenes.*.frames=10'"});
  if (config.accuracy.check && !config.accuracy.most_pairs) shorter.emplace_back("--set accuracy.most_pairs=1000000");
  print_message(wait_text(number_of(plan.case_count(), "case"), all_s, shorter));
}

std::string command_line() {
  std::vector<std::string> words = os::own_command_line();
  if (!words.empty()) words.front() = "clusterbench";  // without the program's path
  return printable(shell_command(words));
}

// The ids of the plan's cases without those that an interrupted run has finished.
std::vector<std::string> ids_left(const run::Plan& plan, const std::vector<std::string>& done) {
  std::vector<std::string> ids;
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& case_plan : group.cases)
      if (std::find(done.begin(), done.end(), case_plan.id) == done.end()) ids.push_back(case_plan.id);
  return ids;
}

// Of them those whose method works on the processor: a device's instructions are not counted.
std::vector<std::string> ids_counted(const config::Config& config, const run::Plan& plan,
                                     const std::vector<std::string>& done) {
  std::vector<std::string> ids = ids_left(plan, done);
  for (const run::GroupPlan& group : plan.groups)
    for (const run::CasePlan& case_plan : group.cases)
      if (run::method_of(config, case_plan).on_device) std::erase(ids, case_plan.id);
  return ids;
}

// The files that the run reads. Throws Error if it would write to one of them, or to one file twice.
std::vector<std::string> inputs_kept(const RunFlags& flags, const config::Config& config) {
  std::vector<std::string> inputs = files_of(flags.inputs, config);
  const bool is_printed = flags.output.empty() && !is_for_reading(flags.output);
  std::vector<std::string> outputs{is_printed ? "-" : flags.output};
  if (!is_stream(flags.output)) outputs.push_back(report::partial_of(flags.output).string());
  std::error_code none;
  if (fs::is_directory(flags.images.folder, none)) outputs.push_back(PictureFiles::index_path(flags.images.folder));
  for (const std::string& text : flags.exports) outputs.push_back(text.substr(text.find('=') + 1));
  refuse_overwriting(outputs, inputs);
  return inputs;
}

bool is_left(const run::Plan& plan, const std::vector<std::string>& done) {
  return !ids_left(plan, done).empty();
}

run::Listener make_listener(ProgressLine& progress, report::Journal* journal, std::size_t earlier, std::size_t total) {
  run::Listener listener;
  listener.on_progress = [&progress](const run::Progress& now) { progress.show(now); };
  listener.on_case = [&progress, journal, number = earlier, total](const run::CaseResult& done) mutable {
    if (journal != nullptr) journal->add_case(run::record_of(done));
    progress.case_done(done, ++number, total);
  };
  listener.on_broken = [&progress, journal](const result::BrokenCase& broken) {
    if (journal != nullptr) journal->add_broken(broken);
    progress.clear();
    print_broken(broken.name, broken.reason);
  };
  return listener;
}

class MeasuredRun {
 public:
  // Checks gates and outputs before minutes of measuring.
  MeasuredRun(const RunFlags& flags, const config::Config& config, const run::Plan& plan,
              const std::vector<ExportTarget>& exports)
      : flags_(flags),
        config_(config),
        plan_(plan),
        gates_(config.limits, flags.filter),
        inputs_(inputs_kept(flags, config)),
        // If the output is a file, the journal probes it.
        output_(flags.output, !is_stream(flags.output) || is_for_reading(flags.output)),
        export_files_(exports, config.timing.measure) {
    if (!flags.images.folder.empty()) images_.emplace(flags.images, config, plan, inputs_);
  }

  std::optional<ExitCode> measure(CountWay way) {
    const std::atomic<bool>& stop = os::stop_on_signals();  // before there is anything to save
    const RunJournal journal(flags_, config_, plan_);
    const std::vector<result::BrokenCase> broken = broken_so_far(flags_, config_, plan_, journal);
    const std::vector<std::string> done = ids_done(journal, broken);
    const bool measures = is_left(plan_, done);
    run::Counts counts;
    if (way != CountWay::none && measures) {
      counts = counted(way, done, stop);
      if (stop) return journal.interrupted();
    }
    ProgressLine progress(screen_, flags_.quiet);
    run::Result fresh = measured(counts, journal, done, progress, stop);
    if (stop) return journal.interrupted();
    if (flags_.part.can_go_on && measures) {
      // Plug-ins are unloaded as this process ends, which is part of what they are measured by.
      os::leave_message(timing_facts(flags_.part.message, fresh));
      return std::nullopt;
    }
    if (flags_.part.can_go_on) set_timing_facts(flags_.part.message, fresh);
    if (!fresh.date.empty()) fresh.command = command_line();
    fresh.machine.host = host_digest(flags_, config_);
    result::Result result = report::record_of(fresh, journal.earlier_cases(), broken, config_.threads);
    if (!flags_.baseline.binary.empty() && !add_baseline(journal, progress, stop, result)) return journal.interrupted();
    return concluded(journal, stop, result);
  }

 private:
  static std::vector<std::string> ids_done(const RunJournal& journal, const std::vector<result::BrokenCase>& broken) {
    std::vector<std::string> ids = journal.earlier_ids();
    for (const result::BrokenCase& one : broken) ids.push_back(one.id);
    return ids;
  }

  // Counting comes first: errors are reported at once, and no timed work runs at the same time.
  run::Counts counted(CountWay way, const std::vector<std::string>& done, const std::atomic<bool>& stop) const {
    const CountTask task{config_, plan_, ids_counted(config_, plan_, done)};
    ProgressLine progress(screen_, flags_.quiet);
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

  run::Result measured(const run::Counts& counts, const RunJournal& journal, const std::vector<std::string>& earlier,
                       ProgressLine& progress, const std::atomic<bool>& stop) const {
    const run::Launcher launcher =
        config_.timing.launches > 1 ? make_launcher(config_, plan_, journal.file(), stop) : run::Launcher{};
    const run::Listener listener = make_listener(progress, journal.file(), earlier.size(), plan_.case_count());
    std::vector<run::GroupCost> costs;
    if (!flags_.quiet && flags_.part.number == 0) {
      costs = run::estimated_costs(config_, plan_);
      print_duration(config_, plan_, costs);
    }
    try {
      run::Result fresh = run::run_plan(config_, plan_, earlier, listener, stop, counts, launcher, costs);
      progress.clear();
      print_ended_cases(plan_, fresh);
      return fresh;
    } catch (const Error& error) {
      progress.clear();
      throw journal.with_saved_cases(error);
    }
  }

  // False if stopped.
  bool add_baseline(const RunJournal& journal, ProgressLine& progress, const std::atomic<bool>& stop,
                    result::Result& result) const {
    run::Progress now;
    now.cost_total = 1.0;
    const auto on_round = [&](const run::PairedRound& round) {
      now.doing = "beside " + flags_.baseline.binary + ", launch " + std::to_string(round.launch + 1);
      progress.show(now);
      now.cost_done += round.share;
    };
    try {
      measure_beside(flags_.baseline, plan_arguments(flags_), config_, plan_, on_round, stop, result);
    } catch (const Error& error) {
      progress.clear();
      if (!stop) throw journal.with_saved_cases(error);
    }
    progress.clear();
    return !stop;
  }

  // Writes all files and prints the result.
  ExitCode concluded(const RunJournal& journal, const std::atomic<bool>& stop, result::Result& result) {
    // Budgets are of all cases: `merge` holds them against all.
    const Verdicts verdicts = plan_.shard ? Verdicts() : verdicts_of(flags_.baseline, gates_, result);
    if (journal.is_kept())
      journal.file()->finish(result, config_.threads);
    else
      output_.write(result::to_json(result, config_.threads), config_.threads);
    export_files_.write(result);
    print_table(flags_, result);
    if (images_ && !images_->write(result, screen_, flags_.quiet, stop)) {
      print_message("interrupted; the result is complete, its pictures are not");
      return os::stopped_exit_code();
    }
    const ExitCode code = report_verdicts(verdicts, result);
    if (!flags_.quiet)
      print_next(result);
    else if (const std::size_t budgets = config_.limits.fail_if.size(); plan_.shard && budgets > 0)
      print_message("note: " + number_of(budgets, "budget") +
                    " (--fail-if) not decided in a shard; clusterbench merge decides");
    if (!result.cases.empty() || result.broken || plan_.case_count() == 0) return code;
    print_message("no case was measured to the end");  // a device ended them all
    return ExitCode::usage;
  }

  void print_next(const result::Result& result) const {
    if (plan_.shard)
      std::cerr << next_after_shard(*plan_.shard);
    else
      print_conclusion(flags_, result);
  }

  const RunFlags& flags_;
  const config::Config& config_;
  const run::Plan& plan_;
  Gates gates_;
  std::vector<std::string> inputs_;
  LaterOutput output_;
  ExportFiles export_files_;
  std::optional<PictureFiles> images_;
  os::Terminal screen_ = os::terminal(os::StandardStream::error);
};

}  // namespace

std::vector<std::string> plan_arguments(const RunFlags& flags) {
  std::vector<std::string> arguments;
  if (!flags.filter.empty()) arguments.push_back("--filter=" + flags.filter);
  for (const std::string& setting : setting_arguments(flags.inputs, {"--fail-if", "--launches"}))
    arguments.push_back(setting);
  arguments.emplace_back("--");
  arguments.insert(arguments.end(), flags.inputs.paths.begin(), flags.inputs.paths.end());
  return arguments;
}

std::optional<ExitCode> measure(const RunFlags& flags, const config::Config& config, const run::Plan& plan,
                                CountWay way, const std::vector<ExportTarget>& exports) {
  return MeasuredRun(flags, config, plan, exports).measure(way);
}

}  // namespace clusterbench::cli
