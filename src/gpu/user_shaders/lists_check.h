#pragma once
// What is wrong with a part of a shader's `lists` whatever the numbers of a frame are.

#include <functional>
#include <optional>
#include <string>

#include "result/documents/dump.h"

namespace clusterbench::gpu {

// The bytes of a buffer that is there; nullopt where a formula says them.
using BytesOfBuffer = std::function<std::optional<std::uint64_t>(const std::string& buffer)>;

// `part`: as it is in the file; `lists`: the same with some number in place of each formula. Throws Error ("", JSON
// pointer) for what its layout lacks, for fields beyond their rows and for bits beyond their type, for rows without
// room, and for what begins beyond its buffer.
void check_list_part(const result::Json& part, const result::DumpLists& lists, const BytesOfBuffer& bytes_of,
                     const std::string& where);

}  // namespace clusterbench::gpu
