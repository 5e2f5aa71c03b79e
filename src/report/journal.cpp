#include "report/journal.h"

#include <unistd.h>

#include <fstream>
#include <functional>

#include "config/documents.h"
#include "config/schema_verdict.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "report/compact_json.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The first name of "PATH.1", "PATH.2" ... that is free.
fs::path free_name(const fs::path& path) {
  for (int number = 1;; ++number)
    if (fs::path name = path.string() + "." + std::to_string(number); !fs::exists(name)) return name;
}

// Where links lead; the file itself need not be there.
fs::path target_of(fs::path file) {
  constexpr int k_most_links = 40;  // as the system follows
  std::error_code failed;
  for (int count = 0; fs::is_symlink(file, failed); ++count) {
    if (count == k_most_links) throw Error(file.string(), "", "is a circle of links");
    const fs::path next = fs::read_symlink(file);
    file = next.is_absolute() ? next : file.parent_path() / next;
  }
  return file;
}

fs::path partial_of(const fs::path& file) {
  if (fs::is_directory(file)) throw Error(file.string(), "", "is a directory; name a file for the result");
  return file.string() + ".partial";
}

// Calls take(entry) for each line behind the header, which returns whether it is one that a run writes. Returns where
// the last whole line ends.
std::size_t each_entry(const std::string& text, const fs::path& path, const Json& header,
                       const std::function<bool(Json& entry)>& take) {
  std::size_t begin = 0;
  for (int number = 1; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // the line that was being written when the run ended
    Json entry = json_or_discarded<Json>(std::string_view(text).substr(begin, end - begin));
    const auto refuse = [&](const std::string& what) {
      throw Error(path.string(), "line " + std::to_string(number),
                  what + "; without --resume the run begins anew and the file is kept under another name");
    };
    if (number == 1 && (!entry.is_object() || !entry.contains("header"))) refuse("does not say what was run");
    if (number == 1 && entry["header"] != header)
      refuse("is an interrupted run of another configuration, --count, scene or build");
    if (number > 1 && !(entry.is_object() && take(entry))) refuse("is not what a run writes");
    begin = end + 1;
  }
  return begin;
}

}  // namespace

std::vector<std::string> finished_ids(const fs::path& file, const Json& header) {
  const fs::path partial = partial_of(target_of(file));
  std::vector<std::string> ids;
  if (!fs::exists(partial)) return ids;
  each_entry(file_text(partial.string()), partial, header, [&](const Json& entry) {
    if (const Json* id = value_at(entry, "/case/id"); id != nullptr && id->is_string()) ids.push_back(*id);
    return true;
  });
  return ids;
}

Journal::Journal(const fs::path& file, const Json& header, bool resume, std::uint64_t expected_bytes)
    : file_(target_of(file)), partial_(partial_of(file_)) {
  if (resume)
    read_earlier(header);
  else
    set_earlier_aside();
  partial_.check_room(expected_bytes);
  if (fs::exists(file_) && ::access(file_.c_str(), W_OK) != 0)
    throw Error(file_.string(), "", errno_says("cannot be written"));
  if (partial_.text().empty()) partial_.append(Json{{"header", header}}.dump() + '\n');
}

// A header alone holds nothing that was measured.
void Journal::set_earlier_aside() {
  const std::string text = partial_.text();
  const std::size_t header_end = text.find('\n');
  const bool is_header = json_or_discarded<Json>(std::string_view(text).substr(0, header_end)).contains("header");
  const bool has_more = header_end != std::string::npos && header_end + 1 < text.size();
  if (text.empty() || (is_header && !has_more)) {
    partial_.cut_to(0);
    return;
  }
  set_aside_ = free_name(partial_path());
  partial_.move_text_to(set_aside_);
}

void Journal::read_earlier(const Json& header) {
  const std::size_t end = each_entry(partial_.text(), partial_path(), header, [&](Json& entry) {
    if (!entry.contains("case")) return take_answer(entry);
    earlier_cases_.push_back(std::move(entry["case"]));
    return true;
  });
  check_earlier();
  partial_.cut_to(end);
}

void Journal::check_earlier() const {
  const nlohmann::json schema = config::result_schema();
  nlohmann::json cases_schema = schema["properties"]["cases"];
  cases_schema["definitions"] = schema["definitions"];  // which its parts refer to
  const std::vector<std::string> violations = config::schema_violations(cases_schema, nlohmann::json(earlier_cases_));
  if (!violations.empty())
    throw Error(partial_path().string(), "", "does not hold the cases of a run: " + violations.front());
}

std::vector<std::string> Journal::earlier_ids() const {
  std::vector<std::string> ids;
  for (const Json& finished : earlier_cases_) ids.push_back(finished.at("id").get<std::string>());
  return ids;
}

// The digest: what launches answer has no schema that could be checked.
bool Journal::take_answer(Json& entry) {
  if (!entry.is_object() || !entry.contains("request") || !entry.contains("answer")) return false;
  if (entry.value("sha256", Json()) != sha256_hex(entry["request"].dump() + entry["answer"].dump())) return false;
  earlier_answers_[entry["request"].dump()] = std::move(entry["answer"]);
  return true;
}

std::optional<Json> Journal::earlier_answer(const Json& request) const {
  const auto found = earlier_answers_.find(request.dump());
  return found == earlier_answers_.end() ? std::nullopt : std::optional(found->second);
}

void Journal::add_answer(const Json& request, const Json& answer) {
  const std::string digest = sha256_hex(request.dump() + answer.dump());
  add({{"request", request}, {"answer", answer}, {"sha256", digest}});
}

void Journal::add(const Json& entry) {
  has_added_ = true;
  partial_.append(entry.dump() + '\n');
}

void Journal::add_case(const Json& finished) {
  add({{"case", finished}});
}

void Journal::finish(const Json& result) {
  const fs::path fresh = file_.string() + ".new";
  {
    std::ofstream whole(fresh, std::ios::binary | std::ios::trunc);
    whole << compact_json(result) << std::flush;
    if (!whole)
      throw Error(fresh.string(), "",
                  errno_says("cannot be written") + "; the cases are kept in " + partial_path().string());
  }
  std::error_code failed;
  fs::rename(fresh, file_, failed);
  if (failed) throw Error(file_.string(), "", "cannot be replaced: " + failed.message());
  partial_.remove();
}

}  // namespace clusterbench::report
