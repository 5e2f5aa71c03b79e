#pragma once
// Allocations as code: a C++ header with a run-time check, or constants and lookups of a shader.

#include <cstdint>
#include <string>
#include <vector>

#include "report/shader_code/named_structures.h"
#include "report/sizing/sized_buffers.h"

namespace clusterbench::report {

enum class SizeLanguage : std::uint8_t { cpp, hlsl, glsl };

// `remark`: a comment for the head, or "". A comment above each structure names the recorded maximum and its place.
std::string size_code(SizeLanguage language, const std::vector<NamedStructure>& structures, const std::string& remark,
                      const AllocationRules& rules);

}  // namespace clusterbench::report
