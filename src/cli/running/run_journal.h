#pragma once
// The cases that a run has finished, on disk (report/documents/journal.h), while others are still measured. --resume
// continues with them.

#include <memory>
#include <string>
#include <vector>

#include "cli/running/run_flags.h"
#include "config/config.h"
#include "core/error.h"
#include "report/documents/journal.h"
#include "run/cases/plan.h"

namespace clusterbench::cli {

// What makes two runs the same on any machine: version and commit of the program, filter, configuration without the
// keys that change no result, and the contents of scenes and plug-ins. Without the device.
nlohmann::ordered_json run_identity(const RunFlags& flags, const config::Config& config, const run::Plan& plan);

// Distinguishes machines whose times or instructions are not mixed, without the host's name; "" if the system does not
// tell it, and where nothing is timed or counted.
std::string host_digest(const RunFlags& flags, const config::Config& config);

// With --resume, the ids of the cases that an interrupted run of the same plan has finished; else none. Writes no file.
// Throws Error if the output is no file, and for a journal of another run.
std::vector<std::string> finished_ids(const RunFlags& flags, const config::Config& config, const run::Plan& plan);

// Of this run. If the output is a device or a pipe, which get the result at the end, there is no file, or, of a run
// with plug-ins, one in a folder that goes with the run.
class RunJournal {
 public:
  // Starts the file, or with --resume continues it, and prints which file of an earlier run it continues or moves
  // aside. Throws Error like report::Journal, and for --resume without a file.
  RunJournal(const RunFlags& flags, const config::Config& config, const run::Plan& plan);

  report::Journal* file() const { return journal_.get(); }  // nullptr: there is none
  // Whether it is beside the result's file, where it stays after an interruption.
  bool is_kept() const { return is_kept_; }

  // The cases of an interrupted run that this run continues.
  std::vector<result::Case> earlier_cases() const;
  std::vector<std::string> earlier_ids() const;
  // And those that broke in it.
  std::vector<result::BrokenCase> earlier_broken() const;

  // The same error; its message also names the file with the finished cases.
  Error with_saved_cases(const Error& error) const;
  // Prints that the run was interrupted and how to continue it. Returns the exit code.
  ExitCode interrupted() const;

 private:
  std::string saved_cases_text() const;

  std::unique_ptr<report::Journal> journal_;
  bool is_kept_ = false;
};

}  // namespace clusterbench::cli
