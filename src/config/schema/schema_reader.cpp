#include "config/schema/schema_reader.h"

#include <algorithm>
#include <optional>
#include <regex>
#include <set>
#include <unordered_map>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

const Json& resolved(const Json& root, const Json& schema) {
  if (!schema.contains("$ref")) return schema;
  return root.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
}

// The alternatives of a schema that consists only of a choice; null for others.
const Json* alternatives(const Json& schema) {
  if (schema.contains("type")) return nullptr;
  for (const char* keyword : {"anyOf", "oneOf"})
    if (schema.contains(keyword)) return &schema[keyword];
  return nullptr;
}

std::vector<std::string> types_of(const Json& schema) {
  if (!schema.contains("type")) return {};
  if (schema["type"].is_array()) return schema["type"].get<std::vector<std::string>>();
  return {schema["type"].get<std::string>()};
}

bool has_type(const std::string& type, const Json& value) {
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "array") return value.is_array();
  if (type == "object") return value.is_object();
  return value.is_null();
}

std::string quoted(const Json& value) {
  return value.is_string() ? "'" + value.get<std::string>() + "'" : value.dump();
}

std::string found_text(const Json& value) {
  constexpr std::size_t k_longest = 60;
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_object()) return "an object";
  const std::string text = quoted(value);
  return text.size() > k_longest ? "a text of " + std::to_string(text.size()) + " bytes" : text;
}

std::string range_text(const Json& schema) {
  const bool has_min = schema.contains("minimum"), has_max = schema.contains("maximum");
  if (has_min && has_max) return " from " + schema["minimum"].dump() + " to " + schema["maximum"].dump();
  std::string text;
  if (has_min) text = " of at least " + schema["minimum"].dump();
  if (schema.contains("exclusiveMinimum")) text = " above " + schema["exclusiveMinimum"].dump();
  if (has_max) text += (text.empty() ? "" : ",") + std::string(" at most ") + schema["maximum"].dump();
  return text;
}

std::vector<std::string> texts_of(const Json& values) {
  std::vector<std::string> texts;
  for (const Json& value : values) texts.push_back(value.is_string() ? value.get<std::string>() : value.dump());
  return texts;
}

// Texts that look like numbers are quoted: 8 and "8" are different in a configuration.
std::vector<std::string> shown_texts(const Json& values) {
  std::vector<std::string> texts = texts_of(values);
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (values[i].is_string() && !Json::parse(texts[i], nullptr, false).is_discarded()) texts[i] = values[i].dump();
  return texts;
}

std::string list_text(const Json& root, const Json& schema) {
  const std::string items = schema.contains("items") ? describe_allowed(root, schema["items"]) : "values";
  const bool fixed = schema.contains("maxItems") && schema["maxItems"] == schema.value("minItems", Json());
  return (fixed ? "a list of " + schema["maxItems"].dump() + ", each " : "a list, each ") + items;
}

std::string type_text(const Json& root, const Json& schema, const std::string& type) {
  if (type == "integer") return "an integer" + range_text(schema);
  if (type == "number") return "a number" + range_text(schema);
  if (type == "boolean") return "true or false";
  if (type == "array") return list_text(root, schema);
  if (type == "object") return "an object";
  if (type == "string" && schema.contains("pattern")) return "a pattern such as " + quoted(schema["examples"][0]);
  if (type == "string") return schema.contains("enum") ? joined(shown_texts(schema["enum"])) : "text";
  return type;
}

class Reader {
 public:
  Reader(const Json& root, const JsonText& text) : root_(root), text_(text) {}

  Json read(const Json& unresolved, const Json& value, const std::string& pointer) const {
    const Json& schema = resolved(unresolved);
    if (const Json* choices = alternatives(schema)) return read_choice(schema, *choices, value, pointer);
    const std::vector<std::string> types = types_of(schema);
    const bool typed = std::any_of(types.begin(), types.end(), [&](const auto& type) { return has_type(type, value); });
    if (!types.empty() && !typed) fail(schema, value, pointer);
    const bool is_of_words = schema.contains("enum") || schema.contains("const");
    if (value.is_object() && !is_of_words) return read_object(schema, nullptr, value, pointer);
    if (value.is_array() && !is_of_words) return read_array(schema, value, pointer);
    check_scalar(schema, value, pointer);
    return value;
  }

 private:
  // The same as the function of that name, without looking a reference up twice.
  const Json& resolved(const Json& schema) const {
    const Json*& known = resolved_[&schema];
    if (known == nullptr) known = &config::resolved(root_, schema);
    return *known;
  }

  // Compiled once: that takes longer than all else of a value.
  const std::regex& pattern_of(const Json& schema) const {
    std::optional<std::regex>& known = patterns_[&schema];
    if (!known) known.emplace(schema["pattern"].get<std::string>());
    return *known;
  }

  [[noreturn]] void fail(const Json& schema, const Json& value, const std::string& pointer) const {
    throw Error(text_.file, text_.where(pointer),
                "found " + found_text(value) + ", allowed: " + describe_allowed(root_, schema));
  }

  void check_scalar(const Json& schema, const Json& value, const std::string& pointer) const {
    if (schema.contains("enum")) check_among(texts_of(schema["enum"]), value, pointer);
    if (schema.contains("const") && schema["const"] != value) fail(schema, value, pointer);
    if (value.is_string() && value.get_ref<const std::string&>().size() < schema.value("minLength", 0U))
      throw Error(text_.file, text_.where(pointer), "found an empty text, allowed: a text that is not empty");
    if (!value.is_number()) return;
    const bool low = (schema.contains("minimum") && value < schema["minimum"]) ||
                     (schema.contains("exclusiveMinimum") && value <= schema["exclusiveMinimum"]);
    if (low || (schema.contains("maximum") && value > schema["maximum"])) fail(schema, value, pointer);
  }

  void check_among(const std::vector<std::string>& names, const Json& value, const std::string& pointer) const {
    const std::string word = value.is_string() ? value.get<std::string>() : value.dump();
    if (value.is_string() && std::find(names.begin(), names.end(), word) != names.end()) return;
    throw Error(text_.file, text_.where(pointer),
                "found " + found_text(value) + did_you_mean(word, names) + ", allowed: " + joined(names));
  }

  void check_unique(const Json& list, const std::string& pointer) const {
    for (std::size_t i = 0; i < list.size(); ++i)
      if (std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), list[i]) !=
          list.begin() + static_cast<std::ptrdiff_t>(i))
        throw Error(text_.file, text_.where(child_pointer(pointer, i)), found_text(list[i]) + " stands here twice");
  }

  Json read_array(const Json& schema, const Json& value, const std::string& pointer) const {
    if (value.empty() && schema.value("minItems", 0U) > 0)
      throw Error(text_.file, text_.where(pointer),
                  "found an empty list, allowed: " + describe_allowed(root_, schema) + "; at least " +
                      schema["minItems"].dump());
    if (value.size() < schema.value("minItems", std::size_t{0}) ||
        value.size() > schema.value("maxItems", value.size()))
      fail(schema, value, pointer);
    Json out = Json::array();
    for (std::size_t i = 0; i < value.size(); ++i)
      out.push_back(schema.contains("items") ? read(schema["items"], value[i], child_pointer(pointer, i)) : value[i]);
    if (schema.value("uniqueItems", false)) check_unique(out, pointer);
    return out;
  }

  // Whether the type of the value fits this schema.
  bool fits(const Json& unresolved, const Json& value) const {
    const Json& schema = resolved(unresolved);
    if (const Json* choices = alternatives(schema))
      return std::any_of(choices->begin(), choices->end(), [&](const Json& choice) { return fits(choice, value); });
    if (schema.contains("const")) return value == schema["const"];
    if (schema.contains("pattern") && value.is_string())
      return std::regex_search(value.get_ref<const std::string&>(), pattern_of(schema));
    const std::vector<std::string> types = types_of(schema);
    const bool typed = types.empty() || std::any_of(types.begin(), types.end(), [&](const std::string& type) {
                         return has_type(type == "integer" ? "number" : type, value);
                       });
    if (!typed || !value.is_array() || value.empty() || !schema.contains("items")) return typed;
    return fits(schema["items"], value.front());
  }

  Json read_choice(const Json& schema, const Json& choices, const Json& value, const std::string& pointer) const {
    std::vector<const Json*> fitting;
    for (const Json& choice : choices)
      if (fits(choice, value)) fitting.push_back(&resolved(choice));
    if (fitting.empty()) return read(nearest_choice(schema, choices, value, pointer), value, pointer);
    if (!value.is_object() || fitting.size() == 1) return read(*fitting.front(), value, pointer);
    return read_object(*variant_of(fitting, value, pointer), &choices, value, pointer);
  }

  // For a list whose items fit no choice, the first choice that is a list gives the best message.
  const Json& nearest_choice(const Json& schema, const Json& choices, const Json& value,
                             const std::string& pointer) const {
    for (const Json& choice : choices) {
      const Json& variant = resolved(choice);
      if (value.is_array() && variant.value("type", Json()) == "array") return variant;
    }
    fail(schema, value, pointer);
  }

  // The property whose constant identifies a variant.
  static std::string tag_of(const Json& variant) {
    for (const auto& [key, property] : variant["properties"].items())
      if (property.contains("const")) return key;
    return "";
  }

  const Json* variant_of(const std::vector<const Json*>& variants, const Json& value,
                         const std::string& pointer) const {
    const std::string tag = tag_of(*variants.front());
    std::vector<std::string> names;
    for (const Json* variant : variants) {
      const Json& property = (*variant)["properties"][tag];
      names.push_back(property["const"].get<std::string>());
      const Json given = value.contains(tag) ? value[tag] : property.value("default", Json());
      if (given == property["const"]) return variant;
    }
    if (!value.contains(tag))
      throw Error(text_.file, text_.where(pointer), "lacks the key '" + tag + "', allowed: " + joined(names));
    check_among(names, value[tag], child_pointer(pointer, tag));
    return variants.front();
  }

  Json read_object(const Json& schema, const Json* siblings, const Json& value, const std::string& pointer) const {
    const Json& properties = schema["properties"];
    for (const auto& [key, member] : value.items())
      if (!properties.contains(key)) fail_unknown(schema, siblings, key, pointer);
    check_keys(schema, value, pointer);

    const std::set<std::string> selected = selection(schema, value, pointer);
    Json out = Json::object();
    for (const auto& [key, unresolved] : properties.items()) {
      const Json& property = resolved(unresolved);
      const std::string member = child_pointer(pointer, key);
      const bool used = is_used(unresolved, selected);
      if (value.contains(key)) {
        if (!used) fail_unused(schema, unresolved, key, selected, member);
        out[key] = read(unresolved, value[key], member);
      } else if (used && (unresolved.contains("default") || property.contains("default"))) {
        const Json& default_value = unresolved.contains("default") ? unresolved["default"] : property["default"];
        out[key] = read(unresolved, default_value, member);
      }
    }
    return out;
  }

  void check_keys(const Json& schema, const Json& value, const std::string& pointer) const {
    if (const auto required = schema.find("required"); required != schema.end())
      for (const Json& key : *required)
        if (!value.contains(key.get_ref<const std::string&>()))
          throw Error(text_.file, text_.where(pointer), "lacks the key " + quoted(key));
    if (value.size() < schema.value("minProperties", std::size_t{0}) ||
        value.size() > schema.value("maxProperties", value.size()))
      throw Error(
          text_.file, text_.where(pointer),
          "found " + std::to_string(value.size()) + " keys, allowed: exactly one of " + joined(keys_of(schema)));
  }

  static std::vector<std::string> keys_of(const Json& schema) {
    std::vector<std::string> keys;
    for (const auto& [key, property] : schema["properties"].items()) keys.push_back(key);
    return keys;
  }

  [[noreturn]] void fail_unknown(const Json& schema, const Json* siblings, const std::string& key,
                                 const std::string& pointer) const {
    std::vector<std::string> owners;
    for (const Json& choice : siblings ? *siblings : Json::array()) {
      const Json& variant = resolved(choice);
      if (variant.contains("properties") && variant["properties"].contains(key))
        owners.push_back(variant["properties"][tag_of(variant)]["const"].get<std::string>());
    }
    const std::vector<std::string> allowed = keys_of(schema);
    const std::string where = text_.where_key(child_pointer(pointer, key));
    const std::string rest = ", allowed: " + joined(allowed);
    if (!owners.empty()) {
      const std::string own = schema["properties"][tag_of(schema)]["const"].get<std::string>();
      throw Error(text_.file, where, "'" + key + "' belongs to " + joined(owners) + ", not to " + own + rest);
    }
    throw Error(text_.file, where, "unknown key '" + key + "'" + did_you_mean(key, allowed) + rest);
  }

  // The values of the property that decides which other properties are used.
  std::set<std::string> selection(const Json& schema, const Json& value, const std::string& pointer) const {
    if (!schema.contains("x-selector")) return {};
    const std::string selector = schema["x-selector"].get<std::string>();
    const Json& property = schema["properties"][selector];
    const Json chosen = read(property, value.contains(selector) ? value[selector] : property["default"],
                             child_pointer(pointer, selector));
    if (chosen.is_string()) return {chosen.get<std::string>()};
    return chosen.get<std::set<std::string>>();
  }

  static bool is_used(const Json& property, const std::set<std::string>& selected) {
    if (!property.contains("x-used-by")) return true;
    return std::any_of(property["x-used-by"].begin(), property["x-used-by"].end(),
                       [&](const Json& user) { return selected.contains(user.get<std::string>()); });
  }

  [[noreturn]] void fail_unused(const Json& schema, const Json& property, const std::string& key,
                                const std::set<std::string>& selected, const std::string& pointer) const {
    const std::vector<std::string> chosen(selected.begin(), selected.end());
    throw Error(text_.file, text_.where_key(pointer),
                "'" + key + "' is used by " + schema["x-selector"].get<std::string>() + " " +
                    joined(texts_of(property["x-used-by"])) + ", not by " + joined(chosen));
  }

  const Json& root_;
  const JsonText& text_;
  mutable std::unordered_map<const Json*, const Json*> resolved_;
  mutable std::unordered_map<const Json*, std::optional<std::regex>> patterns_;
};

}  // namespace

std::string describe_allowed(const Json& root, const Json& unresolved) {
  const Json& schema = resolved(root, unresolved);
  std::vector<std::string> parts;
  if (const Json* choices = alternatives(schema)) {
    for (const Json& choice : *choices) {
      const std::string part = describe_allowed(root, choice);
      if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
    }
  } else if (schema.contains("const")) {
    parts.push_back(quoted(schema["const"]));
  } else {
    for (const std::string& type : types_of(schema)) parts.push_back(type_text(root, schema, type));
  }
  return joined(parts, " or ");
}

Json read_by_schema(const Json& schema, const Json& value, const JsonText& text) {
  return Reader(schema, text).read(schema, value, "");
}

Json read_member_by_schema(const Json& schema, const std::string& key, const Json& value, const JsonText& text) {
  return Reader(schema, text).read(schema["properties"][key], value, child_pointer("", key));
}

}  // namespace clusterbench::config
