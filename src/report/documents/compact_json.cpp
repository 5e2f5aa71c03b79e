#include "report/documents/compact_json.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"
#include "core/text.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t k_line_width = 120;

// As dump() makes it; most texts need no escape, and most numbers are whole.
void append_text(const std::string& text, std::string& out) {
  const auto is_plain = [](char c) { return c >= ' ' && c < 0x7F && c != '"' && c != '\\'; };
  if (std::ranges::all_of(text, is_plain))
    out.append("\"").append(text).append("\"");
  else
    out += Json(text).dump();
}

void append_scalar(const Json& value, std::string& out) {
  if (value.is_string())
    append_text(value.get_ref<const std::string&>(), out);
  else if (value.is_number_unsigned())
    out += std::to_string(value.get<std::uint64_t>());
  else if (value.is_null())
    out += "null";
  else
    out += value.dump();
}

// The value in one line, with a space after commas and colons; false if it is longer than `room`.
bool append_line(const Json& value, std::string& out, std::size_t room) {
  if (!value.is_structured()) {
    append_scalar(value, out);
    return out.size() <= room;
  }
  const char* separator = "";
  out += value.is_object() ? "{" : "[";
  for (auto member = value.begin(); member != value.end(); ++member) {
    out += separator;
    separator = ", ";
    if (value.is_object()) {
      append_text(member.key(), out);
      out += ": ";
    }
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

  explicit Writer(int threads) : threads_(threads) {}

  void append(const Json& value, std::size_t indent) {
    if (!append_short(value)) append_long(value, indent);
  }

 private:
  std::size_t columns() const {
    const std::size_t feed = text.rfind('\n');
    return text.size() - (feed == std::string::npos ? 0 : feed + 1);
  }

  // The value in one line if it fits into the rest of the line, with a comma; else false, and nothing.
  bool append_short(const Json& value) {
    const std::size_t used = columns() + 1, begin = text.size();
    if (used < k_line_width && append_line(value, text, begin + k_line_width - used)) return true;
    text.resize(begin);
    return false;
  }

  void append_long(const Json& value, std::size_t indent) {
    constexpr std::size_t k_long_list = 64;
    if (!value.is_structured() || is_plain_list(value))
      append_line(value, text, text.max_size());
    else if (threads_ > 1 && value.is_array() && value.size() >= k_long_list)
      append_elements(value, indent);
    else
      append_members(value, indent);
  }

  // As append_members(): each element begins a line, so none depends on those before it.
  void append_elements(const Json& list, std::size_t indent) {
    std::vector<std::string> texts(list.size());
    parallel_ranges(list.size(), threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Writer writer(1);
        writer.text = "\n" + std::string(indent + 1, ' ');
        writer.append(list[i], indent + 1);
        texts[i] = std::move(writer.text);
      }
    });
    const char* separator = "[";
    for (const std::string& element : texts) {
      text.append(separator).append(element);
      separator = ",";
    }
    text += "\n" + std::string(indent, ' ') + "]";
  }

  // A short member of an object stays in the line of a short predecessor.
  void append_members(const Json& value, std::size_t indent) {
    text += value.is_object() ? "{" : "[";
    bool is_line_open = false;
    for (auto member = value.begin(); member != value.end(); ++member) {
      if (member != value.begin()) text += ",";
      const std::size_t end_of_line = text.size();
      if (is_line_open) {
        text += " ";
        append_text(member.key(), text);
        text += ": ";
        if (append_short(*member)) continue;
        text.resize(end_of_line);
      }
      text += "\n" + std::string(indent + 1, ' ');
      if (value.is_object()) {
        append_text(member.key(), text);
        text += ": ";
      }
      const bool is_short = append_short(*member);
      if (!is_short) append_long(*member, indent + 1);
      is_line_open = value.is_object() && is_short;
    }
    text += "\n" + std::string(indent, ' ') + (value.is_object() ? "}" : "]");
  }

  int threads_;
};

}  // namespace

std::string compact_json(const Json& value, int threads) {
  Writer writer(threads);
  writer.append(value, 0);
  return printable_json(writer.text) + "\n";
}

}  // namespace clusterbench::report
