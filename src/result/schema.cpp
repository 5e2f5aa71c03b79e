#include "result/schema.h"

#include <cmath>

namespace clusterbench::result {
namespace {

// An integer if the bound is a whole number.
Json bound_json(double bound) {
  return std::floor(bound) == bound ? Json(static_cast<std::int64_t>(bound)) : Json(bound);
}

class SchemaWriter {
 public:
  Json document(const Type& type, const std::string& title, const std::string& description) {
    Json out{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}, {"description", description}};
    out.update(object_schema(type));
    if (!definitions_.empty()) out["definitions"] = definitions_;
    return out;
  }

 private:
  static void add_words(Json& out, const About& about) {
    if (*about.description != '\0') out["description"] = about.description;
    if (*about.unit != '\0') out["x-unit"] = about.unit;
    if (*about.over != '\0') out["x-over"] = about.over;
  }

  // The schema of a field; refers to the definition of a type that has one.
  Json field_schema(const Type& type, const About& about) {
    Json out = Json::object();
    if (*type.definition != '\0') {
      define(type);
      out["$ref"] = std::string("#/definitions/") + type.definition;
      add_words(out, about);
      return out;
    }
    add_words(out, about);
    out.update(value_schema(type, about));
    return out;
  }

  void define(const Type& type) {
    if (definitions_.contains(type.definition)) return;
    definitions_[type.definition] = nullptr;  // keeps its position
    Json out = Json::object();
    add_words(out, type.about);
    out.update(value_schema(type, type.about));
    definitions_[type.definition] = out;
  }

  Json value_schema(const Type& type, const About& about) {
    switch (type.kind) {
      case Kind::boolean:
        return {{"type", "boolean"}};
      case Kind::integer:
        return integer_schema(type, about);
      case Kind::number:
        return number_schema(about);
      case Kind::text:
        return text_schema(about);
      case Kind::list:
        return list_schema(type, about);
      case Kind::object: {
        Json out = object_schema(type);
        out.update(shape_of(type.about));
        return out;
      }
      case Kind::by_name:
        return {{"type", "object"}, {"additionalProperties", field_schema(*type.element, element_about(about))}};
      case Kind::nullable:
        return nullable_schema(type, about);
      default:
        return *about.shape != '\0' ? shape_of(about) : Json{{"type", "object"}};
    }
  }

  // The part of a list field's description that applies to each element.
  static About element_about(const About& about) {
    About of_each = about;
    of_each.description = about.of_each;
    of_each.unit = of_each.over = of_each.of_each = "";
    of_each.least_items = of_each.most_items = 0;
    return of_each;
  }

  static void add_bounds(Json& out, const About& about) {
    if (about.min) out["minimum"] = bound_json(*about.min);
    if (about.above_min) out["exclusiveMinimum"] = bound_json(*about.above_min);
    if (about.max) out["maximum"] = bound_json(*about.max);
  }

  static Json integer_schema(const Type& type, const About& about) {
    if (about.constant) return {{"type", "integer"}, {"const", *about.constant}};
    Json out{{"type", "integer"}};
    if (type.is_unsigned) out["minimum"] = 0;
    add_bounds(out, about);
    if (!type.is_unsigned && !about.min && !about.above_min) out["minimum"] = type.least;
    if (!type.is_unsigned && !about.max) out["maximum"] = type.largest;
    return out;
  }

  static Json number_schema(const About& about) {
    Json out{{"type", about.is_finite ? Json("number") : Json{"number", "null"}}};
    add_bounds(out, about);
    return out;
  }

  static Json shape_of(const About& about) { return *about.shape != '\0' ? Json::parse(about.shape) : Json::object(); }

  static Json text_schema(const About& about) {
    if (!about.choices.empty()) return {{"enum", about.choices}};
    Json out{{"type", "string"}};
    if (*about.pattern != '\0') out["pattern"] = about.pattern;
    return out;
  }

  Json list_schema(const Type& type, const About& about) {
    Json out{{"type", "array"}};
    const std::size_t least = type.fixed_size > 0 ? type.fixed_size : about.least_items,
                      most = type.fixed_size > 0 ? type.fixed_size : about.most_items;
    if (least > 0) out["minItems"] = least;
    if (most > 0) out["maxItems"] = most;
    About of_element = element_about(about);
    if (type.element->kind == Kind::object && *type.element->definition == '\0') of_element = type.element->about;
    out["items"] = field_schema(*type.element, of_element);
    return out;
  }

  Json nullable_schema(const Type& type, const About& about) {
    Json out = value_schema(*type.element, about);
    out["type"] = {out["type"], "null"};
    return out;
  }

  Json object_schema(const Type& type) {
    Json properties = Json::object(), required = Json::array(), late = Json::array();
    for (const Field& field : type.fields) {
      properties[field.name] = field_schema(*field.type, field.about);
      if (field.about.is_late)
        late.push_back(field.name);
      else if (field.optional == nullptr)
        required.push_back(field.name);
    }
    Json out{{"type", "object"}, {"properties", properties}};
    if (!required.empty()) out["required"] = required;
    if (!late.empty()) out["x-written"] = late;
    out["additionalProperties"] = false;
    return out;
  }

  Json definitions_ = Json::object();
};

}  // namespace

Json schema_of(const Type& type, const std::string& title, const std::string& description) {
  return SchemaWriter().document(type, title, description);
}

}  // namespace clusterbench::result
