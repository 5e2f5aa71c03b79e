#pragma once
// The constants with which a shader or a program finds the cell of a sample, named as in docs/grids-and-lookups.md.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "result/case.h"

namespace clusterbench::report {

struct LookupConstant {
  std::string name;                            // "tile_scale"
  enum class Type { integer, real, precise };  // precise: double if a language has it
  Type type = Type::real;
  std::vector<double> values;  // one; two or three for a vector; any number for an array
  bool is_array = false;
  // From frame to frame: declared as a variable, which has the last frame's value and must be set before a lookup.
  bool changes = false;
};

// For a case with lists. Slices without a formula (form "search") have their boundaries, and no scale and bias.
std::vector<LookupConstant> lookup_constants(const result::Case& result_case);

// Values that cannot be constants, for a comment; "" if all can.
std::string lookup_note(const result::Case& result_case);

// `name`: prefix of all constants. Declarations end with a line break.
std::string lookup_hlsl(const std::string& name, const std::vector<LookupConstant>& constants);
std::string lookup_glsl(const std::string& name, const std::vector<LookupConstant>& constants);
// Constants in a namespace of that name.
std::string lookup_cpp(const std::string& name, const std::vector<LookupConstant>& constants);
nlohmann::ordered_json lookup_json(const std::vector<LookupConstant>& constants);

}  // namespace clusterbench::report
