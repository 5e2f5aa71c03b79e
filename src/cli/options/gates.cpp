#include "cli/options/gates.h"

#include <algorithm>
#include <iterator>

#include "cli/output/output.h"
#include "core/error.h"
#include "core/text.h"
#include "report/documents/result_file.h"
#include "report/gates/baseline_cases.h"
#include "report/gates/baseline_changes.h"
#include "report/gates/light_gate.h"

namespace clusterbench::cli {
namespace {

void print_findings(const report::LimitFindings& findings) {
  for (const std::string& line : findings.warnings) print_message("warning: " + line);
  for (const std::string& line : findings.unchecked) print_message("warning: " + line);
  for (const std::string& line : findings.near) print_message("warning: " + line);
  for (const std::string& line : findings.broken) print_message("FAILED " + line);
}

}  // namespace

void add_gate_options(Command& command, GateFlags& flags) {
  command.add_option(
      "--baseline", flags.baseline,
      "A result that budgets in percent are held against ('longest > +5 %'), and whose lights it has to have; "
      "which figures have changed since is told");
  command.add_flag("--allow-no-lights", flags.allows_no_lights,
                   "Does not fail where a scene has no lights, dark ones alone, or none is ever in view");
  command.add_flag("--allow-changed-lights", flags.allows_changed_lights,
                   "Lights may be others than those of the --baseline; what has changed is told");
}

void set_gates(config::Config& config, const GateFlags& flags) {
  nlohmann::json limits = nlohmann::json::object();
  if (!flags.baseline.empty()) limits["baseline"] = flags.baseline;
  if (flags.allows_no_lights) limits["allow_no_lights"] = true;
  if (flags.allows_changed_lights) limits["allow_changed_lights"] = true;
  if (limits.empty()) return;
  config = config::changed(config, {{"limits", limits}});
  if (!flags.baseline.empty()) config.limits.baseline = flags.baseline;  // not relative to the configuration's file
}

void keep_counted_budgets(config::Config& config, const std::string& doing) {
  constexpr const char* k_counted[] = {"index_entries",  "bytes",      "upload_bytes", "scratch_bytes",
                                       "longest",        "pairs",      "dropped",      "lights",
                                       "lights_in_view", "lights_lit", "lights_seen",  "lights_seen.mean"};
  const auto is_left_out = [&](const config::LimitRule& rule) {
    return rule.is_relative || std::ranges::find(k_counted, rule.figure) == std::end(k_counted);
  };
  std::vector<std::string> left_out;
  for (const config::LimitRule& rule : config.limits.fail_if)
    if (is_left_out(rule)) left_out.push_back("'" + rule.text() + "'");
  std::erase_if(config.limits.fail_if, is_left_out);
  config.limits.baseline.clear();
  if (left_out.empty()) return;
  print_message(
      "warning: of limits.fail_if " + doing + " does not look at " + joined(left_out) +
      ": it counts lists and lights alone, without times, truth, samples and a baseline; `clusterbench run` does");
}

Gates::Gates(const config::LimitsRequest& limits, const std::string& filter, const std::string& place)
    : limits_(limits), filter_(filter) {
  if (!limits_.baseline.empty()) base_ = report::read_result(place.empty() ? limits_.baseline.string() : place);
  for (const config::LimitRule& rule : limits_.fail_if)
    if (rule.is_relative && !base_)
      throw Error("", "limits.fail_if",
                  "'" + rule.text() +
                      "' is against a baseline, and there is none: add --baseline FILE (limits.baseline), " +
                      "a result of `clusterbench run`; a share is written without percent, 0.05");
}

std::string Gates::changes(const result::Result& result) const {
  if (!base_) return "";
  return report::baseline_changes_text(result, {*base_, result, filter_, limits_.baseline.string()});
}

std::vector<report::LimitFindings> Gates::findings(const result::Result& result) const {
  if (limits_.fail_if.empty() && !base_) return {};
  const std::string name = limits_.baseline.string();
  const result::Result* base = base_ ? &*base_ : nullptr;
  std::optional<report::BaselineCases> cases;
  if (base != nullptr) cases.emplace(*base, result, filter_, name);
  return {
      report::light_findings(result, {limits_.allows_no_lights, limits_.allows_changed_lights, base, name, filter_}),
      report::limit_findings(result, limits_.fail_if, cases ? &*cases : nullptr)};
}

ExitCode report_findings(const std::vector<report::LimitFindings>& findings) {
  bool is_broken = false;
  for (const report::LimitFindings& some : findings) {
    print_findings(some);
    is_broken |= !some.broken.empty();
  }
  return is_broken ? ExitCode::gate_failed : ExitCode::ok;
}

}  // namespace clusterbench::cli
