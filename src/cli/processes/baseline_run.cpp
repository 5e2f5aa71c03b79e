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
                              [&] { return start(os::k_this_program); }};
  try {
    const std::map<std::string, run::PairedCase> measured =
        run::measure_paired(plan, paired_request(request, config), both, on_round);
    report::add_baseline(result, tool_in(tool, request.binary), measured);
    if (are_same_bytes(other, os::k_this_program)) result.baseline->is_same_program = true;
  } catch (const nlohmann::json::exception& error) {
    throw Error(request.binary, "--baseline-binary", std::string("answered what cannot be read: ") + error.what());
  }
}

}  // namespace clusterbench::cli
