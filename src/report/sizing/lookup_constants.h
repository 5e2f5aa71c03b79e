#pragma once
// The constants with which a shader finds the cell of a sample, as docs/grids-and-lookups.md names them, for a program
// or a shader.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "result/case.h"

namespace clusterbench::report {

struct LookupConstant {
  std::string name;                            // "tile_scale"
  enum class Type { integer, real, precise };  // precise: double where a language has it
  Type type = Type::real;
  std::vector<double> values;  // one, or a vector's two or three; of an array any number
  bool is_array = false;
  // From frame to frame: declared as a variable, which has the last frame's value and is set before a lookup.
  bool changes = false;
};

// Of a case with lists. Slices that have no formula (form "search") have their boundaries, and no scale and bias.
std::vector<LookupConstant> lookup_constants(const result::Case& result_case);

// What cannot be a constant, for a comment; "" where all can.
std::string lookup_note(const result::Case& result_case);

// `name`: what all begin with. Declarations end with a line break.
std::string lookup_hlsl(const std::string& name, const std::vector<LookupConstant>& constants);
std::string lookup_glsl(const std::string& name, const std::vector<LookupConstant>& constants);
// Constants in a namespace of that name.
std::string lookup_cpp(const std::string& name, const std::vector<LookupConstant>& constants);
nlohmann::ordered_json lookup_json(const std::vector<LookupConstant>& constants);

}  // namespace clusterbench::report
