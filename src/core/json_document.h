#pragma once
// The one reader of JSON documents: results, journals, histories, configurations, scenes. Depth, values and members are
// counted over the text before anything is parsed, since copying a deep value recurses and a wide one takes memory.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"

namespace clusterbench {

// Arrays and objects within each other. What this tool writes has a dozen, glTF's extras may have more.
inline constexpr int k_deepest_json = 256;
// Of one object of a document whose members keep their order, which are looked for one by one.
inline constexpr std::size_t k_most_json_members = 20'000;
// What a parsed value takes, about: with its key and its share of the list that it stands in.
inline constexpr std::size_t k_json_value_bytes = 64;

enum class JsonComments : bool { refused, allowed };

struct JsonFault {
  std::size_t byte = 0;
  std::string what;
  bool is_syntax = false;  // the text is no JSON at all

  std::string text() const { return is_syntax ? "is not JSON: " + what : what; }
};

// What of a text exceeds the limits, the first of it; nothing for what may be parsed. It need not be JSON. Throws Error
// (limits.memory_mib) for more values than memory may hold.
std::optional<JsonFault> json_excess(std::string_view text, JsonComments comments,
                                     std::size_t most_members = static_cast<std::size_t>(-1));

// The library's message without its own prefix and position.
std::string plain_json_message(const std::string& what);

namespace json_detail {

template <class Json>
constexpr std::size_t most_members() {
  return std::is_same_v<Json, nlohmann::ordered_json> ? k_most_json_members : static_cast<std::size_t>(-1);
}

// A number beyond double precision, which the message quotes: where it stands.
JsonFault number_fault(std::string_view text, const std::string& what);

}  // namespace json_detail

// The document, or why it is none.
template <class Json>
std::optional<JsonFault> parse_json(std::string_view text, Json& out, JsonComments comments = JsonComments::refused) {
  if (std::optional<JsonFault> excess = json_excess(text, comments, json_detail::most_members<Json>())) return excess;
  try {
    out = Json::parse(text, nullptr, true, comments == JsonComments::allowed);
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

// The document, or a discarded value where it is none.
template <class Json>
Json json_or_discarded(std::string_view text, JsonComments comments = JsonComments::refused) {
  Json out;
  if (parse_json(text, out, comments)) return Json(nlohmann::detail::value_t::discarded);
  return out;
}

}  // namespace clusterbench
