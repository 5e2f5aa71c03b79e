#pragma once
// Shader functions that read a cell's lights from the buffers of report/sizing/allocation.h, in HLSL and GLSL.

#include <string>

#include "report/shader_code/named_structures.h"
#include "result/case.h"

namespace clusterbench::report {

enum class ShaderLanguage : std::uint8_t { hlsl, glsl };

// Buffers, and for a structure NAME
//   NAME_list NAME_list_of(int cell)              the place of a cell's list and its number of lights
//   uint NAME_index_at(NAME_list list, uint n)    its nth light, points before spots before boxes; n below list.lights
//   uint NAME_index_at(int cell, uint n)          the same in one step
// for packed, fixed, bitfield, linked and runs. Buffers have 32-bit words; a shader with other buffers (bindless, or a
// ByteAddressBuffer) defines NAME_BUFFER_word(i) before the include, and then none is declared. `slot`: the first free
// binding or register; grows by the number of used ones. Without such functions: a comment that gives the reason.
std::string list_code(const NamedStructure& named, ShaderLanguage language, int& slot);

// Why no code here can read a structure's lists: "its tiles react, ..."; "" if one can.
std::string why_no_reader(const SizedStructure& structure);
// The same for the cases of one structure on its cameras, as in a result.
std::string why_no_reader(const std::vector<result::Case>& cases);

// The names that list_code() declares.
std::vector<std::string> list_code_names(const NamedStructure& named);

}  // namespace clusterbench::report
