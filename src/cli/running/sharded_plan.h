#pragma once
// `run --shard I/N`: the shard's part of the plan, and what identifies the whole run to `merge`.

#include <string>

#include "cli/options/shard_choice.h"
#include "cli/running/run_flags.h"
#include "config/config.h"
#include "run/cases/plan.h"

namespace clusterbench::cli {

// The part of the whole plan that this shard measures; it can be empty. Throws Error if the output file has another
// shard's result, which would be lost.
run::Plan sharded_plan(const RunFlags& flags, const config::Config& config, run::Plan plan, const ShardChoice& choice);

// Prints how many cases each shard takes, and how long this machine would take for them.
void print_shards(const config::Config& config, const run::Plan& plan, const ShardChoice& choice);

// "shard 2 of 7 is done; ...": the last line of such a run.
std::string next_after_shard(const run::PlannedShard& shard);

}  // namespace clusterbench::cli
