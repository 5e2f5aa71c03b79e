#include "result/fields.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"

namespace clusterbench::result {
namespace {

Json list_to_json(const Type& type, const void* list, bool is_fraction, int threads);

// An object to which so many members are added at its end. Room for all of them is made at once: members cannot be
// moved, and an object that grows would copy each with all that it holds.
Json::object_t members_of(std::size_t count) {
  Json::object_t members;
  members.reserve(count);
  return members;
}

Json value_to_json(const Type& type, const void* value, bool is_in_fractions, int threads = 1) {
  const bool is_fraction = is_in_fractions || type.about.is_fraction;
  switch (type.kind) {
    case Kind::object:
      return to_json(type, value);
    case Kind::nullable:
      return type.size(value) == 0 ? Json() : value_to_json(*type.element, type.at(value, 0), is_fraction);
    case Kind::list:
    case Kind::by_name:
      return list_to_json(type, value, is_fraction, threads);
    default:
      return type.to_json(value, is_fraction);
  }
}

Json list_to_json(const Type& type, const void* list, bool is_fraction, int threads) {
  if (type.kind == Kind::by_name) {
    Json::object_t out = members_of(type.size(list));
    for (std::size_t i = 0; i < type.size(list); ++i)
      out[type.name_at(list, i)] = value_to_json(*type.element, type.at(list, i), is_fraction);
    return out;
  }
  constexpr std::size_t k_long_list = 64;
  std::vector<Json> out(type.size(list));
  parallel_ranges(out.size(), out.size() < k_long_list ? 1 : threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) out[i] = value_to_json(*type.element, type.at(list, i), is_fraction);
  });
  return out;
}

std::string wanted(const Type& type, const Json& found) {
  switch (type.kind) {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      if (type.is_unsigned && found.is_number() && found > type.largest)
        return "a whole number from 0 to " + std::to_string(type.largest);
      if (type.is_unsigned) return "a whole number of at least 0";
      return found.is_number_integer()
                 ? "a whole number from " + std::to_string(type.least) + " to " + std::to_string(type.largest)
                 : "a whole number";
    case Kind::number:
      return "a number or null";
    case Kind::text:
      return "a text";
    case Kind::list:
      return "a list";
    default:
      return "an object";
  }
}

// JSON made from an int is not marked as unsigned; above 2^63 - 1 it always is.
bool is_in_range(const Type& type, const Json& integer) {
  if (!integer.is_number_unsigned() && integer.get<std::int64_t>() < 0)
    return integer.get<std::int64_t>() >= type.least;
  return integer.get<std::uint64_t>() <= type.largest;
}

bool is_of_kind(const Type& type, const Json& json) {
  switch (type.kind) {
    case Kind::boolean:
      return json.is_boolean();
    case Kind::integer:
      return json.is_number_integer() && is_in_range(type, json);
    case Kind::number:
      return json.is_number() || json.is_null();
    case Kind::text:
      return json.is_string();
    case Kind::list:
      return json.is_array() && (type.fixed_size == 0 || json.size() == type.fixed_size);
    case Kind::object:
    case Kind::by_name:
      return json.is_object();
    default:
      return true;
  }
}

void plain_from_json(const Type& type, const Json& json, void* value, const std::string& where) {
  try {
    type.from_json(json, value);
  } catch (const Error& error) {
    throw Error("", where, error.message());
  }
}

void value_from_json(const Type& type, const Json& json, void* value, const std::string& where) {
  if (type.clear != nullptr) type.clear(value);
  if (type.kind == Kind::nullable) {
    if (!json.is_null()) value_from_json(*type.element, json, type.append(value, 0, ""), where);
    return;
  }
  if (!is_of_kind(type, json)) throw Error("", where, "must be " + wanted(type, json));
  if (type.kind == Kind::object) {
    from_json(type, json, value, where);
  } else if (type.kind == Kind::list) {
    for (std::size_t i = 0; i < json.size(); ++i)
      value_from_json(*type.element, json[i], type.append(value, i, ""), where + "/" + std::to_string(i));
  } else if (type.kind == Kind::by_name) {
    for (const auto& [name, element] : json.items())
      value_from_json(*type.element, element, type.append(value, 0, name), where + "/" + name);
  } else {
    plain_from_json(type, json, value, where);
  }
}

}  // namespace

void add_field(std::vector<Field>& fields, const char* name, const About& about, const Type& type, std::size_t offset,
               const OptionalAccess* optional) {
  fields.push_back({name, about, &type, offset, optional});
}

Json number_json(double value, bool is_fraction) {
  constexpr double k_exact_integers = 9007199254740992.0;
  if (!std::isfinite(value)) return nullptr;
  if (!is_fraction && std::floor(value) == value && std::abs(value) < k_exact_integers)
    return static_cast<std::int64_t>(value);
  return value;
}

Json to_json(const Type& type, const void* record, int threads) {
  Json::object_t out = members_of(type.fields.size());
  for (const Field& field : type.fields)
    if (const void* value = field.in(record))
      out.emplace_back(field.name, value_to_json(*field.type, value, field.about.is_fraction, threads));
  return out;
}

void from_json(const Type& type, const Json& json, void* record, const std::string& where) {
  std::size_t known = 0;
  for (const Field& field : type.fields) {
    const auto found = json.find(field.name);
    if (found != json.end()) {
      ++known;
      value_from_json(*field.type, *found, field.make_in(record), where + "/" + field.name);
    } else if (field.optional == nullptr && !field.about.is_late) {
      throw Error("", where + "/" + field.name, "is missing");
    }
  }
  if (known == json.size()) return;
  std::vector<std::string> names;
  for (const Field& field : type.fields) names.emplace_back(field.name);
  for (const auto& [name, value] : json.items())
    if (std::ranges::find(names, name) == names.end())
      throw Error("", where + "/" + name, "is not known" + did_you_mean(name, names) + "; allowed: " + joined(names));
}

}  // namespace clusterbench::result
