#include "config/schema/json_text.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "core/error.h"
#include "core/json_document.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

TextPosition position_of(std::string_view text, std::size_t offset) {
  TextPosition position;
  for (const char c : text.substr(0, std::min(offset, text.size()))) {
    const bool continues_character = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
    if (c == '\n') {
      ++position.line;
      position.column = 1;
    } else if (!continues_character) {
      ++position.column;
    }
  }
  return position;
}

std::string to_text(TextPosition position, const std::string& pointer) {
  return std::to_string(position.line) + ":" + std::to_string(position.column) + " " +
         (pointer.empty() ? "/" : pointer);
}

// Scans text that the parser has accepted, which limits its depth, and records positions.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file, TextPlaces& out) : text_(text), file_(file), out_(out) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  void value(const std::string& pointer) {
    skip_blank();
    out_.values[pointer] = here();
    if (text_[at_] == '{') {
      object(pointer);
    } else if (text_[at_] == '[') {
      array(pointer);
    } else if (text_[at_] == '"') {
      string();
    } else {
      at_ = std::min(text_.find_first_of(",]} \t\r\n/", at_), text_.size());
    }
  }

 private:
  // Positions are queried in ascending order, so each character is counted once.
  TextPosition here() {
    const TextPosition step = position_of(text_.substr(counted_), at_ - counted_);
    position_.column = step.line == 1 ? position_.column + step.column - 1 : step.column;
    position_.line += step.line - 1;
    counted_ = at_;
    return position_;
  }

  void skip_blank() {
    while (at_ < text_.size()) {
      if (text_.substr(at_).starts_with("//")) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.substr(at_).starts_with("/*")) {
        at_ = text_.find("*/", at_ + 2) + 2;
      } else if (std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string string() {
    const std::size_t begin = at_++;
    while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    ++at_;
    return nlohmann::json::parse(text_.substr(begin, at_ - begin)).get<std::string>();
  }

  void object(const std::string& pointer) {
    ++at_;
    for (skip_blank(); text_[at_] != '}'; skip_blank()) {
      const TextPosition key_position = here();
      const std::string key = string();
      const std::string member = child_pointer(pointer, key);
      const auto [earlier, is_new] = out_.keys.emplace(member, key_position);
      if (!is_new) {
        throw Error(file_, to_text(key_position, member),
                    "duplicate key '" + key + "'; the first one is at " + std::to_string(earlier->second.line) + ":" +
                        std::to_string(earlier->second.column));
      }
      skip_blank();
      ++at_;  // the colon
      value(member);
      skip_comma();
    }
    ++at_;
  }

  void array(const std::string& pointer) {
    ++at_;
    std::size_t index = 0;
    for (skip_blank(); text_[at_] != ']'; skip_blank()) {
      value(child_pointer(pointer, index++));
      skip_comma();
    }
    ++at_;
  }

  void skip_comma() {
    skip_blank();
    if (text_[at_] == ',') ++at_;
  }

  std::string_view text_;
  const std::string& file_;
  TextPlaces& out_;
  std::size_t at_ = 0, counted_ = 0;
  TextPosition position_;
};

nlohmann::json parsed(const std::string& text, const std::string& file) {
  nlohmann::json value;
  const std::optional<JsonFault> fault = parse_json(text, value, JsonComments::allowed);
  if (fault && !fault->is_repeated_key)  // the reader of positions names both keys
    throw Error(file, to_text(position_of(text, fault->byte), ""), fault->message);
  return value;
}

}  // namespace

std::string child_pointer(const std::string& pointer, const std::string& key) {
  std::string out = pointer + "/";
  for (const char c : key) {
    if (c == '~' || c == '/')
      out += c == '~' ? "~0" : "~1";
    else
      out += c;
  }
  return out;
}

std::string child_pointer(const std::string& pointer, std::size_t index) {
  return pointer + "/" + std::to_string(index);
}

std::string JsonText::where(std::string pointer) const {
  if (!flags.empty()) return flag_of(pointer) + " " + pointer;
  while (!has(pointer) && !pointer.empty()) pointer.resize(pointer.rfind('/'));
  return to_text(has(pointer) ? places->values.at(pointer) : TextPosition{}, pointer);
}

std::string JsonText::flag_of(std::string pointer) const {
  for (; !pointer.empty(); pointer.resize(pointer.rfind('/')))
    if (const auto found = flags.find(pointer); found != flags.end()) return found->second;
  std::set<std::string> all;
  for (const auto& [key, flag] : flags) all.insert(flag);
  return joined(std::vector<std::string>(all.begin(), all.end()), " ");
}

std::string JsonText::where_key(const std::string& pointer) const {
  const bool is_there = places && places->keys.contains(pointer);
  return is_there ? to_text(places->keys.at(pointer), pointer) : where(pointer);
}

JsonText parse_json_text(const std::string& text, const std::string& file) {
  JsonText out;
  out.file = file;
  out.value = parsed(text, file);
  const auto places = std::make_shared<TextPlaces>();
  Scanner(text, file, *places).value("");
  out.places = places;
  return out;
}

}  // namespace clusterbench::config
