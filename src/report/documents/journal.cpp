#include "report/documents/journal.h"

#include <functional>
#include <initializer_list>
#include <set>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "os/output_file.h"
#include "report/cases/json_values.h"
#include "report/documents/compact_json.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The start of each line of a run, which also holds for the rest that a crashed program left.
bool begins_as_an_entry(std::string_view line) {
  for (const std::string_view start : {R"({"case":)", R"({"broken":)", R"({"request":)"})
    if (line.starts_with(start) || start.starts_with(line)) return true;
  return line.find_first_not_of('\0') == std::string_view::npos;  // zeros after a power failure
}

// The end of a line: the digest of all that stands before it.
std::string seal_of(std::string_view text) {
  return R"(,"sha256":")" + sha256_hex(text) + R"("})";
}

std::string sealed_line(const Json& entry) {
  std::string text = entry.dump();
  text.pop_back();  // its brace, which the seal has
  return text + seal_of(text) + '\n';
}

bool is_sealed(std::string_view line) {
  const std::size_t begin = line.rfind(R"(,"sha256":")");
  return begin != std::string_view::npos && line.substr(begin) == seal_of(line.substr(0, begin));
}

std::string header_line(const Json& header) {
  return sealed_line({{"header", header}});
}

// A single header line, of this program or an older one.
bool is_header_alone(std::string_view text) {
  if (!text.ends_with('\n') || text.find('\n') + 1 != text.size()) return false;
  const Json line = json_or_discarded<Json>(text);
  return line.is_object() && line.size() == (line.contains("sha256") ? 2 : 1) && line.contains("header") &&
         line["header"].is_object() && line["header"].contains("config");
}

// Whether a line contains a case with an id that is not in `ids` yet; adds the id.
bool accepts_case(const Json& entry, std::set<std::string>& ids) {
  const Json* id = value_at(entry, "/case/id");
  return id != nullptr && ids.insert(id->dump()).second;
}

bool is_broken_case(const Json& entry) {
  return value_at(entry, "/broken/id") != nullptr;
}

Json without(Json header, std::initializer_list<const char*> keys) {
  for (const char* key : keys) header.erase(key);
  return header;
}

// Of a file of a run that is the same but for the machine.
bool is_of_other_machine(const std::string& text, const Json& header) {
  const Json first = json_or_discarded<Json>(std::string_view(text).substr(0, text.find('\n')));
  const Json* earlier = value_at(first, "/header");
  return earlier != nullptr && earlier->is_object() && header.is_object() && earlier->contains("machine") &&
         header.contains("machine") && (*earlier)["machine"] != header["machine"] &&
         without(*earlier, {"machine", "device"}) == without(header, {"machine", "device"});
}

std::string device_name(const Json& header) {
  if (!header.contains("device")) return "no device";
  const Json* name = value_at(header, "/device/name");
  return name != nullptr && name->is_string() ? name->get<std::string>() : "a device without a name";
}

// The reason why a run cannot go on if nothing but its device differs, since a result is of one; "" if it is the same.
std::string other_device(const Json& earlier, const Json& now) {
  if (!earlier.is_object() || !now.is_object() || earlier == now ||
      without(earlier, {"device"}) != without(now, {"device"}))
    return "";
  const bool has_one_name = device_name(earlier) == device_name(now);
  return "is an interrupted run on " + device_name(earlier) + ", and this one is on " +
         (has_one_name ? "another device or driver of that name" : device_name(now)) +
         "; --device NAME takes the same one, where it is there";
}

// The first setting that differs between two configurations, or the first scene whose contents do; "" if none is known.
std::string first_change(const Json& earlier, const Json& now, const std::string& key) {
  if (key == "config") {
    const FirstDifference found = first_difference(earlier.value(key, Json()), now.value(key, Json()));
    return found.pointer.empty() ? "" : found.pointer + " was " + found.of_one + ", is " + found.of_other;
  }
  const Json scenes = now.value(key, Json::array());
  const Json* entries = value_at(now, "/config/scenes");
  const bool has_entry_each = entries != nullptr && entries->size() == scenes.size();  // not with `paths` of several
  for (std::size_t i = 0; key == "scenes" && has_entry_each && i < scenes.size(); ++i) {
    const std::string at = "/" + std::to_string(i);
    const Json *before = value_at(earlier, "/scenes" + at), *path = value_at(now, "/config/scenes" + at + "/path");
    if (path != nullptr && path->is_string() && (before == nullptr || *before != scenes[i]))
      return printable(path->get<std::string>());
  }
  return "";
}

// What differs between two runs, for the user.
std::vector<std::string> differences(const Json& earlier, const Json& now) {
  const std::pair<const char*, const char*> parts[] = {
      {"version", "build"},   {"git_sha", "build"},  {"flags", "build"},     {"config", "configuration"},
      {"filter", "--filter"}, {"shard", "--shard"},  {"count", "--count"},   {"scenes", "scene"},
      {"plugins", "plug-in"}, {"methods", "shader"}, {"machine", "machine"}, {"device", "device"}};
  std::vector<std::string> out;
  for (const auto& [key, name] : parts)
    if (earlier.value(key, Json()) != now.value(key, Json()) && (out.empty() || out.back() != name)) {
      const std::string change = first_change(earlier, now, key);
      out.emplace_back(name + (change.empty() ? "" : " (" + change + ")"));
    }
  if (out.empty()) out.emplace_back("build");  // that writes other facts
  return out;
}

// Calls accept(entry) for each line after the header; it returns false for a line that no run writes. Returns the end
// of the last complete line.
std::size_t each_entry(const std::string& text, const fs::path& path, const Json& header,
                       const std::function<bool(Json& entry)>& accept) {
  std::size_t begin = 0;
  for (int number = 1; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    const bool is_cut = end == std::string::npos;  // the line that was being written when the run ended
    if (is_cut && number > 1 && begins_as_an_entry(std::string_view(text).substr(begin))) break;
    if (is_cut && number == 1 && header_line(header).starts_with(text)) break;
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    Json entry = json_or_discarded<Json>(line);
    const auto refuse = [&](const std::string& what) {
      throw Error(path.string(), "line " + std::to_string(number),
                  what + "; without --resume the run begins anew and the file is kept under another name");
    };
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) refuse("is empty; remove it to go on");
    if (is_cut) refuse("is not what a run writes");
    const Json* const earlier = value_at(entry, "/header");
    if (number == 1 && (earlier == nullptr || !earlier->is_object())) refuse("does not say what was run");
    if (number == 1)
      if (const std::string other = other_device(entry["header"], header); !other.empty()) refuse(other);
    if (number == 1 && entry["header"] != header)
      refuse("is an interrupted run of another " + joined(differences(entry["header"], header), " and "));
    if (entry.is_object() && !is_sealed(line)) refuse("is not what a run writes; it was changed");
    if (number > 1 && !(entry.is_object() && accept(entry)))
      refuse(value_at(entry, "/case/id") != nullptr ? "has a case that an earlier line has; remove one of the two"
                                                    : "is not what a run writes");
    begin = end + 1;
  }
  return begin;
}

// `list`: "cases" or "broken" of a result. Throws Error for items that violate the schema.
template <class Item>
std::vector<Item> items_of_run(const char* list, const Json& items, const fs::path& path) {
  const auto refuse = [&](const std::string& violation) {
    throw Error(path.string(), "", std::string("does not hold the ") + list + " of a run: " + violation);
  };
  const nlohmann::json schema = config::result_schema();
  nlohmann::json items_schema = schema["properties"][list];
  items_schema.erase("minItems");
  items_schema["definitions"] = schema["definitions"];  // the definitions that its parts refer to
  const std::vector<std::string> violations = config::schema_violations(items_schema, nlohmann::json(items));
  if (!violations.empty()) refuse(violations.front());
  std::vector<Item> out;
  try {
    for (const Json& one : items) out.push_back(result::from_json<Item>(one, "/" + std::to_string(out.size())));
  } catch (const Error& error) {
    refuse(error.where() + ": " + error.message());
  }
  return out;
}

}  // namespace

fs::path partial_of(const fs::path& file) {
  const fs::path target = os::output_target(file).path;
  std::error_code none;
  if (fs::is_directory(target, none)) throw Error(file.string(), "", "is a directory; name a file for the result");
  return target.string() + ".partial";
}

std::vector<std::string> finished_ids(const fs::path& file, const Json& header) {
  const fs::path partial = partial_of(file);
  std::vector<std::string> ids;
  std::error_code none;
  if (!fs::exists(fs::symlink_status(partial, none))) return ids;
  if (!fs::is_regular_file(fs::symlink_status(partial, none)))
    throw Error(partial.string(), "", "is no regular file, and a run leaves no other");
  const std::string text = file_text(partial.string());
  if (is_of_other_machine(text, header)) return ids;
  std::set<std::string> known;
  each_entry(text, partial, header, [&](const Json& entry) {
    if (entry.contains("broken")) {
      if (!is_broken_case(entry)) return false;
      if (const Json& id = entry["broken"]["id"]; id.is_string()) ids.push_back(id);
      return true;
    }
    if (!entry.contains("case")) return true;
    if (!accepts_case(entry, known)) return false;
    if (const Json& id = entry["case"]["id"]; id.is_string()) ids.push_back(id);
    return true;
  });
  return ids;
}

Journal::Journal(const fs::path& file, const Json& header, bool resume, std::uint64_t expected_bytes)
    : file_(file), partial_(partial_of(file)) {
  os::OutputFile(file_).probe();
  is_set_aside_of_other_machine_ = resume && is_of_other_machine(partial_.text(), header);
  if (resume && !is_set_aside_of_other_machine_)
    read_earlier(header);
  else
    set_earlier_aside(header_line(header));
  const std::uint64_t kept = partial_.text().size();
  partial_.check_room(expected_bytes > kept ? expected_bytes - kept : 0, expected_bytes);
  if (!partial_.text().empty()) return;
  try {
    partial_.append(header_line(header));
  } catch (const Error&) {
    partial_.empty();
    throw;
  }
}

Journal::~Journal() {
  if (!is_finished_ && is_empty()) partial_.remove();
}

// A header alone, or the start of one, contains no measurement.
void Journal::set_earlier_aside(const std::string& header) {
  const std::string text = partial_.text();
  if (text.empty()) return;
  if (header.starts_with(text) || is_header_alone(text)) {
    partial_.empty();
    return;
  }
  is_set_aside_of_run_ = text.starts_with(R"({"header":)");
  set_aside_ = partial_.move_text_beside();
}

void Journal::read_earlier(const Json& header) {
  Json cases = Json::array(), broken = Json::array();
  std::set<std::string> ids;
  const std::size_t end = each_entry(partial_.text(), partial_path(), header, [&](Json& entry) {
    if (entry.contains("broken")) {
      if (!is_broken_case(entry)) return false;
      broken.push_back(std::move(entry["broken"]));
      return true;
    }
    if (!entry.contains("case")) return accept_answer(entry);
    if (!accepts_case(entry, ids)) return false;
    cases.push_back(std::move(entry["case"]));
    return true;
  });
  earlier_cases_ = items_of_run<result::Case>("cases", cases, partial_path());
  earlier_broken_ = items_of_run<result::BrokenCase>("broken", broken, partial_path());
  partial_.cut_to(end);
}

std::vector<std::string> Journal::earlier_ids() const {
  std::vector<std::string> ids;
  for (const result::Case& finished : earlier_cases_) ids.push_back(finished.id);
  return ids;
}

// Checked by the line's digest alone: answers of launches have no schema.
bool Journal::accept_answer(Json& entry) {
  if (!entry.contains("request") || !entry.contains("answer")) return false;
  earlier_answers_[entry["request"].dump()] = std::move(entry["answer"]);
  return true;
}

std::optional<Json> Journal::earlier_answer(const Json& request) const {
  const auto found = earlier_answers_.find(request.dump());
  return found == earlier_answers_.end() ? std::nullopt : std::optional(found->second);
}

void Journal::add_answer(const Json& request, const Json& answer) {
  add({{"request", request}, {"answer", answer}});
}

void Journal::add(const Json& entry) {
  has_added_ = true;
  partial_.append(sealed_line(entry));
}

void Journal::add_case(const result::Case& finished) {
  add({{"case", result::to_json(finished)}});
}

void Journal::add_broken(const result::BrokenCase& broken) {
  add({{"broken", result::to_json(broken)}});
}

void Journal::finish(const result::Result& result, int threads) {
  try {
    os::write_file(file_, compact_json(result::to_json(result, threads), threads));
  } catch (const Error& error) {
    throw Error(error.file(), "",
                error.message() + (is_empty() ? "" : "; the cases are kept in " + partial_path().string()),
                error.code());
  }
  is_finished_ = true;
  partial_.remove();
}

}  // namespace clusterbench::report
