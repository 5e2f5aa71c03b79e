#pragma once
// Are the numbers that the host writes of the types that modules declare there?

#include <string>
#include <vector>

#include "gpu/user_shaders/spirv_module.h"
#include "gpu/user_shaders/value_places.h"

namespace clusterbench::gpu {

// The numbers of a block as a module sees them.
struct BlockView {
  const SpirvModule* module;
  const std::vector<BlockNumber>* numbers;
  std::string name;  // "the push constants of cull.spv"
};

// Throws Error ("", `where`/type) for numbers of `type` where each view that has a number at one of their bytes
// declares another one. Views may differ: a pass that clears a buffer sees words in it. Bits that a module casts may be
// of another type, and smaller numbers may lie in a word.
void check_types(const std::vector<BlockView>& views, const ValuePlace& place, const std::string& type,
                 const std::string& where);

}  // namespace clusterbench::gpu
