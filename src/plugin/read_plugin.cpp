#include "plugin/read_plugin.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench::plugin {
namespace {

constexpr std::uint32_t k_most_methods = 64, k_most_parameters = 64, k_most_choices = 64, k_largest_struct = 1u << 16;
constexpr std::size_t k_longest_name = 64, k_longest_text = 1000;

// A place in a plug-in's data: "method 'tiles', parameter 2".
struct Place {
  std::string file, where;

  [[noreturn]] void fail(const std::string& message) const { throw Error(file, where, message); }
  Place at(const std::string& part) const { return {file, where.empty() ? part : where + ", " + part}; }
};

// The members that the plug-in has; the others are 0. `least`: the size of version 1.0.
template <class Struct>
Struct known_part(const Struct* given, std::size_t least, const Place& place) {
  if (given == nullptr) place.fail("is a null pointer; takes a struct");
  const std::uint32_t size = given->struct_size;
  if (size < least || size > k_largest_struct)
    place.fail("struct_size is " + std::to_string(size) + "; takes " + std::to_string(least) + " to " +
               std::to_string(k_largest_struct));
  Struct out{};
  std::memcpy(&out, given, std::min<std::size_t>(size, sizeof out));
  return out;
}

std::string text_of(const char* given, std::size_t longest, const Place& place) {
  if (given == nullptr) place.fail("is a null pointer; takes a text");
  const std::size_t length = strnlen(given, longest + 1);
  const std::string allowed = "; takes a text of 1 to " + std::to_string(longest) + " bytes";
  if (length > longest) place.fail("is longer than " + std::to_string(longest) + " bytes" + allowed);
  std::string text(given, length);
  if (text.empty()) place.fail("is empty" + allowed);
  if (printable(text) != text) place.fail("has a character that is none: takes one line of UTF-8");
  return text;
}

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_name_with(std::string_view name, std::string_view others) {
  const auto is_allowed = [&](char c) { return is_letter(c) || is_digit(c) || others.find(c) != others.npos; };
  return !name.empty() && name.size() <= k_longest_name && is_letter(name.front()) &&
         std::ranges::all_of(name, is_allowed);
}

std::string name_of(const char* given, std::string_view others, const Place& place) {
  std::string name = text_of(given, k_longest_name, place);
  if (!is_name_with(name, others))
    place.fail("is '" + name + "'; takes lower-case letters, digits and " + (others.size() > 1 ? "'-', '_'" : "'-'") +
               ", beginning with a letter");
  return name;
}

bool has(std::uint32_t bits, std::uint32_t bit) {
  return (bits & bit) != 0;
}

void read_number(const clusterbench_parameter& given, const Place& place, assign::ParamSpec& out) {
  out.min = given.min;
  out.max = given.max;
  out.whole = has(given.flags, CLUSTERBENCH_PARAMETER_WHOLE);
  out.is_thread_count = has(given.flags, CLUSTERBENCH_PARAMETER_THREADS);
  out.default_value = given.default_number;
  if (!std::isfinite(given.min) || !std::isfinite(given.max) || given.min > given.max)
    place.fail("min and max must be finite, min not above max");
  if (!(given.default_number >= given.min && given.default_number <= given.max))
    place.fail("the default is not between min and max");
  if (out.whole && given.default_number != std::floor(given.default_number))
    place.fail("the default is no whole number");
  if (out.is_thread_count && (!out.whole || given.min < 1.0)) place.fail("counts threads: takes whole numbers from 1");
  if (!has(given.flags, CLUSTERBENCH_PARAMETER_CONSERVATIVE_FROM)) return;
  if (!std::isfinite(given.conservative_from)) place.fail("conservative_from is no finite number");
  if (given.conservative_from < given.min || given.conservative_from > given.max)
    place.fail("conservative_from is not between min and max");
  out.conservative_from = given.conservative_from;
}

void read_choices(const clusterbench_parameter& given, const Place& place, assign::ParamSpec& out) {
  if (given.choice_count == 0 || given.choice_count > k_most_choices)
    place.fail("choice_count is " + std::to_string(given.choice_count) + "; takes 1 to " +
               std::to_string(k_most_choices));
  if (given.choices == nullptr) place.fail("choices is a null pointer; takes choice_count texts");
  for (std::uint32_t i = 0; i < given.choice_count; ++i) {
    const Place choice = place.at("choice " + std::to_string(i));
    out.choices.push_back(text_of(given.choices[i], k_longest_name, choice));
    if (std::count(out.choices.begin(), out.choices.end(), out.choices.back()) > 1)
      choice.fail("'" + out.choices.back() + "' is there twice");
  }
  const std::string standard = text_of(given.default_text, k_longest_name, place.at("default_text"));
  if (std::ranges::find(out.choices, standard) == out.choices.end())
    place.fail("the default '" + standard + "' is none of " + joined(out.choices));
  out.default_value = standard;
}

assign::ParamSpec read_parameter(const clusterbench_parameter* from, Place place) {
  const clusterbench_parameter given = known_part(from, sizeof(clusterbench_parameter), place);
  assign::ParamSpec out;
  out.name = name_of(given.name, "-_", place.at("name"));
  place.where = place.where.substr(0, place.where.rfind(' ') + 1) + "'" + out.name + "'";
  if (out.name == "name") place.fail("is no name for a parameter: configurations have the method's there");
  out.summary = text_of(given.summary, k_longest_text, place.at("summary"));
  if (given.unit != nullptr && given.unit[0] != '\0') out.unit = text_of(given.unit, k_longest_name, place.at("unit"));
  switch (given.type) {
    case CLUSTERBENCH_PARAMETER_FLAG:
      if (given.default_number != 0.0 && given.default_number != 1.0) place.fail("the default of a flag is 0 or 1");
      out.default_value = given.default_number != 0.0;
      break;
    case CLUSTERBENCH_PARAMETER_NUMBER:
      read_number(given, place, out);
      break;
    case CLUSTERBENCH_PARAMETER_TEXT:
      read_choices(given, place, out);
      break;
    default:
      place.fail("type is " + std::to_string(given.type) + "; takes 1 (flag), 2 (number) or 3 (text)");
  }
  return out;
}

constexpr std::pair<std::uint32_t, grid::Kind> k_grid_kinds[] = {
    {CLUSTERBENCH_FRUSTUM, grid::Kind::frustum},
    {CLUSTERBENCH_DISTANCE, grid::Kind::distance},
    {CLUSTERBENCH_CASCADES, grid::Kind::cascades},
    {CLUSTERBENCH_WORLD, grid::Kind::world},
};

void read_bits(const clusterbench_method& given, const Place& place, assign::AssignerDescriptor& out) {
  for (const auto& [bit, kind] : k_grid_kinds)
    if (has(given.grid_kinds, bit)) out.kinds.push_back(kind);
  if (out.kinds.empty()) place.fail("grid_kinds has no kind of grid; takes a sum of 1, 2, 4 and 8");
  out.points = has(given.light_types, CLUSTERBENCH_POINTS);
  out.spots = has(given.light_types, CLUSTERBENCH_SPOTS);
  out.boxes = has(given.light_types, CLUSTERBENCH_BOXES);
  if (!out.points && !out.spots && !out.boxes)
    place.fail("light_types has no type of light; takes a sum of 1, 2 and 4");
  out.needs.depth = has(given.needs, CLUSTERBENCH_NEEDS_DEPTH);
  out.conservative = has(given.flags, CLUSTERBENCH_CONSERVATIVE);
  out.exact = has(given.flags, CLUSTERBENCH_EXACT);
  out.orthographic = has(given.flags, CLUSTERBENCH_ORTHOGRAPHIC);
  out.all_pairs = has(given.flags, CLUSTERBENCH_ALL_PAIRS);
  out.by_name = has(given.flags, CLUSTERBENCH_BY_NAME);
  if (out.exact && !out.conservative) place.fail("says that it is exact, but not that it is conservative");
}

void check_functions(const clusterbench_method& given, const Place& place) {
  const auto check = [&](bool is_there, const char* name) {
    if (!is_there) place.at(name).fail("is a null pointer; a method has create, build, assign and destroy");
  };
  check(given.create != nullptr, "create");
  check(given.build != nullptr, "build");
  check(given.assign != nullptr, "assign");
  check(given.destroy != nullptr, "destroy");
}

void read_parameters(const clusterbench_method& given, const Place& place, std::vector<assign::ParamSpec>& out) {
  if (given.parameter_count > k_most_parameters)
    place.fail("parameter_count is " + std::to_string(given.parameter_count) + "; takes at most " +
               std::to_string(k_most_parameters));
  if (given.parameter_count > 0 && given.parameters == nullptr)
    place.fail("parameters is a null pointer; takes parameter_count of them, or a parameter_count of 0");
  for (std::uint32_t i = 0; i < given.parameter_count; ++i) {
    out.push_back(read_parameter(given.parameters[i], place.at("parameter " + std::to_string(i))));
    if (std::ranges::count(out, out.back().name, &assign::ParamSpec::name) > 1)
      place.fail("has two parameters '" + out.back().name + "'");
  }
}

// A method that is conservative is so as it comes.
void check_promise(const assign::AssignerDescriptor& descriptor, const Place& place) {
  if (!descriptor.conservative) return;
  for (const assign::ParamSpec& spec : descriptor.params) {
    const auto* standard = std::get_if<double>(&spec.default_value);
    if (standard != nullptr && *standard < spec.conservative_from)
      place.at("parameter '" + spec.name + "'")
          .fail(
              "the default is below conservative_from, but the method says that it is conservative; allowed: a default "
              "from there on, or a method without CLUSTERBENCH_CONSERVATIVE");
  }
}

MethodFacts read_method(const clusterbench_method* from, const std::string& id, Place place) {
  MethodFacts out;
  out.own = from;
  out.table = known_part(from, sizeof(clusterbench_method), place);
  const std::string name = name_of(out.table.name, "-", place.at("name"));
  place.where = "method '" + name + "'";
  assign::AssignerDescriptor& descriptor = out.descriptor;
  descriptor.name = id + "." + name;
  descriptor.plugin = id;
  descriptor.summary = text_of(out.table.summary, k_longest_text, place.at("summary"));
  descriptor.source = text_of(out.table.source, k_longest_text, place.at("source"));
  check_functions(out.table, place);
  read_bits(out.table, place, descriptor);
  read_parameters(out.table, place, descriptor.params);
  check_promise(descriptor, place);
  out.unknown_needs = out.table.needs & ~std::uint32_t{CLUSTERBENCH_NEEDS_DEPTH};
  return out;
}

std::string version_text(std::uint32_t major, std::uint32_t minor) {
  return std::to_string(major) + "." + std::to_string(minor);
}

}  // namespace

bool is_name(std::string_view text) {
  return is_name_with(text, "-");
}

PluginFacts read_plugin(const std::string& file, const clusterbench_plugin* given, const std::string& id) {
  const Place place{file, ""};
  if (given == nullptr) place.fail("does not work with this program: clusterbench_plugin_entry() returned no plug-in");
  if (given->struct_size < offsetof(clusterbench_plugin, method_count))
    place.fail("is no plug-in: its struct_size is " + std::to_string(given->struct_size) + "; takes " +
               std::to_string(sizeof(clusterbench_plugin)) + " to " + std::to_string(k_largest_struct) +
               ", and then major and minor");
  if (given->major != CLUSTERBENCH_PLUGIN_MAJOR)
    place.fail("is made for version " + version_text(given->major, given->minor) +
               " of the interface; this program takes versions " + std::to_string(CLUSTERBENCH_PLUGIN_MAJOR) +
               ".0 and later ones of " + std::to_string(CLUSTERBENCH_PLUGIN_MAJOR));
  const clusterbench_plugin known = known_part(given, sizeof(clusterbench_plugin), place);
  PluginFacts out;
  out.minor = known.minor;
  out.id = name_of(known.id, "-", place.at("id"));
  if (!id.empty()) out.id = id;
  out.name = text_of(known.name, k_longest_text, place.at("name"));
  out.version = text_of(known.version, k_longest_name, place.at("version"));
  if (known.method_count == 0 || known.method_count > k_most_methods)
    place.fail("method_count is " + std::to_string(known.method_count) + "; takes 1 to " +
               std::to_string(k_most_methods));
  if (known.methods == nullptr) place.fail("methods is a null pointer; takes method_count of them");
  for (std::uint32_t i = 0; i < known.method_count; ++i) {
    out.methods.push_back(read_method(known.methods[i], out.id, place.at("method " + std::to_string(i))));
    const std::string& name = out.methods.back().descriptor.name;
    const auto same = [&](const MethodFacts& method) { return method.descriptor.name == name; };
    if (std::ranges::count_if(out.methods, same) > 1) place.fail("has two methods '" + name + "'");
  }
  return out;
}

}  // namespace clusterbench::plugin
