#pragma once
// Records: plain structs that list each field once, with its name, meaning, unit, and the range that it covers.
//
//   struct Spread {
//     RECORD(Spread);
//     FIELD(double, mean, "Arithmetic mean");
//     FIELD(std::optional<double>, max, About("Largest", "m", "all frames").at_least(0));
//     END_RECORD;
//   };
//
// A record that derives from another lists the other's fields after its own with `using Rest = Other;`.
// These lists give a record's JSON, its reader, and its JSON Schema (schema.h). A std::optional without a value is
// absent, a Nullable without a value is null, and so is a double that is not finite.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace clusterbench::result {

using Json = nlohmann::ordered_json;

inline constexpr double k_none = std::numeric_limits<double>::quiet_NaN();

// The rule for a field that differs between two compared results.
enum class Compares : std::uint8_t {
  as_holder,  // the rule of the struct that holds it; for a field of a case: fixed
  fixed,      // must be equal
  cost,       // less is better
  follows,    // repeats some cost in another form
  unjudged,   // no cost by itself: how the truth was decided, effects of limits on counts
  skipped     // not compared
};

// The description of a field. "" for `unit` or `over`: inherited from the enclosing field.
struct About {
  About(const char* what = "", const char* in_unit = "", const char* taken_over = "", Compares as = Compares::as_holder)
      : description(what), unit(in_unit), over(taken_over), compares(as) {}
  About(const char* what, Compares as) : About(what, "", "", as) {}
  About(const char* what, const char* in_unit, Compares as) : About(what, in_unit, "", as) {}

  About at_least(double least) const { return with(&About::min, least); }
  About above(double bound) const { return with(&About::above_min, bound); }
  About at_most(double most) const { return with(&About::max, most); }
  About finite() const { return with(&About::is_finite, true); }         // a number that is never null
  About as_fraction() const { return with(&About::is_fraction, true); }  // written as 2.0, not 2
  About one_of(std::vector<const char*> words) const { return with(&About::choices, std::move(words)); }
  About matches(const char* expression) const { return with(&About::pattern, expression); }
  About items(std::size_t least, std::size_t most) const {
    return with(&About::least_items, least).with(&About::most_items, most);
  }
  About each(const char* meaning) const { return with(&About::of_each, meaning); }
  About always(int value) const { return with(&About::constant, value); }
  About shaped(const char* json_schema) const { return with(&About::shape, json_schema); }
  About late() const { return with(&About::is_late, true); }

  const char *description, *unit, *over;
  Compares compares;                                // for a struct: of all its fields without their own rule
  std::optional<double> min{}, above_min{}, max{};  // of a number, or of each number of a list
  bool is_finite = false;
  bool is_fraction = false;
  std::vector<const char*> choices{};           // of a text
  const char* pattern = "";                     // of a text
  std::size_t least_items = 0, most_items = 0;  // of a list; 0: any number
  const char* of_each = "";                     // description of the values by name
  std::optional<int> constant{};                // of a whole number
  const char* shape = "";                       // of any JSON: its schema; of a struct: further keywords of its schema
  bool is_late = false;                         // always written; documents of earlier versions may not have it

 private:
  template <class T, class Value>
  About with(T About::*part, Value value) const {
    About copy = *this;
    copy.*part = std::move(value);
    return copy;
  }
};

// Null without a value.
template <class T>
struct Nullable : std::optional<T> {
  using std::optional<T>::optional;
  using std::optional<T>::operator=;
};

// Values by name, in the order of output.
template <class T>
using ByName = std::vector<std::pair<std::string, T>>;

enum class Kind : std::uint8_t { boolean, integer, number, text, list, object, by_name, nullable, json };

struct Type;

// The value of a std::optional: null if it is absent; a new one.
struct OptionalAccess {
  const void* (*get)(const void* optional) = nullptr;
  void* (*make)(void* optional) = nullptr;
};

struct Field {
  std::string name;
  About about;
  const Type* type = nullptr;
  std::size_t offset = 0;                    // in its record
  const OptionalAccess* optional = nullptr;  // of a field that can be absent

  // Null if it is absent.
  const void* in(const void* record) const {
    const void* member = static_cast<const char*>(record) + offset;
    return optional == nullptr ? member : optional->get(member);
  }
  // Creates an absent one.
  void* make_in(void* record) const {
    void* member = static_cast<char*>(record) + offset;
    return optional == nullptr ? member : optional->make(member);
  }
};

// Reading and writing of values of a C++ type.
struct Type {
  Kind kind = Kind::json;
  About about{};                // for a struct with its own description
  const char* definition = "";  // name of its definition in the schema, which is written once; "": in place
  bool is_unsigned = false;     // an integer
  std::int64_t least = 0;       // an integer
  std::uint64_t largest = 0;    // an integer
  std::vector<Field> fields{};  // of an object
  // Of a list, values by name, or a nullable one (a list of one element or none).
  const Type* element = nullptr;
  std::size_t fixed_size = 0;  // of a list with a fixed length
  std::size_t (*size)(const void* list) = nullptr;
  const void* (*at)(const void* list, std::size_t index) = nullptr;
  const std::string& (*name_at)(const void* list, std::size_t index) = nullptr;
  void* (*append)(void* list, std::size_t index, const std::string& name) = nullptr;
  // Of values by name, a nullable one, or a list of any length. Null for all other types: a list of a fixed length, and
  // every type with a form of its own.
  void (*clear)(void* list) = nullptr;
  // Of a plain value. from_json throws Error, without a location, for a value that it cannot read.
  Json (*to_json)(const void* value, bool is_fraction) = nullptr;
  void (*from_json)(const Json& json, void* value) = nullptr;  // of its kind
};

template <class T>
const Type& type_of();

template <class T>
T initial() {
  if constexpr (std::is_same_v<T, double>)
    return k_none;
  else
    return T{};
}

// C++20 cannot list the members of a struct, so these macros do: a field is identified by its source line.
#define RECORD(Name) \
  using Self = Name; \
  static constexpr int k_first_line = __LINE__
#define FIELD_AS(name, Type, member, ...)                \
  Type member = ::clusterbench::result::initial<Type>(); \
  LIST_FIELD(name, member, ::clusterbench::result::About(__VA_ARGS__))
#define LIST_FIELD(name, member, about)                               \
  template <class F>                                                  \
  static void list(F& field, std::integral_constant<int, __LINE__>) { \
    field.add(name, about, &Self::member);                            \
  }                                                                   \
  static_assert(true)
#define FIELD(Type, member, ...) FIELD_AS(#member, Type, member, __VA_ARGS__)
#define END_RECORD static constexpr int k_last_line = __LINE__

// Not in the class: hundreds of its instances would each build a field anew.
void add_field(std::vector<Field>& fields, const char* name, const About& about, const Type& type, std::size_t offset,
               const OptionalAccess* optional = nullptr);

// Collects the fields of a record, its own and those of its Rest.
template <class Record>
class FieldCollector {
 public:
  explicit FieldCollector(std::vector<Field>& fields) : fields_(fields) {}

  template <class Holder, class T>
  void add(const char* name, const About& about, T Holder::*member) {
    add_field(fields_, name, about, type_of<T>(), offset_of(member));
  }
  template <class Holder, class T>
  void add(const char* name, const About& about, std::optional<T> Holder::*member) {
    static constexpr OptionalAccess k_access{
        [](const void* optional) -> const void* {
          const auto& value = *static_cast<const std::optional<T>*>(optional);
          return value ? &*value : nullptr;
        },
        [](void* optional) -> void* { return &static_cast<std::optional<T>*>(optional)->emplace(); }};
    add_field(fields_, name, about, type_of<T>(), offset_of(member), &k_access);
  }

 private:
  template <class Member>
  std::size_t offset_of(Member member) const {
    return static_cast<std::size_t>(reinterpret_cast<const char*>(&(record_.*member)) -
                                    reinterpret_cast<const char*>(&record_));
  }

  const Record record_{};
  std::vector<Field>& fields_;
};

Json number_json(double value, bool is_fraction);  // null if it is not finite

namespace detail {

template <class T>
inline constexpr bool is_nullable = false;
template <class T>
inline constexpr bool is_nullable<Nullable<T>> = true;
template <class T>
inline constexpr bool is_by_name = false;
template <class T>
inline constexpr bool is_by_name<ByName<T>> = true;

template <class T>
Type plain(Kind kind) {
  Type type{kind};
  type.to_json = [](const void* value, bool) { return Json(*static_cast<const T*>(value)); };
  type.from_json = [](const Json& json, void* value) { *static_cast<T*>(value) = json.get<T>(); };
  return type;
}

inline Type number() {
  Type type{Kind::number};
  type.to_json = [](const void* value, bool is_fraction) {
    return number_json(*static_cast<const double*>(value), is_fraction);
  };
  type.from_json = [](const Json& json, void* value) {
    *static_cast<double*>(value) = json.is_null() ? k_none : json.get<double>();
  };
  return type;
}

template <class T>
Type nullable() {
  using Value = typename T::value_type;
  Type type{Kind::nullable};
  type.element = &type_of<Value>();
  type.size = [](const void* value) -> std::size_t { return static_cast<const T*>(value)->has_value() ? 1 : 0; };
  type.at = [](const void* value, std::size_t) -> const void* { return &**static_cast<const T*>(value); };
  type.append = [](void* value, std::size_t, const std::string&) -> void* {
    return &static_cast<T*>(value)->emplace();
  };
  type.clear = [](void* value) { static_cast<T*>(value)->reset(); };
  return type;
}

template <class T>
Type by_name() {
  Type type{Kind::by_name};
  type.element = &type_of<typename T::value_type::second_type>();
  type.size = [](const void* list) { return static_cast<const T*>(list)->size(); };
  type.at = [](const void* list, std::size_t i) -> const void* { return &(*static_cast<const T*>(list))[i].second; };
  type.name_at = [](const void* list, std::size_t i) -> const std::string& {
    return (*static_cast<const T*>(list))[i].first;
  };
  type.append = [](void* list, std::size_t, const std::string& name) -> void* {
    T& all = *static_cast<T*>(list);
    all.emplace_back();
    all.back().first = name;
    return &all.back().second;
  };
  type.clear = [](void* list) { static_cast<T*>(list)->clear(); };
  return type;
}

// A std::vector, or a std::array and types derived from it.
template <class T>
Type list() {
  Type type{Kind::list};
  type.element = &type_of<typename T::value_type>();
  type.size = [](const void* list) { return static_cast<const T*>(list)->size(); };
  type.at = [](const void* list, std::size_t i) -> const void* { return &(*static_cast<const T*>(list))[i]; };
  if constexpr (requires(T & list) { list.emplace_back(); }) {
    type.append = [](void* list, std::size_t, const std::string&) -> void* {
      T& all = *static_cast<T*>(list);
      all.emplace_back();
      return &all.back();
    };
    type.clear = [](void* list) { static_cast<T*>(list)->clear(); };
  } else {
    type.fixed_size = T{}.size();
    type.append = [](void* list, std::size_t i, const std::string&) -> void* { return &(*static_cast<T*>(list))[i]; };
  }
  return type;
}

}  // namespace detail

template <class Record, class F, int... Lines>
void list_lines(F& field, std::integer_sequence<int, Lines...>) {
  const auto list_one = [&]<int Line>(std::integral_constant<int, Line> line) {
    if constexpr (requires { Record::list(field, line); }) Record::list(field, line);
  };
  (list_one(std::integral_constant<int, Record::k_first_line + Lines>()), ...);
}

// Calls field(name, member, about) for each field of a record, in the order of their lines.
template <class Record, class F>
void list_fields(F& field) {
  list_lines<Record>(field, std::make_integer_sequence<int, Record::k_last_line - Record::k_first_line>());
}

template <class T>
Type make_type() {
  if constexpr (std::is_same_v<T, bool>) {
    return detail::plain<bool>(Kind::boolean);
  } else if constexpr (std::is_integral_v<T>) {
    Type type = detail::plain<T>(Kind::integer);
    type.is_unsigned = std::is_unsigned_v<T>;
    type.least = static_cast<std::int64_t>(std::numeric_limits<T>::min());
    type.largest = static_cast<std::uint64_t>(std::numeric_limits<T>::max());
    return type;
  } else if constexpr (std::is_same_v<T, double>) {
    return detail::number();
  } else if constexpr (std::is_same_v<T, std::string>) {
    return detail::plain<std::string>(Kind::text);
  } else if constexpr (std::is_same_v<T, Json>) {
    return detail::plain<Json>(Kind::json);
  } else if constexpr (detail::is_nullable<T>) {
    return detail::nullable<T>();
  } else if constexpr (detail::is_by_name<T>) {
    return detail::by_name<T>();
  } else if constexpr (requires(T & list) { list.size(); }) {
    Type type = detail::list<T>();
    if constexpr (requires { T::k_definition; }) {
      type.definition = T::k_definition;
      type.about = T::about();
    }
    return type;
  } else {
    Type type{Kind::object};
    if constexpr (requires { T::k_definition; }) type.definition = T::k_definition;
    if constexpr (requires { T::about(); }) type.about = T::about();
    FieldCollector<T> collect(type.fields);
    list_fields<T>(collect);
    if constexpr (requires { typename T::Rest; }) list_fields<typename T::Rest>(collect);
    return type;
  }
}

template <class T>
const Type& type_of() {
  static const Type type = make_type<T>();
  return type;
}

// The JSON of a record of the given type, fields in their order. `threads` share long lists.
Json to_json(const Type& type, const void* record, int threads = 1);
// Fills a record; optional and late fields that the JSON lacks keep their value. Throws Error (where: the JSON pointer
// below `where`) for a value of another type than its field's, and for a missing or unknown field. Does not check
// ranges of values; the schema does.
void from_json(const Type& type, const Json& json, void* record, const std::string& where);

template <class Record>
Json to_json(const Record& record, int threads = 1) {
  return to_json(type_of<Record>(), &record, threads);
}
template <class Record>
Record from_json(const Json& json, const std::string& where = "") {
  Record record;
  from_json(type_of<Record>(), json, &record, where);
  return record;
}

}  // namespace clusterbench::result
