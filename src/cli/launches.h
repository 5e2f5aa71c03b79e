#pragma once
// A run that times in several processes: each launch is this program again, asked for one group after the other. A
// request and its answer are each a line of JSON; the greeting is one, too.

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "run/runner.h"

namespace clusterbench::cli {

// Answers on standard output what comes on standard input, to its end.
void serve_launch(const config::Config& config, const run::Plan& plan);

// Starts this program with `arguments`, which make the plan in it, too, for each launch. It throws Error where a launch
// breaks down. Once `stop` is true it gives fewer groups.
run::Launcher make_launcher(std::vector<std::string> arguments, const std::atomic<bool>& stop);

}  // namespace clusterbench::cli
