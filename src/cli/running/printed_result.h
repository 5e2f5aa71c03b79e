#pragma once
// The part of a result that `run` prints: on standard output if a person reads it there, else on standard error.

#include "cli/running/run_flags.h"
#include "result/result.h"

namespace clusterbench::cli {

// The table with its warnings; with --quiet only the warnings.
void print_table(const RunFlags& flags, const result::Result& result);

// The recommendation of each view, and the command that sizes its buffers; of a failed run only that it recommends
// nothing. Printed last, after the warnings.
void print_conclusion(const RunFlags& flags, const result::Result& result);

}  // namespace clusterbench::cli
