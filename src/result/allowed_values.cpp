#include "result/allowed_values.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench::result {
namespace {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

void check_number(double value, const About& about, const std::string& where) {
  const auto refuse = [&](const std::string& allowed) {
    throw Error("", where,
                "is " + (std::isfinite(value) ? number_text(value) : std::string("no finite number")) +
                    "; allowed: " + allowed);
  };
  if (about.constant && value != *about.constant) refuse(std::to_string(*about.constant));
  if (about.is_finite && !std::isfinite(value)) refuse("a finite number");
  if (about.min && !(value >= *about.min)) refuse("at least " + number_text(*about.min));
  if (about.above_min && !(value > *about.above_min)) refuse("above " + number_text(*about.above_min));
  if (about.max && !(value <= *about.max)) refuse("at most " + number_text(*about.max));
}

void check_text(const std::string& value, const About& about, const std::string& where) {
  if (about.choices.empty()) return;
  const std::vector<std::string> words(about.choices.begin(), about.choices.end());
  if (std::ranges::find(words, value) != words.end()) return;
  throw Error("", where, "found '" + value + "'" + did_you_mean(value, words) + ", allowed: " + joined(words));
}

void check_value(const Type& type, const About& about, const void* value, const std::string& where);

void check_elements(const Type& type, const About& about, const void* list, const std::string& where) {
  const std::size_t size = type.size(list);
  if (type.kind == Kind::list && about.least_items > 0 && size < about.least_items)
    throw Error("", where,
                "has " + number_of(size, "element") + "; allowed: at least " + std::to_string(about.least_items));
  if (type.kind == Kind::list && about.most_items > 0 && size > about.most_items)
    throw Error("", where,
                "has " + number_of(size, "element") + "; allowed: at most " + std::to_string(about.most_items));
  for (std::size_t i = 0; i < size; ++i) {
    std::string element = where;
    if (type.kind == Kind::list) element += "/" + std::to_string(i);
    if (type.kind == Kind::by_name) element += "/" + type.name_at(list, i);
    check_value(*type.element, about, type.at(list, i), element);
  }
}

void check_value(const Type& type, const About& about, const void* value, const std::string& where) {
  switch (type.kind) {
    case Kind::integer:
    case Kind::number: {
      const Json number = type.to_json(value, false);
      return check_number(number.is_null() ? k_none : number.get<double>(), about, where);
    }
    case Kind::text:
      return check_text(type.to_json(value, false).get<std::string>(), about, where);
    case Kind::list:
    case Kind::by_name:
    case Kind::nullable:
      return check_elements(type, *type.definition != '\0' ? type.about : about, value, where);
    case Kind::object:
      return check_values(type, value, where);
    default:
      return;
  }
}

}  // namespace

void check_values(const Type& type, const void* record, const std::string& where) {
  for (const Field& field : type.fields)
    if (const void* value = field.in(record)) check_value(*field.type, field.about, value, where + "/" + field.name);
}

}  // namespace clusterbench::result
