#include "core/json_document.h"

#include <algorithm>
#include <set>
#include <vector>

#include "core/memory.h"

namespace clusterbench {
namespace {

// Scans a text that need not be JSON, without recursion.
class Counter {
 public:
  Counter(std::string_view text, JsonComments comments, std::size_t most_members)
      : text_(text), has_comments_(comments == JsonComments::allowed), most_members_(most_members) {}

  std::optional<JsonFault> excess() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        skip_string();
      } else if (has_comments_ && c == '/') {
        skip_comment();
      } else if (c == '[' || c == '{') {
        if (open_.size() == k_deepest_json)
          return JsonFault{at_, "is nested deeper than " + std::to_string(k_deepest_json) + " levels"};
        open_.push_back({c == '{', 1});
        ++values_;
      } else if (c == ']' || c == '}') {
        if (!open_.empty()) open_.pop_back();
      } else if (c == ',') {
        ++values_;
        if (!open_.empty() && ++open_.back().members > most_members_ && open_.back().is_object)
          return JsonFault{at_, "has an object of more than " + std::to_string(most_members_) + " members"};
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

  void skip_string() {
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
      if (text_[at_] == '\\') ++at_;
  }
  void skip_comment() {
    const std::string_view rest = text_.substr(at_);
    std::size_t end = at_;
    if (rest.starts_with("//"))
      end = text_.find('\n', at_);
    else if (rest.starts_with("/*"))
      end = text_.find("*/", at_ + 2);
    at_ = std::min(end, text_.size());
  }

  std::string_view text_;
  bool has_comments_;
  std::size_t most_members_;
  std::size_t at_ = 0, values_ = 1;
  std::vector<Open> open_;
};

// As part of a JSON pointer (RFC 6901).
std::string escaped_token(const std::string& name) {
  std::string out;
  for (const char c : name)
    if (c == '~' || c == '/')
      out.append(c == '~' ? "~0" : "~1");
    else
      out.push_back(c);
  return out;
}

// Follows a document's names. Each handler returns false to end the reading.
class MemberNames final : public nlohmann::json_sax<nlohmann::json> {
 public:
  const std::optional<std::string>& repeated() const { return repeated_; }

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return start(true); }
  bool start_array(std::size_t) override { return start(false); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.name = name;
    if (level.names.insert(name).second) return true;
    repeated_.emplace();
    for (const Level& above : levels_) {
      repeated_->push_back('/');
      repeated_->append(above.is_object ? escaped_token(above.name) : std::to_string(above.index));
    }
    return false;
  }

 private:
  struct Level {
    bool is_object = false;
    std::size_t index = 0;
    std::string name{};
    std::set<std::string> names{};
  };

  bool value() {
    if (!levels_.empty()) ++levels_.back().index;
    return true;
  }
  bool start(bool is_object) {
    levels_.push_back({is_object});
    return true;
  }
  bool end() {
    levels_.pop_back();
    return value();
  }

  std::vector<Level> levels_;
  std::optional<std::string> repeated_;
};

}  // namespace

std::optional<std::string> repeated_member(std::string_view text, JsonComments comments) {
  MemberNames names;
  nlohmann::json::sax_parse(text, &names, nlohmann::json::input_format_t::json, true,
                            comments == JsonComments::allowed);
  return names.repeated();
}

std::optional<JsonFault> json_excess(std::string_view text, JsonComments comments, std::size_t most_members) {
  return Counter(text, comments, most_members).excess();
}

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
