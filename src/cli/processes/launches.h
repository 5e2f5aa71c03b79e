#pragma once
// A run that times in several processes: each launch is this program again, which receives one request per group. A
// request and its answer are each a line of JSON, like the handover before them and the greeting.

#include <atomic>
#include <string>
#include <vector>

#include "report/documents/journal.h"
#include "run/runner.h"

namespace clusterbench::cli {

inline constexpr const char* k_serve_launch = "--serve-launch";

// The group of exactly these cases, in this order: samples are identified by their position. If several scenes have a
// case, a number after its id selects one; a launch has one scene and no such numbers.
run::GroupPlan group_to_measure(const run::Plan& plan, const std::vector<std::string>& ids);

// Answers requests from standard input on standard output, until the input ends.
void serve_launch(const config::Config& config, const run::Plan& plan);

// Starts this program for each launch. Throws Error if a launch breaks down. Once `stop` is true it returns fewer
// groups. Samples of an interrupted run are read from `journal` (none: nullptr), and new ones are written to it. All
// must outlive the launcher.
run::Launcher make_launcher(const config::Config& config, const run::Plan& plan, report::Journal* journal,
                            const std::atomic<bool>& stop);

}  // namespace clusterbench::cli
