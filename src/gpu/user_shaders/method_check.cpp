#include "gpu/user_shaders/method_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "gpu/device/device.h"
#include "gpu/user_shaders/block_types.h"
#include "gpu/user_shaders/known_values.h"
#include "gpu/user_shaders/light_rows.h"
#include "gpu/user_shaders/lists_check.h"
#include "gpu/user_shaders/number_bytes.h"
#include "gpu/user_shaders/value_places.h"

namespace clusterbench::gpu {
namespace {

using result::Json;
using result::ShaderMethod;
using result::ShaderPass;

constexpr std::size_t k_most_buffers = Buffers::k_bindings - 1;  // one is the floor's
constexpr std::uint64_t k_most_argument_bytes = 4096, k_most_light_offset = std::uint64_t{16} << 20;
constexpr std::uint64_t k_fewest_boundaries = 2;  // of a grid of one cell

bool has_only(const std::string& text, const char* letters, std::size_t most) {
  return !text.empty() && text.size() <= most && text.find_first_not_of(letters) == std::string::npos;
}

std::string formula_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// Checks of one method; all throw Error ("", JSON pointer).
class MethodCheck {
 public:
  explicit MethodCheck(const ShaderFile& file)
      : file_(file), method_(file.record), names_(number_names(method_)), names_of_grid_(number_names(method_, true)) {}

  void check() const {
    check_names();
    check_parameters();
    check_buffers();
    check_lights();
    for (std::size_t i = 0; i < method_.passes.size(); ++i) check_pass(i);
    check_buffer_types();
    if (std::ranges::all_of(method_.passes, [&](const ShaderPass& pass) { return file_.is_build(pass); }))
      throw Error("", "/passes", "are all of the build; one that assigns is needed");
    for (std::size_t i = 0; i < method_.lists.size(); ++i) check_lists(i);
    if (method_.tests) check_formula(*method_.tests, names_, "/tests");
  }

 private:
  using Values = std::vector<result::ShaderValue>;
  using Places = std::vector<std::optional<ValuePlace>>;

  void check_names() const {
    if (!has_only(method_.name, "abcdefghijklmnopqrstuvwxyz0123456789-", 40) || method_.name.front() == '-')
      throw Error("", "/name",
                  "is '" + shortened(method_.name) +
                      "'; allowed: small letters, digits and -, at most 40, a letter or digit first");
    for (const auto& [where, text] :
         {std::pair("/summary", method_.summary), std::pair("/source", method_.source.value_or("-"))})
      if (text.empty() || text.size() > 1000)
        throw Error("", where, "has " + number_of(text.size(), "byte") + "; allowed: 1 to 1000");
  }

  void check_parameters() const {
    if (!method_.parameters) return;
    std::set<std::string> seen{"name"};
    for (const KnownValue& value : known_values()) seen.insert(value.name);
    for (std::size_t i = 0; i < method_.parameters->size(); ++i) {
      const result::ShaderParameter& one = (*method_.parameters)[i];
      const std::string where = "/parameters/" + std::to_string(i);
      if (!has_only(one.name, "abcdefghijklmnopqrstuvwxyz0123456789_", 40) || one.name.front() < 'a')
        throw Error(
            "", where + "/name",
            "is '" + shortened(one.name) + "'; allowed: small letters, digits and _, at most 40, a letter first");
      if (!seen.insert(one.name).second)
        throw Error("", where + "/name", "is '" + one.name + "', which is a known value or another parameter");
      check_range(one, where);
    }
  }
  static void check_range(const result::ShaderParameter& one, const std::string& where) {
    const bool is_whole = one.whole.value_or(true);
    for (const auto& [key, value] : {std::pair("/min", one.min), std::pair("/max", one.max)})
      if (is_whole && value != std::floor(value))
        throw Error("", where + key,
                    "is " + formula_number(value) + "; allowed: a whole number, unless \"whole\" is false");
    const bool is_within = one.min <= one.default_value && one.default_value <= one.max;
    if (is_within && (!is_whole || one.default_value == std::floor(one.default_value))) return;
    throw Error("", where + "/default",
                "is " + formula_number(one.default_value) + "; allowed: " + (is_whole ? "whole numbers " : "") +
                    "from min to max, here " + formula_number(one.min) + " to " + formula_number(one.max));
  }

  void check_buffers() const {
    if (method_.buffers.empty() || method_.buffers.size() > k_most_buffers)
      throw Error(
          "", "/buffers",
          "has " + number_of(method_.buffers.size(), "buffer") + "; allowed: 1 to " + std::to_string(k_most_buffers));
    for (const auto& [name, buffer] : method_.buffers) {
      const std::string where = "/buffers/" + name;
      check_amount(buffer.bytes, names_, where + "/bytes", 1);
      if (!buffer.values) continue;
      check_values(*buffer.values, bytes_of(name), where + "/values");
      if (buffer.clear.value_or(false))
        throw Error("", where + "/clear", "is true: that would wipe out the values that the host has written there");
    }
  }

  // nullopt where a frame says them.
  std::optional<std::uint64_t> bytes_of(const std::string& buffer) const {
    return constant_amount(method_.buffers[file_.buffer_index(buffer)].second.bytes);
  }

  // `room`: bytes that there are, as far as that is known.
  void check_values(const Values& values, std::optional<std::uint64_t> room, const std::string& pointer) const {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string where = pointer + "/" + std::to_string(i);
      check_is(values[i].is, where + "/is", names_);
      check_amount(values[i].at, names_, where + "/at");
      if (values[i].step.value_or(8) > 4096 || values[i].step.value_or(8) < bytes_of_number(values[i].type))
        throw Error("", where + "/step",
                    "is " + std::to_string(*values[i].step) + "; allowed: the size of the type to 4096");
      if (is_formula(values[i].is))
        if (const std::optional<double> constant = constant_of_formula(values[i].is))
          check_number(values[i].type, *constant, where + "/is");
    }
    const Places places = places_of(values);
    for (std::size_t i = 0; room && i < values.size(); ++i)
      if (places[i]) check_room(*places[i], *room, pointer + "/" + std::to_string(i));
    check_overlaps(places, pointer);
  }
  static bool is_formula(const std::string& is) {
    const std::vector<KnownValue> known = known_values();
    return std::ranges::none_of(known, [&](const KnownValue& value) { return is == value.name; });
  }
  // Where values are whose first byte no frame changes.
  static Places places_of(const Values& values) {
    Places places;
    for (const result::ShaderValue& value : values) {
      const std::optional<std::uint64_t> at = constant_amount(value.at);
      std::optional<ValuePlace>& place = places.emplace_back();
      if (!at) continue;
      const std::uint64_t numbers = numbers_in(value.is);
      place = place_of(value, *at, numbers == 0 ? k_fewest_boundaries : numbers);
      place->may_go_on = numbers == 0;
    }
    return places;
  }
  // 0 where the grid says how many.
  static std::uint64_t numbers_in(const std::string& is) {
    for (const KnownValue& value : known_values())
      if (is == value.name) return value.numbers;
    return 1;
  }
  static void check_is(const std::string& is, const std::string& where, const std::vector<std::string>& numbers) {
    std::vector<std::string> allowed = numbers;
    for (const KnownValue& value : known_values())
      if (value.numbers != 1) allowed.emplace_back(value.name);
    if (std::ranges::find(allowed, is) != allowed.end()) return;
    if (has_only(is, "abcdefghijklmnopqrstuvwxyz0123456789_", 40) && is.front() >= 'a')
      throw Error("", where,
                  "is '" + is + "', which is not known" + did_you_mean(is, allowed) + "; allowed: " + joined(allowed) +
                      ", or a formula");
    check_formula(is, numbers, where);
  }

  void check_buffer_name(const std::string& name, const std::string& where) const {
    std::vector<std::string> names;
    for (const auto& [one, _] : method_.buffers) names.push_back(one);
    if (std::ranges::find(names, name) != names.end()) return;
    throw Error("", where, "is '" + shortened(name) + "'" + did_you_mean(name, names) + ", allowed: " + joined(names));
  }

  void check_lights() const {
    for (std::size_t i = 0; i < method_.lights.rows.size(); ++i) {
      const result::ShaderLightRows& rows = method_.lights.rows[i];
      const std::string where = "/lights/rows/" + std::to_string(i);
      check_buffer_name(rows.buffer, where + "/buffer");
      if (method_.buffers[file_.buffer_index(rows.buffer)].second.clear.value_or(false))
        throw Error("", "/buffers/" + rows.buffer + "/clear", "is true: that would wipe out the lights in it");
      if (rows.stride > 4096)
        throw Error("", where + "/stride", "is " + std::to_string(rows.stride) + "; allowed: at most 4096");
      if (rows.at.value_or(0) > k_most_light_offset)
        throw Error("", where + "/at", "is " + std::to_string(*rows.at) + "; allowed: at most 16 MiB");
      check_light_fields(rows, where);
      check_first_light(i, where);
    }
  }
  static void check_light_fields(const result::ShaderLightRows& rows, const std::string& where) {
    for (std::size_t j = 0; j < rows.fields.size(); ++j) {
      const result::ShaderLightField& field = rows.fields[j];
      const std::uint64_t size = numbers_of(field) * bytes_of_number(field.type);
      if (field.at > rows.stride || size > rows.stride - field.at)
        throw Error("", where + "/fields/" + std::to_string(j) + "/at",
                    "is " + std::to_string(field.at) + ": its " + number_of(size, "byte") +
                        " end beyond the stride of " + std::to_string(rows.stride));
    }
    check_overlaps(places_of_lights(rows, 1, where).fields, where + "/fields");
  }
  // Wherever there are lights there is a first one.
  void check_first_light(std::size_t index, const std::string& where) const {
    const result::ShaderLightRows& rows = method_.lights.rows[index];
    const std::optional<std::uint64_t> bytes = bytes_of(rows.buffer);
    if (const std::uint64_t needed = bytes_of_lights(rows, 1); bytes && needed > *bytes)
      throw Error("", where,
                  "take " + number_of(needed, "byte") + " for the first light; buffer '" + rows.buffer + "' has " +
                      std::to_string(*bytes));
    const LightPlaces lights = places_of_lights(rows, 1, where);
    if (const auto& values = method_.buffers[file_.buffer_index(rows.buffer)].second.values)
      check_apart(places_of(*values), "/buffers/" + rows.buffer + "/values", lights);
    for (std::size_t j = 0; j < index; ++j)
      if (method_.lights.rows[j].buffer == rows.buffer)
        check_apart(places_of_lights(method_.lights.rows[j], 1, "/lights/rows/" + std::to_string(j)), lights);
  }

  void check_pass(std::size_t index) const {
    const ShaderPass& pass = method_.passes[index];
    const std::string where = "/passes/" + std::to_string(index);
    if (pass.groups.has_value() == pass.invocations.has_value())
      throw Error("", where, "has to have one of groups and invocations");
    const std::vector<Json>& counts = pass.groups ? *pass.groups : *pass.invocations;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const std::string at = where + (pass.groups ? "/groups/" : "/invocations/") + std::to_string(i);
      check_amount(counts[i], names_, at, 1);
    }
    check_entry(pass, where);
    if (!file_.module(pass).group_size(file_.entry(pass), {}))
      throw Error(
          "", where + "/module",
          pass.module + " computes the size of its groups from constants, which is not read; let each be one constant");
    check_bindings(pass, where);
    check_constants(pass, where);
    check_group(pass, where);
    check_push(pass, where);
  }

  void check_entry(const ShaderPass& pass, const std::string& where) const {
    const std::string wanted = pass.entry.value_or("main");
    std::vector<std::string> names;
    for (const ModuleEntry& entry : file_.module(pass).entries) {
      if (entry.is_compute && entry.name == wanted) return;
      if (entry.is_compute) names.push_back(entry.name);
    }
    throw Error("", where + "/entry",
                "is '" + shortened(wanted) + "'" + did_you_mean(wanted, names) + "; " + pass.module + " has " +
                    (names.empty() ? "no entry point of a compute shader" : joined(names)));
  }

  static std::string text_of(const ModuleBinding& binding) {
    return "set " + std::to_string(binding.set) + ", binding " + std::to_string(binding.binding) +
           (binding.name.empty() ? "" : " ('" + binding.name + "')");
  }

  void check_bindings(const ShaderPass& pass, const std::string& where) const {
    const SpirvModule& module = file_.module(pass);
    std::set<std::pair<std::uint32_t, std::uint32_t>> described;
    for (std::size_t i = 0; i < pass.bindings.size(); ++i) {
      const result::ShaderBinding& binding = pass.bindings[i];
      const std::string at = where + "/bindings/" + std::to_string(i);
      check_buffer_name(binding.buffer, at + "/buffer");
      const std::pair place(binding.set.value_or(0), binding.binding);
      if (!described.insert(place).second)
        throw Error(
            "", at,
            "is the second of set " + std::to_string(place.first) + ", binding " + std::to_string(place.second));
      if (std::ranges::none_of(module.bindings, [&](const ModuleBinding& one) {
            return one.set == place.first && one.binding == place.second;
          }))
        throw Error("", at,
                    "is set " + std::to_string(place.first) + ", binding " + std::to_string(place.second) + ", which " +
                        pass.module + " does not have; it has " + all_bindings(module));
      check_bound_bytes(pass, binding, at);
    }
    for (const ModuleBinding& binding : module.bindings) {
      if (binding.is_array)
        throw Error("", where + "/module",
                    pass.module + " has " + text_of(binding) +
                        ", which is an array; methods have storage and uniform buffers, one at each binding");
      if (binding.kind == ModuleBinding::Kind::other)
        throw Error("", where + "/module",
                    pass.module + " has " + text_of(binding) +
                        ", which is no buffer; methods have storage and uniform buffers, one at each binding");
      if (!described.contains({binding.set, binding.binding}))
        throw Error("", where + "/bindings", "do not say which buffer is " + text_of(binding) + " of " + pass.module);
    }
  }
  void check_bound_bytes(const ShaderPass& pass, const result::ShaderBinding& binding, const std::string& at) const {
    const std::optional<std::uint64_t> bytes = bytes_of(binding.buffer);
    if (!bytes) return;
    for (const ModuleBinding& one : file_.module(pass).bindings)
      if (one.set == binding.set.value_or(0) && one.binding == binding.binding && one.bytes > (*bytes + 3) / 4 * 4)
        throw Error("", at,
                    pass.module + " reads " + number_of(one.bytes, "byte") + " there; buffer '" + binding.buffer +
                        "' has " + std::to_string(*bytes));
  }
  static std::string all_bindings(const SpirvModule& module) {
    std::vector<std::string> all;
    for (const ModuleBinding& binding : module.bindings) all.push_back(text_of(binding));
    return all.empty() ? "none" : joined(all, "; ");
  }

  void check_constants(const ShaderPass& pass, const std::string& where) const {
    if (!pass.constants) return;
    const SpirvModule& module = file_.module(pass);
    std::set<std::uint32_t> seen;
    for (std::size_t i = 0; i < pass.constants->size(); ++i) {
      const result::ShaderConstant& constant = (*pass.constants)[i];
      const std::string at = where + "/constants/" + std::to_string(i);
      const auto found = std::ranges::find(module.constants, constant.id, &ModuleConstant::id);
      if (found == module.constants.end() || !seen.insert(constant.id).second)
        throw Error("", at + "/id",
                    "is " + std::to_string(constant.id) +
                        (found == module.constants.end()
                             ? ", which " + pass.module + " does not have as a specialization constant"
                             : ", for the second time"));
      if (!found->is_word) throw Error("", at + "/id", "is " + std::to_string(constant.id) + ", which has no 32 bits");
      check_constant_type(constant, found->type, pass.module, at);
      check_formula(constant.is, names_of_grid_, at + "/is");
      if (const std::optional<double> value = constant_of_formula(constant.is))
        word_of_constant(constant, *value, at + "/is");
    }
  }
  // With the constants that no frame changes.
  void check_group(const ShaderPass& pass, const std::string& where) const {
    std::map<std::uint32_t, std::uint32_t> given;
    for (const result::ShaderConstant& constant : pass.constants.value_or(std::vector<result::ShaderConstant>{})) {
      const std::optional<double> value = constant_of_formula(constant.is);
      given[constant.id] = value ? word_of_constant(constant, *value, "") : 1;
    }
    const auto size = *file_.module(pass).group_size(file_.entry(pass), given);
    if (std::ranges::find(size, 0u) != size.end())
      throw Error("", where + "/module",
                  pass.module + " has groups of 0 invocations; allowed: at least 1 along each axis");
  }

  // `type`: that of the module; "" where it is not known.
  static void check_constant_type(const result::ShaderConstant& constant, const std::string& type,
                                  const std::string& module, const std::string& at) {
    const bool is_whole = type == "u32" || type == "i32";  // the same bits, where nothing is said
    if (type.empty() || constant.type == type || (!constant.type && is_whole)) return;
    throw Error("", at + "/type",
                (constant.type ? "is " + *constant.type : std::string("is missing, which means u32")) + "; constant " +
                    std::to_string(constant.id) + " of " + module + " is " + type);
  }

  void check_push(const ShaderPass& pass, const std::string& where) const {
    const std::uint64_t bytes = file_.module(pass).argument_bytes;
    if (bytes > k_most_argument_bytes)
      throw Error("", where + "/module",
                  pass.module + " has " + number_of(bytes, "byte") + " of push constants; allowed: at most " +
                      std::to_string(k_most_argument_bytes));
    if (bytes > 0 && !pass.push)
      throw Error("", where + "/push",
                  "is missing: " + pass.module + " has " + number_of(bytes, "byte") + " of push constants");
    if (!pass.push) return;
    check_values(*pass.push, bytes, where + "/push");
    const Places places = places_of(*pass.push);
    check_covered(places, file_.module(pass).arguments, pass.module, where + "/push");
    const BlockView view{&file_.module(pass), &file_.module(pass).argument_numbers,
                         "the push constants of " + pass.module};
    check_value_types({view}, *pass.push, where + "/push");
  }

  static void check_value_types(const std::vector<BlockView>& views, const Values& values, const std::string& pointer) {
    const Places places = places_of(values);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (places[i]) check_types(views, *places[i], values[i].type, pointer + "/" + std::to_string(i));
  }
  // As all passes see it that bind it.
  std::vector<BlockView> views_of(const std::string& buffer) const {
    std::vector<BlockView> views;
    for (const ShaderPass& pass : method_.passes)
      for (const result::ShaderBinding& binding : pass.bindings)
        for (const ModuleBinding& one : file_.module(pass).bindings)
          if (binding.buffer == buffer && one.set == binding.set.value_or(0) && one.binding == binding.binding)
            views.push_back({&file_.module(pass), &one.numbers, text_of(one) + " of " + pass.module});
    return views;
  }
  void check_buffer_types() const {
    for (const auto& [name, buffer] : method_.buffers)
      if (buffer.values) check_value_types(views_of(name), *buffer.values, "/buffers/" + name + "/values");
    for (std::size_t i = 0; i < method_.lights.rows.size(); ++i) {
      const result::ShaderLightRows& rows = method_.lights.rows[i];
      const std::string where = "/lights/rows/" + std::to_string(i);
      const LightPlaces first = places_of_lights(rows, 1, where);
      for (std::size_t j = 0; j < rows.fields.size(); ++j) {
        ValuePlace place = *first.fields[j];
        place.at += first.at;
        check_types(views_of(rows.buffer), place, rows.fields[j].type, where + "/fields/" + std::to_string(j));
      }
    }
  }

  void check_lists(std::size_t index) const {
    const std::string where = "/lists/" + std::to_string(index);
    // Numbers are those of a frame: a formula is only read, unless it is a number itself.
    const ReplaceFormula known = [&](const Json& formula, const std::string& at) -> Json {
      check_amount(formula, names_, at);
      const std::optional<std::uint64_t> constant = constant_amount(formula);
      return constant ? Json(*constant) : formula;
    };
    const Json part = lists_part_with(method_.lists[index], known, where);
    const result::DumpLists lists =
        read_lists_part(lists_part_with(
                            part, [](const Json&, const std::string&) { return Json(1u); }, where),
                        where);
    if (lists.layout == "inline")
      throw Error("", where + "/layout", "is inline; allowed: a layout of buffers, which the shader leaves");
    if (lists.set) throw Error("", where + "/set", "is not known here: all parts are united");
    if (lists.rows) check_buffer_name(lists.rows->buffer, where + "/rows/buffer");
    if (lists.entries && lists.entries->buffer) check_buffer_name(*lists.entries->buffer, where + "/entries/buffer");
    if (lists.ranges) check_buffer_name(lists.ranges->buffer, where + "/ranges/buffer");
    if (lists.nodes) check_buffer_name(lists.nodes->buffer, where + "/nodes/buffer");
    check_list_part(
        part, lists, [&](const std::string& name) { return bytes_of(name); }, where);
  }

  const ShaderFile& file_;
  const ShaderMethod& method_;
  std::vector<std::string> names_, names_of_grid_;
};

}  // namespace

void check_shader_method(const ShaderFile& file) {
  MethodCheck(file).check();
}

}  // namespace clusterbench::gpu
