#pragma once
// A run with plug-ins that goes on after one of them has broken down.

#include <string>
#include <vector>

#include "cli/running/run_flags.h"
#include "cli/running/run_journal.h"
#include "run/runner.h"

namespace clusterbench::cli {

// Puts the cases in which the part before this one broke down into the journal, and prints them. Returns all broken
// cases of the run so far. Throws Error if it broke down in no case of this plan.
std::vector<result::BrokenCase> broken_so_far(const RunFlags& flags, const config::Config& config,
                                              const run::Plan& plan, const RunJournal& journal);

void print_broken(const std::string& names, const std::string& reason);

// The facts of a run that times depend on, as the parts that measured found them: passed on from part to part as text.
std::string timing_facts(const std::string& earlier, const run::Result& measured);
void set_timing_facts(const std::string& facts, run::Result& result);

}  // namespace clusterbench::cli
