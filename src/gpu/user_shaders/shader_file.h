#pragma once
// A method of a user's shaders from disk: its JSON and its modules, checked as far as that needs no device and no
// frame.

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "gpu/user_shaders/formula.h"
#include "gpu/user_shaders/spirv_module.h"
#include "result/documents/shader.h"

namespace clusterbench::gpu {

struct ShaderFile {
  std::filesystem::path path;
  result::ShaderMethod record;
  std::map<std::string, SpirvModule> modules;  // by their names in the JSON
  std::string sha256;                          // of the JSON and the modules
  bool has_slice_formula = false;              // is told slice_scale or slice_bias

  const SpirvModule& module(const result::ShaderPass& pass) const { return modules.at(pass.module); }
  const ModuleEntry& entry(const result::ShaderPass& pass) const;
  bool is_build(const result::ShaderPass& pass) const { return pass.when.value_or("assign") == "build"; }
  std::size_t buffer_index(const std::string& name) const;  // of a buffer that is there
};

// The JSON has at most 1 MiB, a module 16 MiB. Throws Error (file, JSON pointer or byte).
ShaderFile read_shader_file(const std::filesystem::path& path);
// The same of a text. `bytes_of`: of a module by its name, which stands at this place in the text.
using BytesOfModule = std::function<std::string(const std::string& name, const std::string& where)>;
ShaderFile make_shader_file(const std::filesystem::path& path, std::string_view text, const BytesOfModule& bytes_of);

// The files that it names, itself first.
std::vector<std::string> files_of_shader(const std::filesystem::path& path);

// A part of `lists` where `number` takes the place of each formula that stands for a whole number.
using ReplaceFormula = std::function<result::Json(const result::Json& formula, const std::string& where)>;
result::Json lists_part_with(const result::Json& part, const ReplaceFormula& number, const std::string& where);
// Of one without formulas. Throws Error ("", `where`).
result::DumpLists read_lists_part(const result::Json& part, const std::string& where);
// Both, with the numbers of a frame.
result::DumpLists lists_of(const result::Json& part, const NumberOf& number, const std::string& where);

// The bits of a specialization constant. Throws Error ("", `where`) for a value that its type does not have.
std::uint32_t word_of_constant(const result::ShaderConstant& constant, double value, const std::string& where);

}  // namespace clusterbench::gpu
