#include "config/config_keys.h"

#include "core/error.h"

namespace clusterbench::result {
namespace {

// An enumeration by the names that the function gives its values.
template <class Enum, const char* (*name)(Enum), Enum... values>
Type named_values() {
  Type type{Kind::text};
  type.to_json = [](const void* value, bool) { return Json(name(*static_cast<const Enum*>(value))); };
  type.from_json = [](const Json& json, void* value) {
    const auto set_if_named = [&](Enum one) {
      if (json != name(one)) return false;
      *static_cast<Enum*>(value) = one;
      return true;
    };
    if (!(set_if_named(values) || ...)) throw Error("", "", "found " + json.dump() + ", which has no value");
  };
  return type;
}

// A vector as a list of its numbers.
template <class Vec>
Type vector_type() {
  Type type{Kind::list};
  type.element = &type_of<typename Vec::value_type>();
  type.fixed_size = static_cast<std::size_t>(Vec::length());
  type.size = [](const void*) { return static_cast<std::size_t>(Vec::length()); };
  type.at = [](const void* vector, std::size_t i) -> const void* {
    return &(*static_cast<const Vec*>(vector))[static_cast<int>(i)];
  };
  type.append = [](void* vector, std::size_t i, const std::string&) -> void* {
    return &(*static_cast<Vec*>(vector))[static_cast<int>(i)];
  };
  return type;
}

// The keys of a struct of another layer. Numbers that are no integers are written as 2.0.
template <class Record>
struct Keys {
  Type type{Kind::object};

  template <auto member>
  Keys& add(const char* name) {
    FieldCollector<Record>(type.fields).template add<member>(name, About().as_fraction());
    return *this;
  }
};

}  // namespace

KEY_TYPE(Vec3i) {
  return vector_type<Vec3i>();
}

KEY_TYPE(std::filesystem::path) {
  using std::filesystem::path;
  Type type;
  type.to_json = [](const void* value, bool) {
    const auto& given = *static_cast<const path*>(value);
    return given.empty() ? Json() : Json(given.string());
  };
  type.from_json = [](const Json& json, void* value) {
    *static_cast<path*>(value) = json.is_null() ? path() : path(json.get<std::string>());
  };
  return type;
}

KEY_TYPE(view::Packing) {
  using enum view::Packing;
  return named_values<view::Packing, view::packing_name, float32, half, unorm16>();
}
KEY_TYPE(depth::TexelBound) {
  using enum depth::TexelBound;
  return named_values<depth::TexelBound, depth::name_of, proven, sampled>();
}

KEY_TYPE(measure::Logarithm) {
  using enum measure::Logarithm;
  return named_values<measure::Logarithm, measure::name_of, rounded, glsl, fast>();
}
KEY_TYPE(measure::DepthRead) {
  using enum measure::DepthRead;
  return named_values<measure::DepthRead, measure::name_of, given, d32f, d24>();
}
KEY_TYPE(measure::AllocationRule) {
  using Rule = measure::AllocationRule;
  return Keys<Rule>().add<&Rule::margin>("margin").add<&Rule::warn_at>("warn_at").type;
}

KEY_TYPE(config::LimitRule) {
  Type type{Kind::text};
  type.to_json = [](const void* value, bool) { return Json(static_cast<const config::LimitRule*>(value)->text()); };
  type.from_json = [](const Json& json, void* value) {
    *static_cast<config::LimitRule*>(value) = config::limit_rule(json.get<std::string>(), "", "");
  };
  return type;
}

}  // namespace clusterbench::result
