#pragma once
// What a run is held against when it is done: budgets, an earlier result, and the lights that it should have.

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

// The configuration with what the flags say.
void set_gates(config::Config& config, const GateFlags& flags);

// Of what only counts frames (`size`): leaves the budgets of figures that it has, and tells of the others, which `run`
// holds. `doing`: the name of the command.
void keep_counted_budgets(config::Config& config, const std::string& doing);

class Gates {
 public:
  // Reads the baseline, so that what is wrong with it is known before minutes go into measuring. Throws Error for a
  // budget in percent without one.
  Gates(const config::Config& config, const std::string& filter);

  // Which figures have changed since the baseline; "" without one.
  std::string changes(const result::Result& result) const;
  // What holds and what does not: of the lights, then of the budgets. Nothing without budgets and baseline.
  std::vector<report::LimitFindings> findings(const result::Result& result) const;

 private:
  const config::LimitsRequest& limits_;
  std::string filter_;
  std::optional<result::Result> base_;
};

// Tells them.
ExitCode report_findings(const std::vector<report::LimitFindings>& findings);

}  // namespace clusterbench::cli
