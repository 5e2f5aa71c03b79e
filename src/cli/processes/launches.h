#pragma once
// A run that times in several processes: each launch is this program again, asked for one group after the other. A
// request and its answer are each a line of JSON; what is handed over before them and the greeting are one, too.

#include <atomic>
#include <string>
#include <vector>

#include "report/documents/journal.h"
#include "run/runner.h"

namespace clusterbench::cli {

inline constexpr const char* k_serve_launch = "--serve-launch";

// The group of these cases and no others, in this order: samples are told apart by their places. A case that several
// scenes have is told apart by a number behind its id; a launch has one scene and no such numbers.
run::GroupPlan group_to_measure(const run::Plan& plan, const std::vector<std::string>& ids);

// Answers on standard output what comes on standard input, to its end.
void serve_launch(const config::Config& config, const run::Plan& plan);

// Starts this program for each launch. It throws Error where a launch breaks down. Once `stop` is true it gives fewer
// groups. What an interrupted run has measured is taken from `journal` (none: nullptr), and what is measured goes
// there. All outlive it.
run::Launcher make_launcher(const config::Config& config, const run::Plan& plan, report::Journal* journal,
                            const std::atomic<bool>& stop);

}  // namespace clusterbench::cli
