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
  if (const auto* asked = std::get_if<double>(&value)) return number(*asked);
  return "'" + std::get<std::string>(value) + "'";
}

void check_number(const ParamSpec& spec, double asked) {
  const bool fits = asked >= spec.min && asked <= spec.max && (!spec.whole || asked == std::floor(asked));
  if (!fits)
    throw Error("", spec.name,
                "is " + number(asked) + "; allowed: " + (spec.whole ? "whole numbers from " : "") + number(spec.min) +
                    " to " + number(spec.max) + (spec.unit.empty() ? "" : " " + spec.unit));
}

void check_choice(const ParamSpec& spec, const std::string& asked) {
  if (std::find(spec.choices.begin(), spec.choices.end(), asked) == spec.choices.end())
    throw Error("", spec.name,
                "is '" + asked + "'" + did_you_mean(asked, spec.choices) + "; allowed: " + joined(spec.choices));
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
    throw Error("", spec.name, "is " + shown(value) + "; it must be " + type_name(spec.default_value));
  if (const auto* asked = std::get_if<double>(&value)) check_number(spec, *asked);
  if (const auto* asked = std::get_if<std::string>(&value)) check_choice(spec, *asked);
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
