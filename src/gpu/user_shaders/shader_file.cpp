#include "gpu/user_shaders/shader_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>

#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/sha256.h"
#include "core/text.h"
#include "gpu/user_shaders/method_check.h"
#include "gpu/user_shaders/number_bytes.h"
#include "result/allowed_values.h"

namespace clusterbench::gpu {
namespace {

namespace fs = std::filesystem;
using result::Json;
using result::ShaderMethod;
using result::ShaderPass;

constexpr std::uintmax_t k_most_json_bytes = std::uintmax_t{1} << 20, k_most_module_bytes = std::uintmax_t{16} << 20;

std::string small_file(const fs::path& path, std::uintmax_t most) {
  std::error_code failed;
  if (fs::is_directory(path, failed)) throw Error(path.string(), "", "is a folder, not a file");
  if (!fs::exists(path, failed)) throw Error(path.string(), "", "does not exist");
  if (!fs::is_regular_file(path, failed)) throw Error(path.string(), "", "is no file of a known size");
  if (const std::uintmax_t size = fs::file_size(path, failed); failed || size > most)
    throw Error(path.string(), "", "has " + number_of(size, "byte") + "; allowed: at most " + std::to_string(most));
  return file_text(path);
}

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
    throw Error(
        file, "/shader_version",
        "is missing: without it this is no method of shaders; this version reads 1 (see `clusterbench schema shader`)");
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

std::uint32_t word_of_constant(const result::ShaderConstant& constant, double value, const std::string& where) {
  const std::string type = constant.type.value_or("u32");
  std::array<std::byte, 4> word{};
  write_number(word.data(), type == "bool" ? "u32" : type, value, where);
  return std::bit_cast<std::uint32_t>(word);
}

std::size_t ShaderFile::buffer_index(const std::string& name) const {
  std::size_t index = 0;
  while (record.buffers.at(index).first != name) ++index;
  return index;
}

Json lists_part_with(const Json& part, const ReplaceFormula& number, const std::string& where) {
  Json out = part;
  replace_formulas(result::type_of<result::DumpLists>(), out, number, where);
  return out;
}

result::DumpLists read_lists_part(const Json& part, const std::string& where) {
  auto lists = result::from_json<result::DumpLists>(part, where);
  result::check_values(result::type_of<result::DumpLists>(), &lists, where);
  return lists;
}

result::DumpLists lists_of(const Json& part, const NumberOf& number, const std::string& where) {
  const ReplaceFormula of_frame = [&](const Json& formula, const std::string& at) {
    return Json(amount_of(formula, number, at));
  };
  return read_lists_part(lists_part_with(part, of_frame, where), where);
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
    check_shader_method(file);
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
                                        "names " + shortened(module.string()) +
                                            ", which does not exist; it is made by glslangValidator -V --target-env "
                                            "vulkan1.2 X.comp -o X.spv");
                          });
}

std::vector<std::string> files_of_shader(const fs::path& path) {
  std::vector<std::string> files{path.string()};
  for (const ShaderPass& pass : parse_shader_method(small_file(path, k_most_json_bytes), path.string()).passes)
    files.push_back((path.parent_path() / pass.module).string());
  return files;
}

}  // namespace clusterbench::gpu
