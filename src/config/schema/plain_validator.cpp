#include "config/schema/plain_validator.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string_view>

#include "core/error.h"
#include "core/pattern.h"

namespace clusterbench::config {
namespace {

using Schema = nlohmann::json;
using Violations = std::vector<std::string>;

constexpr int k_deepest_schema = 400;  // schemas within schemas; documents are read with less

// Those that say nothing about an instance.
constexpr std::array k_other_keywords = {"$schema", "$id",         "$comment", "title",    "description",
                                         "default", "definitions", "examples", "readOnly", "format"};

bool is_one_of(std::string_view word, std::span<const char* const> words) {
  return std::ranges::find(words, word) != words.end();
}

bool is_type(const Schema& value, std::string_view type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  return type == "integer" && value.is_number_integer();  // 1.0 is none, as for the readers
}

bool is_any_type(const Schema& value, const Schema& types) {
  if (types.is_string()) return is_type(value, types.get<std::string>());
  return std::ranges::any_of(types, [&](const Schema& type) { return is_type(value, type.get<std::string>()); });
}

std::size_t characters_in(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

class PlainValidator {
 public:
  explicit PlainValidator(const Schema& root) : root_(root) {}

  Violations of(const Schema& schema, const Schema& value, const std::string& at) {
    if (++depth_ > k_deepest_schema) throw Error("", "", "a schema nests too deeply", ExitCode::internal);
    Violations out;
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) tell(out, at, "Nothing is allowed here.");
    } else if (schema.contains("$ref")) {
      out = of(referred(schema["$ref"].get<std::string>()), value, at);
    } else {
      for (const auto& [keyword, rule] : schema.items()) check(keyword, rule, schema, value, at, out);
    }
    --depth_;
    return out;
  }

 private:
  static void tell(Violations& out, const std::string& at, const std::string& message) {
    out.push_back((at.empty() ? "/" : at) + ": " + message);
  }
  static void add(Violations& out, const Violations& more) { out.insert(out.end(), more.begin(), more.end()); }

  const Schema& referred(const std::string& reference) const {
    if (!reference.starts_with('#'))
      throw Error("", "", "a schema refers to '" + reference + "', outside of itself", ExitCode::internal);
    return root_.at(Schema::json_pointer(reference.substr(1)));
  }

  void check(const std::string& keyword, const Schema& rule, const Schema& schema, const Schema& value,
             const std::string& at, Violations& out) {
    const bool is_known = check_any(keyword, rule, value, at, out) || check_number(keyword, rule, value, at, out) ||
                          check_text(keyword, rule, value, at, out) || check_array(keyword, rule, value, at, out) ||
                          check_object(keyword, rule, schema, value, at, out);
    if (!is_known && !keyword.starts_with("x-") && !is_one_of(keyword, k_other_keywords))
      throw Error("", "", "the schema has the keyword '" + keyword + "', which a build without valijson cannot check",
                  ExitCode::internal);
  }

  // Each returns whether the keyword is one of its own.
  bool check_any(const std::string& keyword, const Schema& rule, const Schema& value, const std::string& at,
                 Violations& out) {
    if (keyword == "type") {
      if (!is_any_type(value, rule)) tell(out, at, "Value type not permitted by 'type' constraint.");
    } else if (keyword == "enum") {
      if (std::ranges::find(rule, value) == rule.end()) tell(out, at, "Failed to match against any enum values.");
    } else if (keyword == "const") {
      if (value != rule) tell(out, at, "Failed to match expected value set by 'const' constraint.");
    } else if (keyword == "not") {
      if (of(rule, value, at).empty())
        tell(out, at, "Target should not validate against schema specified in 'not' constraint.");
    } else {
      return check_parts(keyword, rule, value, at, out);
    }
    return true;
  }
  bool check_parts(const std::string& keyword, const Schema& rule, const Schema& value, const std::string& at,
                   Violations& out) {
    if (keyword == "anyOf") {
      if (count_of_matching(rule, value) == 0)
        tell(out, at, "Failed to validate against any schemas allowed by anyOf constraint.");
    } else if (keyword == "oneOf") {
      if (count_of_matching(rule, value) != 1)
        tell(out, at, "Failed to validate against exactly one schema of oneOf constraint.");
    } else if (keyword == "allOf") {
      for (const Schema& part : rule) add(out, of(part, value, at));
    } else {
      return false;
    }
    return true;
  }
  std::size_t count_of_matching(const Schema& schemas, const Schema& value) {
    return static_cast<std::size_t>(
        std::ranges::count_if(schemas, [&](const Schema& schema) { return of(schema, value, "").empty(); }));
  }

  static bool check_number(const std::string& keyword, const Schema& rule, const Schema& value, const std::string& at,
                           Violations& out) {
    const auto need = [&](bool holds, const char* relation) {
      if (value.is_number() && !holds) tell(out, at, std::string("Expected number ") + relation + " " + rule.dump());
      return true;
    };
    if (keyword == "minimum") return need(value >= rule, "greater than or equal to");
    if (keyword == "exclusiveMinimum") return need(value > rule, "greater than");
    if (keyword == "maximum") return need(value <= rule, "less than or equal to");
    if (keyword == "exclusiveMaximum") return need(value < rule, "less than");
    return false;
  }

  static bool check_text(const std::string& keyword, const Schema& rule, const Schema& value, const std::string& at,
                         Violations& out) {
    if (keyword != "minLength" && keyword != "maxLength" && keyword != "pattern") return false;
    if (!value.is_string()) return true;
    const auto& text = value.get_ref<const std::string&>();
    if (keyword != "pattern")
      check_count(keyword == "minLength", rule, characters_in(text), "characters", at, out);
    else if (!Pattern(rule.get<std::string>(), "pattern").is_in(text))
      tell(out, at, "Failed to match regex specified by 'pattern' constraint.");
    return true;
  }
  static void check_count(bool is_least, const Schema& rule, std::size_t count, const char* unit, const std::string& at,
                          Violations& out) {
    const auto limit = rule.get<std::size_t>();
    if (is_least ? count < limit : count > limit)
      tell(out, at,
           "It has " + std::to_string(count) + " " + unit + ", and should have at " + (is_least ? "least " : "most ") +
               std::to_string(limit) + ".");
  }

  bool check_array(const std::string& keyword, const Schema& rule, const Schema& value, const std::string& at,
                   Violations& out) {
    constexpr std::array k_own = {"items", "minItems", "maxItems", "uniqueItems", "contains"};
    if (!is_one_of(keyword, k_own)) return false;
    if (!value.is_array()) return true;
    if (keyword == "items") {
      check_items(rule, value, at, out);
    } else if (keyword == "uniqueItems") {
      if (rule.get<bool>() && std::set<Schema>(value.begin(), value.end()).size() != value.size())
        tell(out, at, "Two items are the same, and each must differ from the others.");
    } else if (keyword == "contains") {
      if (std::ranges::none_of(value, [&](const Schema& item) { return of(rule, item, "").empty(); }))
        tell(out, at, "No item fits the schema of 'contains' constraint.");
    } else {
      check_count(keyword == "minItems", rule, value.size(), "items", at, out);
    }
    return true;
  }
  // One schema for all, or one for each of the first.
  void check_items(const Schema& rule, const Schema& value, const std::string& at, Violations& out) {
    const std::size_t checked = rule.is_array() ? std::min(rule.size(), value.size()) : value.size();
    for (std::size_t i = 0; i < checked; ++i)
      add(out, of(rule.is_array() ? rule[i] : rule, value[i], at + "/" + std::to_string(i)));
  }

  bool check_object(const std::string& keyword, const Schema& rule, const Schema& schema, const Schema& value,
                    const std::string& at, Violations& out) {
    constexpr std::array k_own = {"properties",    "additionalProperties", "required",     "minProperties",
                                  "maxProperties", "dependencies",         "propertyNames"};
    if (!is_one_of(keyword, k_own)) return false;
    if (!value.is_object()) return true;
    if (keyword == "properties")
      check_properties(rule, value, at, out);
    else if (keyword == "additionalProperties")
      check_others(rule, schema, value, at, out);
    else if (keyword == "required")
      check_there(rule, value, at, out);
    else if (keyword == "dependencies")
      check_dependencies(rule, value, at, out);
    else if (keyword == "propertyNames")
      check_names(rule, value, at, out);
    else
      check_count(keyword == "minProperties", rule, value.size(), "properties", at, out);
    return true;
  }
  void check_properties(const Schema& rule, const Schema& value, const std::string& at, Violations& out) {
    for (const auto& [name, part] : rule.items())
      if (value.contains(name)) add(out, of(part, value[name], at + "/" + name));
  }
  void check_others(const Schema& rule, const Schema& schema, const Schema& value, const std::string& at,
                    Violations& out) {
    const auto properties = schema.find("properties");
    for (const auto& [name, part] : value.items()) {
      if (properties != schema.end() && properties->contains(name)) continue;
      if (rule.is_boolean() && !rule.get<bool>())
        tell(out, at,
             "Object contains a property that could not be validated using 'properties' or 'additionalProperties' "
             "constraints: '" +
                 name + "'.");
      else
        add(out, of(rule, part, at + "/" + name));
    }
  }
  static void check_there(const Schema& names, const Schema& value, const std::string& at, Violations& out) {
    for (const Schema& name : names)
      if (!value.contains(name.get<std::string>()))
        tell(out, at, "Missing required property '" + name.get<std::string>() + "'.");
  }
  void check_dependencies(const Schema& rule, const Schema& value, const std::string& at, Violations& out) {
    for (const auto& [name, needs] : rule.items()) {
      if (!value.contains(name)) continue;
      if (needs.is_array())
        check_there(needs, value, at, out);
      else
        add(out, of(needs, value, at));
    }
  }
  void check_names(const Schema& rule, const Schema& value, const std::string& at, Violations& out) {
    for (const auto& [name, part] : value.items()) add(out, of(rule, Schema(name), at + "/" + name));
  }

  const Schema& root_;
  int depth_ = 0;
};

}  // namespace

std::vector<std::string> plain_violations(const nlohmann::json& schema, const nlohmann::json& instance) {
  return PlainValidator(schema).of(schema, instance, "");
}

}  // namespace clusterbench::config
