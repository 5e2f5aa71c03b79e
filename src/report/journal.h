#pragma once
// Results on disk while they come in: FILE.partial has a header line and a line per finished case, each
// flushed as it is written, so that a crash loses at most the case at hand. finish() replaces FILE in one step.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace clusterbench::report {

class Journal {
 public:
  // Starts FILE.partial. `header` says what is being run: an interrupted run continues only under an equal header.
  // `expected_bytes`: about how large the result will be; a disk without that much room is an Error now, not later.
  // Throws Error if the place cannot be written, if an interrupted run's finished cases lie there and `resume` is
  // false, and if what lies there is not what a run writes but for its last line.
  Journal(const std::filesystem::path& file, const nlohmann::ordered_json& header, bool resume,
          std::uint64_t expected_bytes);

  // Cases that an interrupted run had finished.
  const std::vector<nlohmann::ordered_json>& earlier_cases() const { return earlier_cases_; }
  std::vector<std::string> earlier_ids() const;

  void add_case(const nlohmann::ordered_json& finished);

  // Writes the whole result and removes FILE.partial.
  void finish(const nlohmann::ordered_json& result);

  const std::filesystem::path& partial_path() const { return partial_; }

 private:
  void read_earlier(const nlohmann::ordered_json& header);
  void check_earlier() const;
  void begin_partial(const nlohmann::ordered_json& header);
  void append(const nlohmann::ordered_json& line);

  std::filesystem::path file_, partial_;
  std::ofstream out_;
  std::vector<nlohmann::ordered_json> earlier_cases_;
};

}  // namespace clusterbench::report
