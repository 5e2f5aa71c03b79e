#pragma once
// Cases of plug-ins that cannot be measured to the end.

#include <optional>
#include <string>
#include <vector>

#include "assign/contract/method_error.h"
#include "os/call_notes.h"
#include "result/broken_case.h"
#include "run/cases/plan.h"

namespace clusterbench::run {

// The end of a method, as result::BrokenCase describes it.
struct Breakdown {
  std::string kind, reason;
  os::CallStep step = os::CallStep::assign;
  int frame = -1;  // of the path; -1: of none
  std::string pass, signal;
};

// "frame 12": of a call, "" where it is of none.
std::string frame_text(int frame);

// The other plug-ins that can be what a fault is of, if it is one of memory: "; the plug-in acme ran before ...". ""
// without any. `made`: os::codes_that_made().
std::string suspects_text(const std::vector<std::string>& made, const std::string& blamed);

result::BrokenCase broken_case(const config::Config& config, const Plan& plan, const CasePlan& case_plan,
                               const Breakdown& breakdown);
// Of a method that failed in the last call of this thread.
Breakdown breakdown_of(const assign::MethodError& error, const std::string& plugin);

}  // namespace clusterbench::run
