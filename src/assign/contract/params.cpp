#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assign/contract/assigner.h"
#include "core/error.h"
#include "core/text.h"

namespace clusterbench::assign {
namespace {

std::string type_name(const ParamValue& value) {
  constexpr const char* k_names[] = {"true or false", "a number", "a text"};
  return k_names[value.index()];
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string shown(const ParamValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* given = std::get_if<double>(&value)) return number(*given);
  return "'" + std::get<std::string>(value) + "'";
}

void check_number(const ParamSpec& spec, double given) {
  const bool fits = given >= spec.min && given <= spec.max && (!spec.whole || given == std::floor(given));
  if (!fits)
    throw Error("", spec.name,
                "is " + number(given) + "; allowed: " + (spec.whole ? "whole numbers from " : "") + number(spec.min) +
                    " to " + number(spec.max) + (spec.unit.empty() ? "" : " " + spec.unit));
}

void check_choice(const ParamSpec& spec, const std::string& given) {
  if (std::find(spec.choices.begin(), spec.choices.end(), given) == spec.choices.end())
    throw Error("", spec.name,
                "is '" + given + "'" + did_you_mean(given, spec.choices) + "; allowed: " + joined(spec.choices));
}

const ParamSpec& spec_of(std::span<const ParamSpec> specs, const std::string& name) {
  std::vector<std::string> names;
  for (const ParamSpec& spec : specs) {
    if (spec.name == name) return spec;
    names.push_back(spec.name);
  }
  throw Error("", name,
              names.empty() ? "is not a parameter; there are none"
                            : "is not a parameter" + did_you_mean(name, names) + "; there are: " + joined(names));
}

void check(const ParamSpec& spec, const ParamValue& value) {
  if (value.index() != spec.default_value.index())
    throw Error("", spec.name,
                "is " + shown(value) + "; it must be " + type_name(spec.default_value) +
                    (spec.choices.empty() ? "" : ", one of: " + joined(spec.choices)));
  if (const auto* given = std::get_if<double>(&value)) check_number(spec, *given);
  if (const auto* given = std::get_if<std::string>(&value)) check_choice(spec, *given);
}

}  // namespace

ParamValue current_value(const ParamSpec& spec, const ParamValue& value) {
  for (const auto& [former, current] : spec.former)
    if (value == ParamValue(former)) return current;
  return value;
}

ParamValue first_value(const ParamSpec& spec, const ParamValue& value) {
  for (const auto& [former, current] : spec.former)
    if (value == ParamValue(current)) return former;
  return value;
}

Params::Params(std::span<const ParamSpec> specs) {
  for (const ParamSpec& spec : specs) values_[spec.name] = spec.default_value;
}

Params::Params(std::span<const ParamSpec> specs, const std::map<std::string, ParamValue>& given) : Params(specs) {
  for (const auto& [name, value] : given) {
    const ParamSpec& spec = spec_of(specs, name);
    const ParamValue current = current_value(spec, value);
    check(spec, current);
    values_[name] = current;
  }
}

}  // namespace clusterbench::assign
