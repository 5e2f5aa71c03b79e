#pragma once
// Results on disk while they come in: FILE.partial has a header line and a line per finished case, each
// written at once, so that a crash loses at most the case at hand. finish() replaces FILE in one step. Where FILE is a
// link, all this is at its target, and the link stays.

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "report/locked_file.h"

namespace clusterbench::report {

class Journal {
 public:
  // Starts FILE.partial, or with `resume` goes on with it. `header` says what is being run: an interrupted run
  // continues only under an equal header. Without `resume` what an earlier run left is set aside. `expected_bytes`:
  // about how large the result will be; a disk without that much room is an Error now, not later. Throws Error, too, if
  // it cannot be written there, if another run is writing there, and with `resume` if what lies there is not what a
  // run writes but for its last line.
  Journal(const std::filesystem::path& file, const nlohmann::ordered_json& header, bool resume,
          std::uint64_t expected_bytes);

  // Cases that an interrupted run had finished.
  const std::vector<nlohmann::ordered_json>& earlier_cases() const { return earlier_cases_; }
  std::vector<std::string> earlier_ids() const;

  // Where the finished cases of an earlier run are now; "" if there were none, or if this run goes on with them.
  const std::filesystem::path& set_aside() const { return set_aside_; }

  void add_case(const nlohmann::ordered_json& finished);

  // Writes the whole result and removes FILE.partial.
  void finish(const nlohmann::ordered_json& result);

  const std::filesystem::path& partial_path() const { return partial_.path(); }

 private:
  void set_earlier_aside();
  void read_earlier(const nlohmann::ordered_json& header);
  void check_earlier() const;

  std::filesystem::path file_, set_aside_;
  LockedFile partial_;
  std::vector<nlohmann::ordered_json> earlier_cases_;
};

}  // namespace clusterbench::report
