#include "gpu/user_shaders/shader_file.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <set>

#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/sha256.h"
#include "core/text.h"
#include "gpu/device/device.h"
#include "gpu/user_shaders/known_values.h"
#include "gpu/user_shaders/light_rows.h"
#include "gpu/user_shaders/lists_check.h"
#include "gpu/user_shaders/number_bytes.h"
#include "gpu/user_shaders/value_places.h"
#include "result/allowed_values.h"

namespace clusterbench::gpu {
namespace {

namespace fs = std::filesystem;
using result::Json;
using result::ShaderMethod;
using result::ShaderPass;

constexpr std::uintmax_t k_most_json_bytes = std::uintmax_t{1} << 20, k_most_module_bytes = std::uintmax_t{16} << 20;
constexpr std::size_t k_most_buffers = Buffers::k_bindings - 1;  // one is the floor's
constexpr std::uint64_t k_most_argument_bytes = 4096;

std::string small_file(const fs::path& path, std::uintmax_t most) {
  std::error_code failed;
  if (fs::is_directory(path, failed)) throw Error(path.string(), "", "is a folder, not a file");
  if (!fs::exists(path, failed)) throw Error(path.string(), "", "does not exist");
  if (!fs::is_regular_file(path, failed)) throw Error(path.string(), "", "is no file of a known size");
  if (const std::uintmax_t size = fs::file_size(path, failed); failed || size > most)
    throw Error(path.string(), "", "has " + number_of(size, "byte") + "; allowed: at most " + std::to_string(most));
  return file_text(path);
}

bool has_only(const std::string& text, const char* letters, std::size_t most) {
  return !text.empty() && text.size() <= most && text.find_first_not_of(letters) == std::string::npos;
}

std::string formula_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// What takes the place of a formula where the type wants a whole number.
using ReplaceFormula = std::function<std::uint64_t(const Json& formula, const std::string& where)>;

void replace_formulas(const result::Type& type, Json& value, const ReplaceFormula& number, const std::string& where) {
  if (type.kind == result::Kind::integer && value.is_string()) {
    value = number(value, where);
  } else if (type.kind == result::Kind::list && value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      replace_formulas(*type.element, value[i], number, where + "/" + std::to_string(i));
  } else if (type.kind == result::Kind::object && value.is_object()) {
    for (const result::Field& field : type.fields)
      if (value.contains(field.name))
        replace_formulas(*field.type, value[field.name], number, where + "/" + field.name);
  }
}

result::DumpLists lists_with(const Json& part, const ReplaceFormula& number, const std::string& where) {
  Json whole = part;
  replace_formulas(result::type_of<result::DumpLists>(), whole, number, where);
  auto lists = result::from_json<result::DumpLists>(whole, where);
  result::check_values(result::type_of<result::DumpLists>(), &lists, where);
  return lists;
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
    if (std::ranges::all_of(method_.passes, [&](const ShaderPass& pass) { return file_.is_build(pass); }))
      throw Error("", "/passes", "are all of the build; one that assigns is needed");
    for (std::size_t i = 0; i < method_.lists.size(); ++i) check_lists(i);
    if (method_.tests) check_formula(*method_.tests, names_, "/tests");
  }

 private:
  using Values = std::vector<result::ShaderValue>;

  void check_names() const {
    if (!has_only(method_.name, "abcdefghijklmnopqrstuvwxyz0123456789-", 40) || method_.name.front() == '-')
      throw Error(
          "", "/name",
          "is '" + method_.name + "'; allowed: small letters, digits and -, at most 40, a letter or digit first");
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
        throw Error("", where + "/name",
                    "is '" + one.name + "'; allowed: small letters, digits and _, at most 40, a letter first");
      if (!seen.insert(one.name).second)
        throw Error("", where + "/name", "is '" + one.name + "', which is a known value or another parameter");
      if (!(one.min <= one.default_value && one.default_value <= one.max))
        throw Error("", where + "/default",
                    "is " + formula_number(one.default_value) + "; allowed: from min to max, here " +
                        formula_number(one.min) + " to " + formula_number(one.max));
    }
  }

  void check_buffers() const {
    if (method_.buffers.empty() || method_.buffers.size() > k_most_buffers)
      throw Error(
          "", "/buffers",
          "has " + number_of(method_.buffers.size(), "buffer") + "; allowed: 1 to " + std::to_string(k_most_buffers));
    for (const auto& [name, buffer] : method_.buffers) {
      const std::string where = "/buffers/" + name;
      check_amount(buffer.bytes, names_, where + "/bytes");
      if (buffer.bytes == 0) throw Error("", where + "/bytes", "is 0; allowed: at least 1, or a formula");
      if (!buffer.values) continue;
      check_values(*buffer.values, bytes_of(name), where + "/values");
      if (buffer.clear.value_or(false))
        throw Error("", where + "/clear", "is true: that would wipe out the values that the host has written there");
    }
  }

  // nullopt where a formula says them.
  std::optional<std::uint64_t> bytes_of(const std::string& buffer) const {
    const Json& bytes = method_.buffers[file_.buffer_index(buffer)].second.bytes;
    return bytes.is_number_unsigned() ? std::optional(bytes.get<std::uint64_t>()) : std::nullopt;
  }

  // `room`: bytes that there are, as far as that is known. Returns where the values are, as far as that is.
  std::vector<std::optional<ValuePlace>> check_values(const Values& values, std::optional<std::uint64_t> room,
                                                      const std::string& pointer) const {
    std::vector<std::optional<ValuePlace>> places(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string where = pointer + "/" + std::to_string(i);
      check_is(values[i].is, where + "/is", names_);
      check_amount(values[i].at, names_, where + "/at");
      if (values[i].step.value_or(8) > 4096 || values[i].step.value_or(8) < bytes_of_number(values[i].type))
        throw Error("", where + "/step",
                    "is " + std::to_string(*values[i].step) + "; allowed: the size of the type to 4096");
      const std::uint64_t numbers = numbers_in(values[i].is);
      if (!values[i].at.is_number_unsigned() || numbers == 0) continue;
      places[i] = place_of(values[i], values[i].at.get<std::uint64_t>(), numbers);
      if (room) check_room(*places[i], *room, where);
    }
    check_overlaps(places, pointer);
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
    throw Error("", where, "is '" + name + "'" + did_you_mean(name, names) + ", allowed: " + joined(names));
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
      if (rows.at.value_or(0) > k_most_module_bytes)
        throw Error("", where + "/at", "is " + std::to_string(*rows.at) + "; allowed: at most 16 MiB");
      for (std::size_t j = 0; j < rows.fields.size(); ++j) {
        const result::ShaderLightField& field = rows.fields[j];
        const std::uint64_t size = numbers_of(field) * bytes_of_number(field.type);
        if (field.at > rows.stride || size > rows.stride - field.at)
          throw Error("", where + "/fields/" + std::to_string(j) + "/at",
                      "is " + std::to_string(field.at) + ": its " + number_of(size, "byte") +
                          " end beyond the stride of " + std::to_string(rows.stride));
      }
    }
  }

  static bool is_constant_zero(const Json& count, const std::string& where) {
    if (!count.is_string()) return count == 0;
    static constexpr double k_any = 1.0;
    bool is_constant = true;
    const NumberOf number = [&is_constant](const std::string&) {
      is_constant = false;
      return &k_any;
    };
    const double value = number_of_formula(count.get<std::string>(), number, where);
    return is_constant && value == 0.0;
  }

  void check_pass(std::size_t index) const {
    const ShaderPass& pass = method_.passes[index];
    const std::string where = "/passes/" + std::to_string(index);
    if (pass.groups.has_value() == pass.invocations.has_value())
      throw Error("", where, "has to have one of groups and invocations");
    const std::vector<Json>& counts = pass.groups ? *pass.groups : *pass.invocations;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const std::string at = where + (pass.groups ? "/groups/" : "/invocations/") + std::to_string(i);
      check_amount(counts[i], names_, at);
      if (is_constant_zero(counts[i], at)) throw Error("", at, "is 0, and nothing would run; allowed: at least 1");
    }
    check_entry(pass, where);
    if (!file_.module(pass).group_size(file_.entry(pass), {}))
      throw Error(
          "", where + "/module",
          pass.module + " computes the size of its groups from constants, which is not read; let each be one constant");
    check_bindings(pass, where);
    check_constants(pass, where);
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
                "is '" + wanted + "'" + did_you_mean(wanted, names) + "; " + pass.module + " has " +
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
      if (binding.kind == ModuleBinding::Kind::other || binding.is_array)
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
    }
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
    check_covered(check_values(*pass.push, bytes, where + "/push"), file_.module(pass).arguments, pass.module,
                  where + "/push");
  }

  void check_lists(std::size_t index) const {
    const std::string where = "/lists/" + std::to_string(index);
    // Numbers are those of a frame: a formula is only read.
    const ReplaceFormula any = [&](const Json& formula, const std::string& at) -> std::uint64_t {
      check_amount(formula, names_, at);
      return 1;
    };
    const result::DumpLists lists = lists_with(method_.lists[index], any, where);
    if (lists.layout == "inline")
      throw Error("", where + "/layout", "is inline; allowed: a layout of buffers, which the shader leaves");
    if (lists.set) throw Error("", where + "/set", "is not known here: all parts are united");
    if (lists.rows) check_buffer_name(lists.rows->buffer, where + "/rows/buffer");
    if (lists.entries && lists.entries->buffer) check_buffer_name(*lists.entries->buffer, where + "/entries/buffer");
    if (lists.ranges) check_buffer_name(lists.ranges->buffer, where + "/ranges/buffer");
    if (lists.nodes) check_buffer_name(lists.nodes->buffer, where + "/nodes/buffer");
    check_list_part(
        method_.lists[index], lists, [&](const std::string& name) { return bytes_of(name); }, where);
  }

  const ShaderFile& file_;
  const ShaderMethod& method_;
  std::vector<std::string> names_, names_of_grid_;
};

bool has_word(const std::string& text, std::string_view word) {
  const auto is_letter = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + word.size())) return true;
  return false;
}
// Is the word in a formula of this JSON? Names of buffers, modules and entries are none.
bool names_number(const Json& json, std::string_view word) {
  if (json.is_string()) return has_word(json.get_ref<const std::string&>(), word);
  if (json.is_array()) return std::ranges::any_of(json, [&](const Json& one) { return names_number(one, word); });
  if (!json.is_object()) return false;
  for (const auto& [key, value] : json.items())
    if (key != "buffer" && key != "module" && key != "entry" && names_number(value, word)) return true;
  return false;
}
bool has_slice_formula(const ShaderMethod& method) {
  const Json all = result::to_json(method);
  for (const char* key : {"buffers", "passes", "lists", "tests"})
    if (all.contains(key) && (names_number(all[key], "slice_scale") || names_number(all[key], "slice_bias")))
      return true;
  return false;
}

void read_modules(ShaderFile& file, Sha256& digest, const BytesOfModule& bytes_of) {
  for (std::size_t i = 0; i < file.record.passes.size(); ++i) {
    const std::string& name = file.record.passes[i].module;
    if (file.modules.contains(name)) continue;
    const std::string bytes = bytes_of(name, "/passes/" + std::to_string(i) + "/module");
    digest.add(bytes);
    file.modules.emplace(name, read_module(std::as_bytes(std::span(bytes)), (file.path.parent_path() / name).string()));
  }
}

ShaderMethod parse_shader_method(std::string_view text, const std::string& file) {
  const auto json = read_json<Json>(text, file, JsonComments::allowed);
  if (!json.is_object() || !json.contains("shader_version"))
    throw Error(file, "/shader_version", "is missing: this is no method of shaders (see `clusterbench schema shader`)");
  try {
    if (json["shader_version"] != 1)
      throw Error("", "/shader_version", "is " + json["shader_version"].dump() + "; this version reads 1");
    Json plain = json;
    plain.erase("$schema");
    auto method = result::from_json<ShaderMethod>(plain);
    result::check_values(method);
    return method;
  } catch (const Error& error) {
    throw Error(file, error.where(), error.message(), error.code());
  }
}

}  // namespace

const ModuleEntry& ShaderFile::entry(const ShaderPass& pass) const {
  const std::string wanted = pass.entry.value_or("main");
  return *std::ranges::find_if(module(pass).entries,
                               [&](const ModuleEntry& entry) { return entry.is_compute && entry.name == wanted; });
}

std::size_t ShaderFile::buffer_index(const std::string& name) const {
  std::size_t index = 0;
  while (record.buffers.at(index).first != name) ++index;
  return index;
}

result::DumpLists lists_of(const Json& part, const NumberOf& number, const std::string& where) {
  const ReplaceFormula of_frame = [&](const Json& formula, const std::string& at) {
    return amount_of(formula, number, at);
  };
  return lists_with(part, of_frame, where);
}

ShaderFile make_shader_file(const fs::path& path, std::string_view text, const BytesOfModule& bytes_of) {
  ShaderFile file;
  file.path = path;
  file.record = parse_shader_method(text, path.string());
  Sha256 digest;
  digest.add(text);
  read_modules(file, digest, bytes_of);
  file.sha256 = digest.hex();
  try {
    MethodCheck(file).check();
    file.has_slice_formula = has_slice_formula(file.record);
  } catch (const Error& error) {
    throw Error(path.string(), error.where(), error.message(), error.code());
  }
  return file;
}

ShaderFile read_shader_file(const fs::path& path) {
  return make_shader_file(path, small_file(path, k_most_json_bytes),
                          [&](const std::string& name, const std::string& where) {
                            const fs::path module = path.parent_path() / name;
                            std::error_code none;
                            if (fs::exists(module, none)) return small_file(module, k_most_module_bytes);
                            throw Error(path.string(), where,
                                        "names " + module.string() +
                                            ", which does not exist; it is made by glslangValidator -V --target-env "
                                            "vulkan1.3 X.comp -o X.spv");
                          });
}

std::vector<std::string> files_of_shader(const fs::path& path) {
  std::vector<std::string> files{path.string()};
  for (const ShaderPass& pass : parse_shader_method(small_file(path, k_most_json_bytes), path.string()).passes)
    files.push_back((path.parent_path() / pass.module).string());
  return files;
}

}  // namespace clusterbench::gpu
