#pragma once
// Results on disk while they come in: FILE.partial has a header line, a line per finished case and, of cases that are
// timed in several launches, a line for what a launch has answered. Each is written at once, so that a crash loses at
// most what is measured at that moment. finish() replaces FILE in one step. Where FILE is a link, all this is at its
// target, and the link stays.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "os/locked_file.h"
#include "result/result.h"

namespace clusterbench::report {

// FILE.partial, beside what FILE leads to. Throws Error for a folder.
std::filesystem::path partial_of(const std::filesystem::path& file);

// The ids of the cases that an interrupted run has finished, as Journal with `resume` finds them; nothing is written.
std::vector<std::string> finished_ids(const std::filesystem::path& file, const nlohmann::ordered_json& header);

class Journal {
 public:
  // Starts FILE.partial, or with `resume` goes on with it. `header` says what is being run: an interrupted run
  // continues only under an equal header. Without `resume` what an earlier run left is set aside. `expected_bytes`:
  // about how large the result will be; a disk without that much room is an Error now, not later. Throws Error, too, if
  // it cannot be written there, if another run is writing there, and with `resume` if what lies there is not what a
  // run writes but for its last line.
  Journal(const std::filesystem::path& file, const nlohmann::ordered_json& header, bool resume,
          std::uint64_t expected_bytes);
  // Removes FILE.partial if nothing that was measured is in it.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // Cases that an interrupted run had finished.
  const std::vector<result::Case>& earlier_cases() const { return earlier_cases_; }
  std::vector<std::string> earlier_ids() const;

  // Where the finished cases of an earlier run are now; "" if there were none, or if this run goes on with them.
  const std::filesystem::path& set_aside() const { return set_aside_; }

  void add_case(const result::Case& finished);

  // What a launch has answered to a request, in an interrupted run.
  std::optional<nlohmann::ordered_json> earlier_answer(const nlohmann::ordered_json& request) const;
  void add_answer(const nlohmann::ordered_json& request, const nlohmann::ordered_json& answer);

  // Nothing that was measured is in it, now or in an interrupted run.
  bool is_empty() const { return earlier_cases_.empty() && earlier_answers_.empty() && !has_added_; }

  // Writes the whole result and removes FILE.partial.
  void finish(const result::Result& result);

  const std::filesystem::path& partial_path() const { return partial_.path(); }

 private:
  void set_earlier_aside(const std::string& header);
  void read_earlier(const nlohmann::ordered_json& header);
  void add(const nlohmann::ordered_json& entry);
  bool take_answer(nlohmann::ordered_json& entry);

  std::filesystem::path file_, set_aside_;
  os::LockedFile partial_;
  bool has_added_ = false, is_finished_ = false;
  std::vector<result::Case> earlier_cases_;
  std::map<std::string, nlohmann::ordered_json> earlier_answers_;  // by their requests
};

}  // namespace clusterbench::report
