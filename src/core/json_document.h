#pragma once
// The one reader of JSON documents: results, journals, histories, configurations, scenes. Depth, values and members are
// counted in the text before it is parsed, since copying a deep value recurses and a wide one needs much memory.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"

namespace clusterbench {

// Nested arrays and objects. This tool writes about a dozen levels; glTF's extras may have more.
inline constexpr int k_deepest_json = 256;
// Limit for one object of a document that keeps the order of its members, since these are searched linearly.
inline constexpr std::size_t k_most_json_members = 20'000;
// Approximate memory of a parsed value, with its key and its share of the containing list.
inline constexpr std::size_t k_json_value_bytes = 64;

enum class JsonComments : bool { refused, allowed };

struct JsonFault {
  std::size_t byte = 0;
  std::string message;
  bool is_syntax = false;        // the text is not JSON
  bool is_repeated_key = false;  // it is, with the later of two values

  std::string text() const { return is_syntax ? "is not JSON: " + message : message; }
};

// The first violation of the limits in a text; nullopt if it may be parsed. The text need not be JSON. Throws Error
// (limits.memory_mib) for more values than the limit on memory allows. `keys`: gets the number of keys in JSON.
std::optional<JsonFault> json_excess(std::string_view text, JsonComments comments,
                                     std::size_t most_members = static_cast<std::size_t>(-1),
                                     std::size_t* keys = nullptr);

// The library's message without its own prefix and position.
std::string plain_json_message(const std::string& message);

namespace json_detail {

template <class Json>
constexpr std::size_t most_members() {
  return std::is_same_v<Json, nlohmann::ordered_json> ? k_most_json_members : static_cast<std::size_t>(-1);
}

// Of a text with fewer members than keys.
JsonFault repeated_key(std::string_view text, JsonComments comments);

template <class Json>
std::size_t members_of(const Json& value) {
  std::size_t count = value.is_object() ? value.size() : 0;
  if (value.is_structured())
    for (const Json& part : value) count += members_of(part);
  return count;
}

// The location of a number beyond double precision that the message quotes.
JsonFault number_fault(std::string_view text, const std::string& message);

}  // namespace json_detail

// The document, or why it is none. A key twice in an object is a fault: readers differ in which of them counts.
template <class Json>
std::optional<JsonFault> parse_json(std::string_view text, Json& out, JsonComments comments = JsonComments::refused) {
  std::size_t keys = 0;
  if (std::optional<JsonFault> excess = json_excess(text, comments, json_detail::most_members<Json>(), &keys))
    return excess;
  try {
    out = Json::parse(text, nullptr, true, comments == JsonComments::allowed);
    if (json_detail::members_of(out) < keys) return json_detail::repeated_key(text, comments);
    return std::nullopt;
  } catch (const nlohmann::json::parse_error& error) {
    return JsonFault{error.byte > 0 ? error.byte - 1 : 0, plain_json_message(error.what()), true};
  } catch (const nlohmann::json::out_of_range& error) {
    return json_detail::number_fault(text, error.what());
  }
}

// The document. Throws Error (file, "byte N").
template <class Json>
Json read_json(std::string_view text, const std::string& file, JsonComments comments = JsonComments::refused) {
  Json out;
  if (const std::optional<JsonFault> fault = parse_json(text, out, comments))
    throw Error(file, "byte " + std::to_string(fault->byte), fault->text());
  return out;
}

// The document, or a discarded value if it is none.
template <class Json>
Json json_or_discarded(std::string_view text, JsonComments comments = JsonComments::refused) {
  Json out;
  if (parse_json(text, out, comments)) return Json(nlohmann::detail::value_t::discarded);
  return out;
}

}  // namespace clusterbench
