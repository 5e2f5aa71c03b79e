#pragma once
// The checks of a finished run: budgets, an earlier result, and lights that must be present.

#include <optional>
#include <string>
#include <vector>

#include "cli/command_line/command.h"
#include "config/config.h"
#include "core/error.h"
#include "report/gates/limits.h"
#include "result/result.h"

namespace clusterbench::cli {

struct GateFlags {
  std::string baseline;  // a result file; "": none, or that of the configuration
  bool allows_no_lights = false, allows_changed_lights = false;
};
void add_gate_options(Command& command, GateFlags& flags);

// Applies the flags to the configuration.
void set_gates(config::Config& config, const GateFlags& flags);

// For commands that only count frames (`size`): keeps the budgets of figures that they have, and reports the others,
// which `run` checks. `doing`: the name of the command.
void keep_counted_budgets(config::Config& config, const std::string& doing);

class Gates {
 public:
  // Reads the baseline, so that the user learns of errors in it before minutes of measuring. Throws Error for a budget
  // in percent without a baseline. `limits` must outlive this object. `place`: where the baseline lies, if it is not
  // there where messages say that it is; "": it is.
  Gates(const config::LimitsRequest& limits, const std::string& filter, const std::string& place = "");

  // The figures that have changed since the baseline; "" without one.
  std::string changes(const result::Result& result) const;
  // Findings about lights, then about budgets. Empty without budgets and baseline.
  std::vector<report::LimitFindings> findings(const result::Result& result) const;

 private:
  const config::LimitsRequest& limits_;
  std::string filter_;
  std::optional<result::Result> base_;
};

// Prints them.
ExitCode report_findings(const std::vector<report::LimitFindings>& findings);

}  // namespace clusterbench::cli
