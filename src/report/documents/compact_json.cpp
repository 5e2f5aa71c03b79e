#include "report/documents/compact_json.h"

#include <algorithm>

#include "core/text.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t k_line_width = 120;

// The value in one line, with a space after commas and colons; false if it is longer than `room`.
bool append_line(const Json& value, std::string& out, std::size_t room) {
  if (!value.is_structured()) {
    out += value.dump();
    return out.size() <= room;
  }
  const char* separator = "";
  out += value.is_object() ? "{" : "[";
  for (auto member = value.begin(); member != value.end(); ++member) {
    out += separator;
    separator = ", ";
    if (value.is_object()) out += Json(member.key()).dump() + ": ";
    if (out.size() > room || !append_line(*member, out, room)) return false;
  }
  out += value.is_object() ? "}" : "]";
  return out.size() <= room;
}

bool is_plain_list(const Json& value) {
  return value.is_array() &&
         std::none_of(value.begin(), value.end(), [](const Json& member) { return member.is_structured(); });
}

class Writer {
 public:
  std::string text;

  void append(const Json& value, std::size_t indent) {
    if (!value.is_structured() || is_plain_list(value)) {
      append_line(value, text, text.max_size());
    } else if (const std::string line = short_line(value); !line.empty()) {
      text += line;
    } else {
      append_members(value, indent);
    }
  }

 private:
  std::size_t columns() const {
    const std::size_t feed = text.rfind('\n');
    return text.size() - (feed == std::string::npos ? 0 : feed + 1);
  }

  // The value in one line if it fits into the rest of the line, with a comma; else "".
  std::string short_line(const Json& value) const {
    std::string line;
    const std::size_t used = columns() + 1;
    return used < k_line_width && append_line(value, line, k_line_width - used) ? line : "";
  }

  // A short member of an object stays in the line of a short predecessor.
  void append_members(const Json& value, std::size_t indent) {
    text += value.is_object() ? "{" : "[";
    bool is_line_open = false;
    for (auto member = value.begin(); member != value.end(); ++member) {
      if (member != value.begin()) text += ",";
      const std::string key = value.is_object() ? Json(member.key()).dump() + ": " : "";
      if (is_line_open) {
        text += " " + key;
        if (const std::string line = short_line(*member); !line.empty()) {
          text += line;
          continue;
        }
        text.resize(text.size() - key.size() - 1);
      }
      text += "\n" + std::string(indent + 1, ' ') + key;
      const bool is_short = !short_line(*member).empty();
      append(*member, indent + 1);
      is_line_open = value.is_object() && is_short;
    }
    text += "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
  }
};

}  // namespace

std::string compact_json(const Json& value) {
  Writer writer;
  writer.append(value, 0);
  return printable_json(writer.text) + "\n";
}

}  // namespace clusterbench::report
