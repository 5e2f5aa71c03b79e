#include "cli/processes/baseline_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/processes/rounds_protocol.h"
#include "core/error.h"
#include "core/file_text.h"
#include "report/results/baseline_rounds.h"
#include "run/passes/timing_pass.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;

// As many rounds as a run without a baseline program, but enough for a quartile of each launch
// (measure::launch_log_ratio).
int paired_rounds_per_launch(const config::Config& config, int launches) {
  constexpr int k_least = 4;
  return std::max(k_least, run::rounds_per_launch(config.timing, launches));
}

// An interval of half the threshold on each side is enough to distinguish a change of 1.5 times the threshold from one
// of the threshold.
run::PairedRequest paired_request(const BaselineRequest& request, const config::Config& config) {
  return {request.launches, request.most_launches, std::log1p(0.5 * request.threshold_percent / 100.0),
          paired_rounds_per_launch(config, request.launches)};
}

std::vector<std::string> server_command(const std::string& binary, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{binary, "run", "--rounds-server=" + std::to_string(k_rounds_protocol)};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

result::Tool tool_in(const nlohmann::ordered_json& json, const std::string& binary) {
  try {
    return result::from_json<result::Tool>(json);
  } catch (const Error& error) {
    throw Error(binary, "--baseline-binary", std::string("says of itself what cannot be read: ") + error.what());
  }
}

bool are_same_bytes(const fs::path& a, const fs::path& b) {
  std::error_code unknown;
  if (!fs::is_regular_file(a, unknown) || fs::file_size(a, unknown) != fs::file_size(b, unknown)) return false;
  return file_text(a) == file_text(b);
}

// The cases that are measured: not those that broke.
run::Plan plan_of_measured(const run::Plan& plan, const result::Result& result) {
  run::Plan out;
  out.groups = plan.groups;
  for (run::GroupPlan& group : out.groups)
    std::erase_if(group.cases, [&](const run::CasePlan& one) {
      return std::ranges::find(result.cases, one.id, &result::Case::id) == result.cases.end();
    });
  return out;
}

// After the end of a program at a case of a plug-in: takes the cases of the same method out of the plan, and fails them
// in the result. False if the case is of no plug-in: then all of the comparison is lost.
bool go_on_without(const ProgramEnded& end, const config::Config& config, run::Plan& plan, result::Result& result) {
  for (run::GroupPlan& group : plan.groups) {
    const auto ended = std::ranges::find(group.cases, end.case_id(), &run::CasePlan::id);
    if (ended == group.cases.end()) continue;
    if (run::method_of(config, *ended).plugin.empty()) return false;
    const run::Method method = ended->method();
    for (result::Case& one : result.cases) {
      const auto planned = std::ranges::find(group.cases, one.id, &run::CasePlan::id);
      if (planned == group.cases.end() || planned->method() != method) continue;
      one.failures.push_back(
          {end.has_timed_out() ? "timed_out" : "crashed", std::string("not compared: ") + end.what()});
      one.eligible = false;
    }
    std::erase_if(group.cases, [&](const run::CasePlan& one) { return one.method() == method; });
    return true;
  }
  return false;
}

std::map<std::string, run::PairedCase> measured_beside(const config::Config& config, run::Plan plan,
                                                       const run::PairedRequest& request, const run::PairedStart& both,
                                                       const run::OnPairedRound& on_round, result::Result& result) {
  while (plan.case_count() > 0) {
    try {
      return run::measure_paired(plan, request, both, on_round);
    } catch (const ProgramEnded& end) {
      if (!go_on_without(end, config, plan, result)) throw;
    }
  }
  return {};
}

}  // namespace

void probe_baseline(const BaselineRequest& request, const std::vector<std::string>& arguments,
                    const std::atomic<bool>& stop) {
  const RemoteProgram probe(server_command(fs::absolute(request.binary).string(), arguments), request.timeout_s, stop);
}

void measure_beside(const BaselineRequest& request, const std::vector<std::string>& arguments,
                    const config::Config& config, const run::Plan& plan, const run::OnPairedRound& on_round,
                    const std::atomic<bool>& stop, result::Result& result) {
  nlohmann::ordered_json tool;
  const auto start = [&](const std::string& binary) {
    return std::make_unique<RemoteProgram>(server_command(binary, arguments), request.timeout_s, stop);
  };
  const std::string other = fs::absolute(request.binary).string();
  const run::PairedStart both{[&] {
                                auto program = start(other);
                                tool = program->tool();
                                return program;
                              },
                              [&] { return start(os::this_program()); }};
  try {
    const std::map<std::string, run::PairedCase> measured = measured_beside(
        config, plan_of_measured(plan, result), paired_request(request, config), both, on_round, result);
    report::add_baseline(result, tool_in(tool, request.binary), measured);
    if (are_same_bytes(other, os::this_program())) result.baseline->is_same_program = true;
  } catch (const nlohmann::json::exception& error) {
    throw Error(request.binary, "--baseline-binary", std::string("answered what cannot be read: ") + error.what());
  }
}

}  // namespace clusterbench::cli
