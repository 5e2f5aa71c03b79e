#pragma once
// Results on disk while they arrive: FILE.partial has a header line, a line per finished or broken case and, for cases
// that are timed in several launches, a line per answer of a launch. Each line ends with a digest of itself and is
// written immediately, so a crash loses at most the current measurement. finish() replaces FILE atomically. If FILE is
// a link, all this happens at its target, and the link stays.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "os/locked_file.h"
#include "result/result.h"

namespace clusterbench::report {

// FILE.partial, beside the target of FILE. Throws Error for a folder.
std::filesystem::path partial_of(const std::filesystem::path& file);

// The ids of the finished and broken cases of an interrupted run, as Journal with `resume` finds them; writes no file.
std::vector<std::string> finished_ids(const std::filesystem::path& file, const nlohmann::ordered_json& header);

class Journal {
 public:
  // Starts FILE.partial, or with `resume` continues it. `header` describes the run: an interrupted run continues only
  // with an equal header. Without `resume` the file of an earlier run is moved aside, and with it if the headers differ
  // in "machine" (and "device") alone: times of two machines are not mixed. `expected_bytes`: estimated size
  // of the result; too little disk space is an Error now, not later. Throws Error as well if the file cannot be
  // written, if another run is writing it, and with `resume` if the file has a line, other than the last, that no run
  // writes.
  Journal(const std::filesystem::path& file, const nlohmann::ordered_json& header, bool resume,
          std::uint64_t expected_bytes);
  // Removes FILE.partial if it contains no measurement.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // The finished cases of an interrupted run.
  const std::vector<result::Case>& earlier_cases() const { return earlier_cases_; }
  std::vector<std::string> earlier_ids() const;
  // Its broken cases; one can be a finished case, too.
  const std::vector<result::BrokenCase>& earlier_broken() const { return earlier_broken_; }

  // The file with the finished cases of an earlier run; "" if there were none, or if this run continues with them.
  const std::filesystem::path& set_aside() const { return set_aside_; }
  // Whether that was left by a run, and whether on another machine.
  bool is_set_aside_of_run() const { return is_set_aside_of_run_; }
  bool is_set_aside_of_other_machine() const { return is_set_aside_of_other_machine_; }

  void add_case(const result::Case& finished);
  void add_broken(const result::BrokenCase& broken);

  // The answer of a launch to a request, in an interrupted run.
  std::optional<nlohmann::ordered_json> earlier_answer(const nlohmann::ordered_json& request) const;
  void add_answer(const nlohmann::ordered_json& request, const nlohmann::ordered_json& answer);

  // Contains no measurement of this run or of an interrupted one.
  bool is_empty() const {
    return earlier_cases_.empty() && earlier_broken_.empty() && earlier_answers_.empty() && !has_added_;
  }

  // Writes the whole result, which `threads` bring into JSON, and removes FILE.partial.
  void finish(const result::Result& result, int threads = 1);

  const std::filesystem::path& partial_path() const { return partial_.path(); }

 private:
  void set_earlier_aside(const std::string& header);
  void read_earlier(const nlohmann::ordered_json& header);
  void add(const nlohmann::ordered_json& entry);
  bool accept_answer(nlohmann::ordered_json& entry);

  std::filesystem::path file_, set_aside_;
  bool is_set_aside_of_run_ = false, is_set_aside_of_other_machine_ = false;
  os::LockedFile partial_;
  bool has_added_ = false, is_finished_ = false;
  std::vector<result::Case> earlier_cases_;
  std::vector<result::BrokenCase> earlier_broken_;
  std::map<std::string, nlohmann::ordered_json> earlier_answers_;  // by their requests
};

}  // namespace clusterbench::report
