#include "core/json_document.h"

#include <algorithm>
#include <set>
#include <vector>

#include "core/memory.h"

namespace clusterbench {
namespace {

// The position of the quotation mark that ends the string from `at` on; the text's length if there is none.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at, text.size());
}

// The last position of the comment from `at` on, if there is one.
std::size_t end_of_comment(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  std::size_t end = at;
  if (rest.starts_with("//"))
    end = text.find('\n', at);
  else if (rest.starts_with("/*"))
    end = text.find("*/", at + 2);
  return std::min(end, text.size());
}

// Scans a text that need not be JSON, without recursion.
class Counter {
 public:
  Counter(std::string_view text, JsonComments comments, std::size_t most_members)
      : text_(text), has_comments_(comments == JsonComments::allowed), most_members_(most_members) {}

  std::size_t keys() const { return keys_; }

  std::optional<JsonFault> excess() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        at_ = end_of_string(text_, at_);
      } else if (has_comments_ && c == '/') {
        at_ = end_of_comment(text_, at_);
      } else if (c == '[' || c == '{') {
        if (open_.size() == k_deepest_json)
          return JsonFault{at_, "is nested deeper than " + std::to_string(k_deepest_json) + " levels"};
        open_.push_back({c == '{', 1});
        ++values_;
      } else if (c == ']' || c == '}') {
        if (!open_.empty()) open_.pop_back();
      } else if (c == ':') {
        ++keys_;
      } else if (c == ',') {
        ++values_;
        if (!open_.empty() && ++open_.back().members > most_members_ && open_.back().is_object)
          return JsonFault{at_, "has an object of more than " + std::to_string(most_members_) + " members"};
      } else if (c == '\0' &&
                 text_.find_first_not_of(std::string_view("\0 \t\r\n", 5), at_) != std::string_view::npos) {
        // The library takes it for the end. Writers of glb fill up with it.
        return JsonFault{at_, at_ < 2 ? "is a NUL byte, as in UTF-16; JSON is UTF-8: save it as that"
                                      : "is a NUL byte with more text behind it"};
      }
    }
    check_memory("values of a JSON document", values_, k_json_value_bytes, "split the file");
    return std::nullopt;
  }

 private:
  struct Open {
    bool is_object = false;
    std::size_t members = 0;
  };

  std::string_view text_;
  bool has_comments_;
  std::size_t most_members_;
  std::size_t at_ = 0, values_ = 1, keys_ = 0;
  std::vector<Open> open_;
};

}  // namespace

std::optional<JsonFault> json_excess(std::string_view text, JsonComments comments, std::size_t most_members,
                                     std::size_t* keys) {
  Counter counter(text, comments, most_members);
  std::optional<JsonFault> excess = counter.excess();
  if (keys != nullptr) *keys = counter.keys();
  return excess;
}

namespace {

// The second of two equal keys, as they are written, in a text that has been parsed; nullopt if there is none.
class RepeatedKey {
 public:
  explicit RepeatedKey(std::string_view text, JsonComments comments)
      : text_(text), has_comments_(comments == JsonComments::allowed) {}

  std::optional<JsonFault> find() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"') {
        take_string();
        continue;
      }
      if (has_comments_ && c == '/') at_ = end_of_comment(text_, at_);
      if (c == '{' || c == '[') keys_.emplace_back();
      if ((c == '}' || c == ']') && !keys_.empty()) keys_.pop_back();
      if (c == ':' && !keys_.empty() && !keys_.back().insert(last_).second)
        return JsonFault{last_at_, "is the key " + std::string(last_) + " for the second time in its object", false,
                         true};
      ++at_;
    }
    return std::nullopt;
  }

 private:
  void take_string() {
    const std::size_t end = end_of_string(text_, at_);
    last_ = text_.substr(at_, end + 1 - at_);
    last_at_ = at_;
    at_ = end + 1;
  }

  std::string_view text_;
  bool has_comments_;
  std::size_t at_ = 0, last_at_ = 0;
  std::string_view last_;  // the last string, with its quotation marks
  std::vector<std::set<std::string_view>> keys_;
};

}  // namespace

namespace json_detail {

JsonFault repeated_key(std::string_view text, JsonComments comments) {
  return RepeatedKey(text, comments)
      .find()
      .value_or(JsonFault{0, "has an object with a key twice, in different spellings", false, true});
}

}  // namespace json_detail

std::string plain_json_message(const std::string& message) {
  const std::size_t position = message.find("column ");
  const std::size_t colon = message.find(": ", position == std::string::npos ? 0 : position);
  const std::size_t bracket = message.find("] ");
  if (position != std::string::npos && colon != std::string::npos) return message.substr(colon + 2);
  return bracket == std::string::npos ? message : message.substr(bracket + 2);
}

namespace json_detail {

JsonFault number_fault(std::string_view text, const std::string& message) {
  const std::size_t first = message.find('\''), last = message.rfind('\'');
  const std::string number = first < last ? message.substr(first + 1, last - first - 1) : "";
  const std::size_t at = text.find(number);
  return {at == std::string_view::npos ? 0 : at,
          "has a number that is larger than double precision can hold: " + number};
}

}  // namespace json_detail

}  // namespace clusterbench
