#include "report/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "run/documents.h"
#include "run/schema_check.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string why() {
  return std::strerror(errno);
}

// Reserves the room and gives it back: a full disk shows itself before anything is measured.
void check_room(const fs::path& path, std::uint64_t bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) throw Error(path.string(), "", "cannot be written: " + why());
  off_t size = ::lseek(file, 0, SEEK_END);
  if (size < 0) size = 0;
  const int failed = ::posix_fallocate(file, size, static_cast<off_t>(bytes));
  const bool restored = ::ftruncate(file, size) == 0;
  ::close(file);
  if (failed == ENOSPC || failed == EDQUOT || failed == EFBIG || !restored)
    throw Error(path.string(), "", "no room on the disk for a result of about " + std::to_string(bytes >> 10) + " KiB");
}

}  // namespace

Journal::Journal(const fs::path& file, const Json& header, bool resume, std::uint64_t expected_bytes)
    : file_(file), partial_(file.string() + ".partial") {
  if (fs::is_directory(file_)) throw Error(file_.string(), "", "is a directory; name a file for the result");
  if (fs::exists(partial_)) read_earlier(header);
  if (!resume && !earlier_cases_.empty())
    throw Error(partial_.string(), "",
                "holds " + std::to_string(earlier_cases_.size()) +
                    " finished cases of an interrupted run; add --resume to go on, or remove it to start again");
  check_room(partial_, expected_bytes);
  if (fs::exists(file_) && ::access(file_.c_str(), W_OK) != 0)
    throw Error(file_.string(), "", "cannot be written: " + why());
  begin_partial(header);
}

// Earlier cases are copied to a new file that then takes the old one's place, so that no crash can lose them.
void Journal::begin_partial(const Json& header) {
  const fs::path fresh = partial_.string() + ".new";
  out_.open(fresh, std::ios::binary | std::ios::trunc);
  append(Json{{"header", header}});
  for (const Json& finished : earlier_cases_) add_case(finished);
  std::error_code failed;
  fs::rename(fresh, partial_, failed);  // the open stream follows the file
  if (failed) throw Error(partial_.string(), "", "cannot be replaced: " + failed.message());
}

void Journal::read_earlier(const Json& header) {
  std::ifstream in(partial_, std::ios::binary);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    Json entry = Json::parse(line, nullptr, false);
    if (entry.is_discarded() && in.eof()) break;  // the line that was being written when the run ended
    const auto refuse = [&](const std::string& what) {
      throw Error(partial_.string(), "line " + std::to_string(number), what + "; remove the file to start again");
    };
    if (!entry.is_object() || !entry.contains(number == 1 ? "header" : "case"))
      refuse(number == 1 ? "does not say what was run" : "is not what a run writes");
    if (number > 1)
      earlier_cases_.push_back(std::move(entry["case"]));
    else if (entry["header"] != header)
      refuse("is an interrupted run of another configuration, --count, scene or build");
  }
  check_earlier();
}

void Journal::check_earlier() const {
  const nlohmann::json cases_schema = run::result_schema()["properties"]["cases"];
  const std::vector<std::string> violations = run::schema_violations(cases_schema, nlohmann::json(earlier_cases_));
  if (!violations.empty())
    throw Error(partial_.string(), "",
                "does not hold the cases of a run: " + violations.front() + "; remove it to start again");
}

std::vector<std::string> Journal::earlier_ids() const {
  std::vector<std::string> ids;
  for (const Json& finished : earlier_cases_) ids.push_back(finished.at("id").get<std::string>());
  return ids;
}

void Journal::append(const Json& line) {
  out_ << line.dump() << '\n' << std::flush;
  if (!out_) throw Error(partial_.string(), "", "cannot be written: " + why(), ExitCode::interrupted);
}

void Journal::add_case(const Json& finished) {
  append(Json{{"case", finished}});
}

void Journal::finish(const Json& result) {
  const fs::path fresh = file_.string() + ".new";
  {
    std::ofstream whole(fresh, std::ios::binary | std::ios::trunc);
    whole << result.dump(1) << '\n' << std::flush;
    if (!whole)
      throw Error(fresh.string(), "", "cannot be written: " + why() + "; the cases are kept in " + partial_.string());
  }
  std::error_code failed;
  fs::rename(fresh, file_, failed);
  if (failed) throw Error(file_.string(), "", "cannot be replaced: " + failed.message());
  out_.close();
  fs::remove(partial_, failed);
}

}  // namespace clusterbench::report
