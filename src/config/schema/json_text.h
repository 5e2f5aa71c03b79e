#pragma once
// Hand-written JSON: with // and /* */ comments, and with the position of every key and value in the text, for
// messages. Trailing commas and duplicate keys are rejected.

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace clusterbench::config {

// Both count from 1; columns are characters, not bytes.
struct TextPosition {
  int line = 1, column = 1;
  friend bool operator==(const TextPosition&, const TextPosition&) = default;
};

struct TextPlaces {
  std::map<std::string, TextPosition> keys;    // JSON pointer of a member -> position of its key
  std::map<std::string, TextPosition> values;  // JSON pointer -> start of its value; "" is the whole document
};

struct JsonText {
  std::string file;  // for messages
  nlohmann::json value;
  std::shared_ptr<const TextPlaces> places;  // null: without positions
  // JSON pointer -> the command line's flag that set it; without positions
  std::map<std::string, std::string> flags;

  bool has(const std::string& pointer) const { return places && places->values.contains(pointer); }
  // "line:column /pointer" of the value, or of the nearest enclosing value that the text has. For text changed by
  // flags: "--flag=value /pointer" of the flag that set it, or of all flags.
  std::string where(std::string pointer) const;
  // The same for a member's key.
  std::string where_key(const std::string& pointer) const;

 private:
  std::string flag_of(std::string pointer) const;
};

// Throws Error (file, "line:column /pointer") for broken syntax, a duplicate key, or a value that core/json_document.h
// rejects.
JsonText parse_json_text(const std::string& text, const std::string& file);

// pointer + "/" + key with ~ and / escaped (RFC 6901).
std::string child_pointer(const std::string& pointer, const std::string& key);
std::string child_pointer(const std::string& pointer, std::size_t index);

}  // namespace clusterbench::config
